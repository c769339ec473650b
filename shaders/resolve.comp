#version 460
#extension GL_GOOGLE_include_directive : require

// Pass 3: turns the film's means into a picture: exposure and sRGB encoding. A pixel without a
// sample shows the nearest one that has some. While the first sample is being filled in, the film
// bound here is the tracing image, which holds what there is of it.

layout(local_size_x = 8, local_size_y = 8) in;

#include "color.glsl"
#include "film.glsl"

layout(set = 0, binding = 0, rgba32f) readonly uniform image2D film_image;
layout(set = 0, binding = 1, rgba8) writeonly uniform image2D picture_image;

layout(push_constant, std430) uniform ResolvePush {
    uvec2 extent;
    uint preview_stride; // of a lattice of pixels that is filled: (2, 2) + 4 i, or 2 i, or all
    float exposure; // linear factor
    float count_scale; // where not 0, counts are shown, and this many times the count is white
} push;

const int SEARCH_RADIUS = 4;

vec4 film_at(ivec2 pixel) {
    return imageLoad(film_image, pixel);
}

// The nearest texel with a count, by Euclidean distance, within SEARCH_RADIUS; else an empty one.
vec4 nearest_sampled(ivec2 pixel) {
    vec4 nearest = vec4(0.0);
    int nearest_distance = 2 * SEARCH_RADIUS * SEARCH_RADIUS + 1;
    for (int y = -SEARCH_RADIUS; y <= SEARCH_RADIUS; ++y) {
        for (int x = -SEARCH_RADIUS; x <= SEARCH_RADIUS; ++x) {
            ivec2 candidate = pixel + ivec2(x, y);
            int distance = x * x + y * y;
            if (distance < nearest_distance && candidate.x >= 0 && candidate.y >= 0
                && inside(uvec2(candidate), push.extent)) {
                vec4 texel = film_at(candidate);
                if (texel.w > 0.0) {
                    nearest = texel;
                    nearest_distance = distance;
                }
            }
        }
    }
    return nearest;
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (!inside(pixel, push.extent)) {
        return;
    }
    vec4 film = film_at(ivec2(pixel));
    if (film.w == 0.0 && push.preview_stride > 1u) {
        // The site of the pixel's own cell is close enough, and one load instead of a search.
        uint site_in_cell = push.preview_stride == 4u ? 2u : 0u;
        uvec2 site = pixel / push.preview_stride * push.preview_stride + site_in_cell;
        film = film_at(ivec2(min(site, push.extent - 1u)));
    }
    if (film.w == 0.0) {
        film = nearest_sampled(ivec2(pixel));
    }
    vec3 shown = push.count_scale > 0.0 ? vec3(push.count_scale * film.w) : push.exposure * film.rgb;
    imageStore(picture_image, ivec2(pixel), vec4(srgb_encode(shown), 1.0));
}
