#version 460
#extension GL_GOOGLE_include_directive : require

// Between batches of an adaptive picture: lists the pixels to go on with. One stops when its error and
// that of every pixel around it are small enough, so that no edge stops because its samples happened to
// fall on one side, and when little can be lost of what none of them has met. A pixel that has stopped never
// starts again.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "core/adaptive.glsl"

layout(set = 0, binding = BINDING_TRACED_IMAGE, rgba32f) writeonly uniform image2D traced_image;
layout(set = 0, binding = BINDING_FILM_IMAGE, rgba32f) readonly uniform image2D film_image;
layout(set = 0, binding = BINDING_FILM_MOMENTS, r32f) readonly uniform image2D film_moments;

layout(set = 0, binding = BINDING_KEPT_PIXELS, std430) buffer KeptPixels { uint kept_pixels[]; }; // as the active ones

// The most luminance of what rays can meet, for each cell of a grid over the picture.
layout(set = 0, binding = BINDING_BRIGHTEST, std430) readonly buffer BrightestBuffer { float brightest[]; };

layout(push_constant, std430) uniform SelectPush {
    Lattice lattice;
    float threshold;
    uint cell; // width and height of a cell of brightest, in pixels
} push;

// How far around a pixel all must be still enough.
const int DILATION = 1;

shared uint kept_in_group;
shared uint first_of_group;

bool has_noise_around(ivec2 pixel) {
    uint columns = (push.lattice.extent.x + push.cell - 1u) / push.cell;
    for (int y = -DILATION; y <= DILATION; ++y) {
        for (int x = -DILATION; x <= DILATION; ++x) {
            ivec2 near = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(push.lattice.extent) - 1);
            uint cell = uint(near.y) / push.cell * columns + uint(near.x) / push.cell;
            vec4 film = imageLoad(film_image, near);
            if (is_noisy(film, imageLoad(film_moments, near).r, brightest[cell], push.threshold)) {
                return true;
            }
        }
    }
    return false;
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        kept_in_group = 0u;
    }
    barrier();
    uvec2 pixel;
    bool is_active = find_pixel(push.lattice, pixel);
    bool kept = is_active && has_noise_around(ivec2(pixel));
    if (is_active && !kept) {
        // No neighbour may gather from it what it traced last.
        imageStore(traced_image, ivec2(pixel), vec4(0.0));
    }
    uint place = kept ? atomicAdd(kept_in_group, 1u) : 0u;
    barrier();
    // One addition for the group keeps its pixels together, and the list in coherent runs.
    if (gl_LocalInvocationIndex == 0u) {
        first_of_group = atomicAdd(kept_pixels[0], kept_in_group);
    }
    barrier();
    if (kept) {
        kept_pixels[1u + first_of_group + place] = pixel.x | pixel.y << 16u;
    }
}
