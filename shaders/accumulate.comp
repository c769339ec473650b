#version 460
#extension GL_GOOGLE_include_directive : require

// Pass 2: merges the tracing image into the film, by gathering. A pixel looks at every start pixel
// whose samples can land in it; it computes their offsets again from the sampler. No two
// invocations write one texel, and the order is fixed, so the result is the same every time.

layout(local_size_x = 8, local_size_y = 8) in;

#include "film.glsl"
#include "sampling.glsl"

layout(set = 0, binding = 0, rgba32f) readonly uniform image2D batch_image;
layout(set = 0, binding = 1, rgba32f) uniform image2D film_image;

layout(push_constant, std430) uniform AccumulatePush {
    Lattice lattice; // the pixels to merge
    uint seed;
    uint first_sample; // 0: the picture starts, and the film is taken for empty
    float jitter; // pixels
    int reach; // how many pixels a sample can land from its start pixel; 0: at home
} push;

void main() {
    uvec2 pixel = lattice_pixel(push.lattice, gl_GlobalInvocationID.xy);
    if (!inside(pixel, push.lattice.extent)) {
        return;
    }
    vec4 film = push.first_sample == 0u ? vec4(0.0) : imageLoad(film_image, ivec2(pixel));
    if (push.reach == 0) {
        film = merge(film, imageLoad(batch_image, ivec2(pixel)));
    } else {
        for (int y = -push.reach; y <= push.reach; ++y) {
            for (int x = -push.reach; x <= push.reach; ++x) {
                ivec2 start = ivec2(pixel) + ivec2(x, y);
                if (start.x < 0 || start.y < 0 || !inside(uvec2(start), push.lattice.extent)) {
                    continue;
                }
                uvec4 keys = sample_keys(push.seed, uvec2(start), BLOCK_FILM_AND_LENS);
                vec4 xi = sample_values(keys, push.first_sample);
                if (landing_step(film_offset(xi.xy, push.jitter)) == -ivec2(x, y)) {
                    film = merge(film, imageLoad(batch_image, start));
                }
            }
        }
    }
    imageStore(film_image, ivec2(pixel), film);
}
