// Sample values and the maps that shape them.
//
// A value depends on (sampler, seed, pixel, sample index, dimension) alone, so any sample can be
// computed again, anywhere, in any order. Four dimensions come from one call.

#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL

const uint SAMPLER_RANDOM = 0u;
const uint SAMPLER_SOBOL = 1u;
const uint SAMPLER_BLUE_NOISE = 2u;

layout(constant_id = 0) const uint SAMPLER = SAMPLER_RANDOM;

// The tile of examples/blue_noise_tile.rs: a number of 16 bits a pixel, row by row, eight a texel.
layout(set = 0, binding = 16) uniform utextureBuffer blue_noise_tile;
const uint TILE = 128u;
const uvec4 BLUE_NOISE_SCRAMBLE = uvec4(0x50a00e30u, 0x93e15e34u, 0x0b56f629u, 0x2a323757u);

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

// The lower half of the hash's bits is its worse one, and decides what comes first of what is made of it.
uvec4 folded(uvec4 hash) {
    return hash ^ (hash >> 16u);
}

// Flips each bit depending on the bits below it, as a hash of them and the key decides: an Owen
// scramble of the bits in reverse. S. Laine and T. Karras, "Stratified Sampling for Stochastic
// Transparency", EGSR 2011, with the constants of N. Vegdahl, "Building a Better LK Hash", 2021.
uvec4 scramble_upwards(uvec4 bits, uvec4 key) {
    bits ^= bits * 0x3d20adeau;
    bits += key;
    bits *= (key >> 16u) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

// The Sobol sequence's second dimension with its bits in reverse: bit i of the result is the sum,
// modulo two, of the bits j >= i of the index for which the binomial of j over i is odd.
uint sobol_second_reversed(uint index) {
    index ^= (index >> 1u) & 0x55555555u;
    index ^= (index >> 2u) & 0x33333333u;
    index ^= (index >> 4u) & 0x0f0f0f0fu;
    index ^= (index >> 8u) & 0x00ff00ffu;
    index ^= index >> 16u;
    return index;
}

// The direction numbers of its third and fourth dimension, bits in reverse, for the 24 bits that an
// index has: the polynomials of S. Joe and F. Kuo, "Constructing Sobol Sequences with Better
// Two-dimensional Projections", SIAM J. Sci. Comput. 30(5), 2008, but for the fourth the initial numbers
// 1, 1, 3, with which the first eight points of the pair are a net too.
const uvec2 SOBOL_THIRD_AND_FOURTH_REVERSED[24] = uvec2[24](
    uvec2(0x000001u, 0x000001u), uvec2(0x000003u, 0x000002u), uvec2(0x000006u, 0x000006u),
    uvec2(0x000009u, 0x00000bu), uvec2(0x000017u, 0x000014u), uvec2(0x00003au, 0x00003du),
    uvec2(0x000071u, 0x000047u), uvec2(0x0000a3u, 0x000089u), uvec2(0x000116u, 0x000192u),
    uvec2(0x000339u, 0x0002f6u), uvec2(0x000677u, 0x000553u), uvec2(0x0009aau, 0x000ff4u),
    uvec2(0x001601u, 0x001015u), uvec2(0x003903u, 0x00203fu), uvec2(0x007706u, 0x006041u),
    uvec2(0x00aa09u, 0x00b082u), uvec2(0x010117u, 0x014186u), uvec2(0x03033au, 0x03d2cbu),
    uvec2(0x060671u, 0x047514u), uvec2(0x0909a3u, 0x089f7du), uvec2(0x171616u, 0x193187u),
    uvec2(0x3a3939u, 0x2f42c9u), uvec2(0x717777u, 0x555512u), uvec2(0xa3aaaau, 0xffff76u)
);

uvec2 sobol_third_and_fourth_reversed(uint index) {
    uvec2 sum = uvec2(0u);
    for (uint bit = 0u; bit < 24u; ++bit) {
        sum ^= SOBOL_THIRD_AND_FOURTH_REVERSED[bit] & uvec2(-int(index >> bit & 1u));
    }
    return sum;
}

// The first four dimensions of the Sobol sequence, each Owen-scrambled by a key of its own: B. Burley,
// "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. The first in reverse is the index. Film and
// lens share a point of four dimensions, and are no two padded pairs: what a blurred edge shows
// depends on both at once. The lens has the first two, whose points lie best in the plane.
uvec4 sobol_film_and_lens(uint index, uvec4 keys) {
    uvec4 reversed = uvec4(sobol_third_and_fourth_reversed(index), index, sobol_second_reversed(index));
    return bitfieldReverse(scramble_upwards(reversed, keys));
}

// The mask that the blue-noise tile has for a pixel, with the seed's. A seed shifts the tile too, by
// bits that the mask leaves unused.
uvec4 blue_noise_mask(uint seed, uvec2 pixel, uint block) {
    uvec4 shift = folded(pcg4d(uvec4(0u, 0u, block, seed)));
    uvec2 at = (pixel + shift.xy) & (TILE - 1u);
    uint place = at.y * TILE + at.x;
    uint pair = texelFetch(blue_noise_tile, int(place >> 3u))[place >> 1u & 3u];
    uint number = bitfieldExtract(pair, int(16u * (place & 1u)), 16);
    return shift ^ folded(pcg4d(uvec4(number, 0u, 0u, 0u)));
}

// What all samples of a pixel have in common.
uvec4 sample_keys(uint seed, uvec2 pixel, uint block) {
    switch (SAMPLER) {
    case SAMPLER_BLUE_NOISE:
        return blue_noise_mask(seed, pixel, block);
    case SAMPLER_SOBOL:
        return folded(pcg4d(uvec4(pixel, block, seed)));
    default:
        return uvec4(pixel, seed + block * 0x9e3779b9u, 0u);
    }
}

// Four values in [0, 1), multiples of 2^-24, which f32 holds exactly.
vec4 sample_values(uvec4 keys, uint sample_index) {
    uvec4 bits;
    switch (SAMPLER) {
    case SAMPLER_BLUE_NOISE:
        bits = keys ^ sobol_film_and_lens(sample_index, BLUE_NOISE_SCRAMBLE);
        break;
    case SAMPLER_SOBOL:
        bits = sobol_film_and_lens(sample_index, keys);
        break;
    default:
        bits = pcg4d(uvec4(keys.xy, sample_index, keys.z));
    }
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
