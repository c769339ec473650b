// Sample values, and the maps from the unit square to the film and the lens.
//
// A value depends on (sampler, seed, pixel, sample index, dimension) alone, so any sample can be
// computed again, anywhere, in any order. Four dimensions come from one call.

#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL

#include "interface.glsl"
#include "core/sobol.glsl"
#include "core/warp.glsl"

layout(constant_id = ID_SAMPLER) const uint SAMPLER = SAMPLER_RANDOM;

// The tile of examples/blue_noise_tile.rs: a number of 16 bits for each pixel, row by row, eight numbers in a texel.
layout(set = 0, binding = BINDING_BLUE_NOISE_TILE) uniform utextureBuffer blue_noise_tile;
const uint TILE = 128u;
const uvec4 BLUE_NOISE_SCRAMBLE = uvec4(0x0e7ef62eu, 0xeec210f3u, 0xbced7d2au, 0x84af394du);

// Dimension blocks. FILM_AND_LENS holds the film jitter in xy and the lens point in zw.
const uint BLOCK_FILM_AND_LENS = 0u;
const uint BLOCK_TIME = 1u; // when the light passes the shutter, in x
// From this block on, each bounce has a block for each use. So a use has the same values whether or not the uses before
// it take theirs.
const uint BLOCK_FIRST_BOUNCE = 2u;
const uint USE_LIGHT = 0u; // which light, and which point of the light
const uint USE_DIRECTION = 1u; // whether the ray goes on, and in which direction
const uint USES = 2u;

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

// Folds the upper half of the hash's bits into the lower half. The lower bits of pcg4d are its weaker ones, but they
// decide the leading bits of the samples.
uvec4 folded(const uvec4 hash) {
    return hash ^ (hash >> 16u);
}

// The mask of a pixel, which combines a hash of its number in the blue-noise tile with a hash of the seed. The seed
// also shifts the tile, by bits that the mask does not use.
uvec4 blue_noise_mask(const uint seed, const uvec2 pixel, const uint block) {
    uvec4 shift = folded(pcg4d(uvec4(0u, 0u, block, seed)));
    uvec2 at = (pixel + shift.xy) & (TILE - 1u);
    uint place = at.y * TILE + at.x;
    uint pair = texelFetch(blue_noise_tile, int(place >> 3u))[place >> 1u & 3u];
    uint number = bitfieldExtract(pair, int(16u * (place & 1u)), 16);
    return shift ^ folded(pcg4d(uvec4(number, 0u, 0u, 0u)));
}

// The keys that all samples of a pixel share.
uvec4 sample_keys(const uint seed, const uvec2 pixel, const uint block) {
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
vec4 sample_values(const uvec4 keys, const uint sample_index) {
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

// The index of a sample in another order of the sequence, so that its point is independent of the one that the index
// itself has: B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020, section 4. Each run of 2^k indices
// that starts at a multiple of 2^k stays together.
uint shuffled_index(const uint sample_index, const uint order) {
    return bitfieldReverse(scramble_upwards(uvec4(bitfieldReverse(sample_index)), uvec4(order)).x);
}

// A value in [0, 1) for the time. The values are the points of the sequence's first dimension, in their own order.
float time_value(const uvec4 keys, const uint sample_index) {
    if (SAMPLER == SAMPLER_RANDOM) {
        return sample_values(keys, sample_index).x;
    }
    const uvec2 BLUE_NOISE_ORDER = uvec2(0x6c8e9cf5u, 0x3f84d5b5u);
    uvec2 order = SAMPLER == SAMPLER_BLUE_NOISE ? BLUE_NOISE_ORDER : keys.xy;
    uint shuffled = shuffled_index(sample_index, order.x);
    uint bits = bitfieldReverse(scramble_upwards(uvec4(shuffled), order.yyyy).x);
    bits ^= SAMPLER == SAMPLER_BLUE_NOISE ? keys.x : 0u;
    return float(bits >> 8u) * (1.0 / 16777216.0);
}

// Identifies the sample values that a path takes after it has left the camera.
struct PathSampler {
    uint seed;
    uvec2 pixel;
    uint sample_index;
};

// Four values in [0, 1) for a use at a bounce. Each block has the points in its own order. If blocks shared an order,
// their values would be correlated: the half of [0, 1) that a value of one block lies in would determine the half for
// another block. With blue noise, all pixels share one order, as they share one sequence.
vec4 path_values(const PathSampler path, const uint bounce, const uint use) {
    uint block = BLOCK_FIRST_BOUNCE + USES * bounce + use;
    uvec4 keys = sample_keys(path.seed, path.pixel, block);
    if (SAMPLER == SAMPLER_RANDOM) {
        return sample_values(keys, path.sample_index);
    }
    uint order = folded(pcg4d(SAMPLER == SAMPLER_BLUE_NOISE ? uvec4(0u, block, 0u, 0u) : keys)).x;
    return sample_values(keys, shuffled_index(path.sample_index, order) & 0xffffffu);
}

// The film position of a sample, in pixels from its start pixel's centre, x right and y down. The positions fill a
// square whose side is jitter pixels.
vec2 film_offset(const vec2 xi, const float jitter) {
    return (xi - 0.5) * jitter;
}

// The pixel that a sample with this offset lands in, relative to its start pixel. Only the offset is rounded: the floor
// of an absolute f32 position would move some samples across a pixel's edge.
ivec2 landing_step(const vec2 offset) {
    return ivec2(floor(offset + 0.5));
}

#endif
