#version 460
#extension GL_GOOGLE_include_directive : require

// Between batches of an adaptive picture: lists the pixels to go on with. A pixel stops when its error and those of its
// neighbours are small enough, and when little light can be missing that none of their samples has met. The neighbours
// count so that no edge stops just because its samples happened to fall on one side. A pixel that has stopped never
// starts again.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "core/adaptive.glsl"

layout(set = 0, binding = BINDING_TRACED_IMAGE, rgba32f) writeonly uniform image2D traced_image;
layout(set = 0, binding = BINDING_FILM_IMAGE, rgba32f) readonly uniform image2D film_image;
layout(set = 0, binding = BINDING_FILM_MOMENTS, r32f) readonly uniform image2D film_moments;

layout(set = 0, binding = BINDING_KEPT_PIXELS, std430) buffer KeptPixels { uint kept_pixels[]; }; // like active_pixels

// An upper bound of the luminance that rays can meet, for each cell of a grid over the picture.
layout(set = 0, binding = BINDING_BRIGHTEST, std430) readonly buffer BrightestBuffer { float brightest[]; };

layout(push_constant, std430) uniform SelectPush {
    Lattice lattice;
    float threshold;
    uint cell; // width and height of a cell of brightest, in pixels
} push;

// A pixel goes on if any pixel within this distance, in x and in y, is noisy.
const int DILATION = 1;

shared uint kept_in_group;
shared uint first_of_group;

bool has_noise_around(const ivec2 pixel) {
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
        // The pixel's last batch must not be gathered by its neighbours again.
        imageStore(traced_image, ivec2(pixel), vec4(0.0));
    }
    uint place = kept ? atomicAdd(kept_in_group, 1u) : 0u;
    barrier();
    // A single atomic addition for the workgroup keeps its pixels together, so that the list has coherent runs.
    if (gl_LocalInvocationIndex == 0u) {
        first_of_group = atomicAdd(kept_pixels[0], kept_in_group);
    }
    barrier();
    if (kept) {
        kept_pixels[1u + first_of_group + place] = pixel.x | pixel.y << 16u;
    }
}
