// Sample values and the maps that shape them.
//
// A value depends on (seed, pixel, sample index, dimension) alone, so any sample can be
// computed again, anywhere, in any order. Four dimensions come from one call.

#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL

// Dimension blocks. FILM_AND_LENS holds the film jitter in xy and the lens point in zw.
const uint BLOCK_FILM_AND_LENS = 0u;

// The pcg4d hash: M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering",
// JCGT 9(3), 2020, section 4.2.
uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Four values in [0, 1), multiples of 2^-24, which f32 holds exactly.
vec4 sample_values(uint seed, uvec2 pixel, uint sample_index, uint block) {
    uvec4 bits = pcg4d(uvec4(pixel, sample_index, seed + block * 0x9e3779b9u));
    return vec4(bits >> 8u) * (1.0 / 16777216.0);
}

// Where on the film a sample falls, in pixels from its start pixel's centre, x right and y down,
// for a jitter of that many pixels across.
vec2 film_offset(vec2 xi, float jitter) {
    return (xi - 0.5) * jitter;
}

// The pixel that such a sample lands in, relative to its start pixel. Only the offset is rounded:
// the floor of an absolute f32 position would move samples next to a pixel's edge.
ivec2 landing_step(vec2 offset) {
    return ivec2(floor(offset + 0.5));
}

// Concentric map of the unit square onto the unit disk, area preserving:
// P. Shirley and K. Chiu, JGT 2(3), 1997; Suffern, chapter 6.
//
// Within a sector the angle stays in [-pi/4, pi/4], so a short Taylor series gives its sine and
// cosine to f32 precision. Vulkan lets the built-in sin and cos err by 2^-11.
vec2 concentric_disk(vec2 xi) {
    vec2 square = 2.0 * xi - 1.0;
    bool wide = abs(square.x) > abs(square.y);
    float radius = wide ? square.x : square.y;
    float other = wide ? square.y : square.x;
    float angle = radius == 0.0 ? 0.0 : 0.785398163 * other / radius;

    float a2 = angle * angle;
    float sine = angle * (1.0 + a2 * (-1.0 / 6.0 + a2 * (1.0 / 120.0 + a2 * (-1.0 / 5040.0 + a2 / 362880.0))));
    float cosine = 1.0 + a2 * (-0.5 + a2 * (1.0 / 24.0 + a2 * (-1.0 / 720.0 + a2 / 40320.0)));
    return radius * (wide ? vec2(cosine, sine) : vec2(sine, cosine));
}

#endif
