// An image: light comes in where the image is bright.

#ifndef IMAGE_GLSL
#define IMAGE_GLSL

#include "aperture/record.glsl"

// Running sums of the image's light, from 0 to 1: first over its rows, then within each row. A texel holds four sums.
layout(set = 0, binding = BINDING_APERTURE_SUMS) uniform utextureBuffer aperture_sums;

float sum_at(const uint i) {
    return uintBitsToFloat(texelFetch(aperture_sums, int(i >> 2u))[i & 3u]);
}

// Inverts the running sums that start at the index `first`: finds the cell that a value falls into. The fraction of the
// result is where in the cell the value lies.
float cell_place(const uint first, const uint cells, const float value) {
    uint cell = 0u;
    [[unroll]] for (uint step = 128u; step > 0u; step >>= 1u) {
        if (cell + step < cells && sum_at(first + cell + step) <= value) {
            cell += step;
        }
    }
    float before = sum_at(first + cell);
    float light = sum_at(first + cell + 1u) - before;
    return float(cell) + (light > 0.0 ? (value - before) / light : 0.5);
}

vec3 image_point(const vec2 q, const vec2 xi) {
    uvec2 cells = aperture.cells;
    float down = cell_place(0u, cells.y, xi.y);
    uint row = min(uint(down), cells.y - 1u);
    float across = cell_place(cells.y + 1u + row * (cells.x + 1u), cells.x, xi.x);
    vec2 point = vec2(2.0 * across / float(cells.x) - 1.0, 1.0 - 2.0 * down / float(cells.y));
    return vec3(aperture.stretch * point, 1.0);
}

#endif
