#version 460
#extension GL_GOOGLE_include_directive : require

// Pass 2: merges the tracing image into the film, by gathering. A pixel looks at every start pixel
// whose samples can land in it; it computes their offsets again from the sampler. No two
// invocations write one texel, and the order is fixed, so the result is the same every time.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "core/adaptive.glsl"
#include "core/sampling.glsl"

layout(set = 0, binding = BINDING_TRACED_IMAGE, rgba32f) readonly uniform image2D traced_image;
layout(set = 0, binding = BINDING_FILM_IMAGE, rgba32f) uniform image2D film_image;
layout(set = 0, binding = BINDING_TRACED_MOMENTS, r32f) readonly uniform image2D traced_moments;
layout(set = 0, binding = BINDING_FILM_MOMENTS, r32f) uniform image2D film_moments;

layout(push_constant, std430) uniform AccumulatePush {
    Lattice lattice; // the pixels to merge
    uint seed;
    uint first_sample; // 0: the picture starts, so the film counts as empty
    float jitter; // pixels
    int reach; // how many pixels away from its start pixel a sample can land; 0: always in its start pixel
} push;

vec4 film = vec4(0.0);
float moment = 0.0;

// Merges the batch that was traced for a start pixel.
void gather(const ivec2 start) {
    vec4 batch = imageLoad(traced_image, start);
    if (HAS_MOMENTS == 1u) {
        moment = merge_moments(film, moment, batch, imageLoad(traced_moments, start).r);
    }
    film = merge(film, batch);
}

void main() {
    uvec2 pixel;
    if (!find_pixel(push.lattice, pixel)) {
        return;
    }
    if (push.first_sample > 0u) {
        film = imageLoad(film_image, ivec2(pixel));
        if (HAS_MOMENTS == 1u) {
            moment = imageLoad(film_moments, ivec2(pixel)).r;
        }
    }
    if (push.reach == 0) {
        gather(ivec2(pixel));
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
                    gather(start);
                }
            }
        }
    }
    imageStore(film_image, ivec2(pixel), film);
    if (HAS_MOMENTS == 1u) {
        imageStore(film_moments, ivec2(pixel), vec4(moment));
    }
}
