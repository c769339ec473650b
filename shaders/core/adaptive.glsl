// Adaptive sampling: how far off a pixel's mean may be, and which pixels are still traced.

#ifndef ADAPTIVE_GLSL
#define ADAPTIVE_GLSL

#include "core/film.glsl"

layout(constant_id = ID_HAS_MOMENTS) const uint HAS_MOMENTS = 0u;

// Once some pixels have stopped, those that have not: how many, then the column and the row of each in 16
// bits.
layout(set = 0, binding = BINDING_ACTIVE_PIXELS, std430) readonly buffer ActivePixels { uint active_pixels[]; };

// The pixel of this invocation, if it has one: of the lattice, or, where that has no stride, of the list
// from origin.x on.
bool find_pixel(Lattice lattice, out uvec2 pixel) {
    if (HAS_MOMENTS == 1u && lattice.stride == 0u) {
        uint group = gl_WorkGroupID.y * LISTED_ROW_GROUPS + gl_WorkGroupID.x;
        uint index = lattice.origin.x + GROUP_SIZE * GROUP_SIZE * group + gl_LocalInvocationIndex;
        if (index >= active_pixels[0]) {
            pixel = uvec2(0u);
            return false;
        }
        uint column_and_row = active_pixels[1u + index];
        pixel = uvec2(column_and_row & 0xffffu, column_and_row >> 16u);
        return true;
    }
    // Eight invocations that follow one another cover 4 by 2 pixels and not 8 by 1: their rays stay closer.
    uvec2 local = gl_LocalInvocationID.xy;
    uvec2 place = uvec2(local.x & 3u | (local.y & 1u) << 2u, local.x >> 2u | local.y & 6u);
    uint row = visited_row(lattice, lattice.first_row + gl_WorkGroupID.y);
    pixel = lattice_pixel(lattice, GROUP_SIZE * uvec2(gl_WorkGroupID.x, row) + place);
    return inside(pixel, lattice.extent);
}

// Rec. 709.
float luminance(vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

// The second moment, the sum of squared differences from the mean, of two sets of samples together:
// T. Chan, G. Golub, R. LeVeque, "Updating Formulae and a Pairwise Algorithm for Computing Sample
// Variances", 1979. film and batch are their means and counts before they are merged.
float merge_moments(vec4 film, float film_moment, vec4 batch, float batch_moment) {
    if (film.w == 0.0) {
        return batch_moment;
    }
    if (batch.w == 0.0) {
        return film_moment;
    }
    float apart = luminance(batch.rgb) - luminance(film.rgb);
    return film_moment + batch_moment + apart * apart * (film.w * batch.w / (film.w + batch.w));
}

// Below this luminance an error counts as one of this luminance: the eye sees none that are finer.
const float DARKEST = 0.05;

// The standard error of a pixel's mean luminance, as a share of it.
float relative_error(vec4 film, float moment) {
    float variance_of_mean = moment / (film.w * (film.w - 1.0));
    return film.w < 2.0 ? 1e30 : sqrt(variance_of_mean) / max(luminance(film.rgb), DARKEST);
}

// Samples that all miss a lamp have no variance, and say nothing of the light that it would add. What is met
// with probability p stays unseen in all of N samples with (1 - p)^N, and then p times its brightness is lost.
// That is 1 / (e N) of the brightness on average at most: where p is 1 / N.
//
// So much can be lost of the brightest thing that the pixel's rays can meet, as a share of its mean. N counts
// the samples of the pixels around it too, for it goes on if one of them meets something.
float most_lost(vec4 film, float brightest) {
    const float E = 2.718281828;
    const float PIXELS_AROUND = 9.0;
    float mean = luminance(film.rgb);
    return max(brightest - mean, 0.0) / (E * PIXELS_AROUND * film.w * max(mean, DARKEST));
}

// What is lost may be no more than this, whatever error is allowed: it would be missing from whole discs.
const float MOST_LOST = 0.02;

// A larger threshold counts as this. It is the error of 25 hits; a pixel that stops with fewer stops because
// they came early, and is too bright: D. Kirk and J. Arvo, "Unbiased Sampling Techniques for Image Synthesis",
// SIGGRAPH 1991.
const float LARGEST_THRESHOLD = 0.2;

// Whether a pixel needs more samples, by itself.
bool is_noisy(vec4 film, float moment, float brightest, float threshold) {
    return relative_error(film, moment) >= min(threshold, LARGEST_THRESHOLD)
        || most_lost(film, brightest) >= min(threshold, MOST_LOST);
}

#endif
