// The film: a texel holds the running mean of r, g, b and the number of samples in the mean.

#ifndef FILM_GLSL
#define FILM_GLSL

#include "interface.glsl"

// The pixels that a dispatch covers: origin + stride * (x, y), inside extent. A stride above one is the
// interleaved preview. Rows of workgroups are visited row_step apart, modulo row_count, so that the rows visited first
// are spread over the whole picture.
struct Lattice {
    uvec2 extent;
    uvec2 origin;
    uint stride;
    uint first_row; // the first row of workgroups, in the order of the visits
    uint row_step; // shares no divisor with row_count
    uint row_count;
};

// The row of workgroups that is visited after `number` others.
uint visited_row(const Lattice lattice, const uint number) {
    uint product = number * lattice.row_step;
    // The remainder is computed with floats, because a software device divides integers one lane at a time. The
    // quotient may be off by one.
    int rest = int(product - lattice.row_count * uint(float(product) / float(lattice.row_count)));
    rest += rest < 0 ? int(lattice.row_count) : 0;
    return uint(rest) - (rest >= int(lattice.row_count) ? lattice.row_count : 0u);
}

uvec2 lattice_pixel(const Lattice lattice, const uvec2 invocation) {
    return lattice.origin + lattice.stride * invocation;
}

bool inside(const uvec2 pixel, const uvec2 extent) {
    return pixel.x < extent.x && pixel.y < extent.y;
}

// Merges the mean of batch.w samples into a mean of film.w samples. If a count is zero, the colours with it may be
// anything, so they are replaced rather than multiplied by zero.
vec4 merge(const vec4 film, const vec4 batch) {
    float count = film.w + batch.w;
    vec3 merged = film.rgb + (batch.rgb - film.rgb) * (batch.w / count);
    return vec4(film.w == 0.0 ? batch.rgb : batch.w == 0.0 ? film.rgb : merged, count);
}

// This tests the bits, because a driver may assume that there are no infinities and no NaNs.
bool is_finite(const vec3 value) {
    return all(notEqual(floatBitsToUint(value) & 0x7f800000u, uvec3(0x7f800000u)));
}

#endif
