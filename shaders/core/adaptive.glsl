// Adaptive sampling: the estimated error of a pixel, and the list of pixels that are still traced.

#ifndef ADAPTIVE_GLSL
#define ADAPTIVE_GLSL

#include "core/color.glsl"
#include "core/film.glsl"

layout(constant_id = ID_HAS_MOMENTS) const uint HAS_MOMENTS = 0u;

// Once some pixels have stopped, the active pixels, which have not: their number, then the column and the row of each
// pixel in 16 bits.
layout(set = 0, binding = BINDING_ACTIVE_PIXELS, std430) readonly buffer ActivePixels { uint active_pixels[]; };

// The pixel of this invocation, if it has one. The pixel is taken from the lattice, or, if the lattice has no stride,
// from the part of the list that starts at the index origin.x.
bool find_pixel(const Lattice lattice, out uvec2 pixel) {
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
    // Eight consecutive invocations cover 4 by 2 pixels instead of 8 by 1, so that their rays stay closer together.
    uvec2 local = gl_LocalInvocationID.xy;
    uvec2 place = uvec2(local.x & 3u | (local.y & 1u) << 2u, local.x >> 2u | local.y & 6u);
    uint row = visited_row(lattice, lattice.first_row + gl_WorkGroupID.y);
    pixel = lattice_pixel(lattice, GROUP_SIZE * uvec2(gl_WorkGroupID.x, row) + place);
    return inside(pixel, lattice.extent);
}

// The second moment of two sets of samples together, which is the sum of squared differences from their mean:
// T. Chan, G. Golub, R. LeVeque, "Updating Formulae and a Pairwise Algorithm for Computing Sample
// Variances", 1979. film and batch are the means and counts of the sets before they are merged.
float merge_moments(const vec4 film, const float film_moment, const vec4 batch, const float batch_moment) {
    if (film.w == 0.0) {
        return batch_moment;
    }
    if (batch.w == 0.0) {
        return film_moment;
    }
    float apart = luminance(batch.rgb) - luminance(film.rgb);
    return film_moment + batch_moment + apart * apart * (film.w * batch.w / (film.w + batch.w));
}

// The errors of darker pixels are measured relative to this luminance, because the eye does not see finer ones.
const float DARKEST = 0.05;

// The standard error of a pixel's mean luminance, relative to the mean.
float relative_error(const vec4 film, const float moment) {
    float variance_of_mean = moment / (film.w * (film.w - 1.0));
    return film.w < 2.0 ? 1e30 : sqrt(variance_of_mean) / max(luminance(film.rgb), DARKEST);
}

// Samples that all miss a lamp have no variance, and do not show how much light the lamp would add. If a sample hits
// the lamp with the probability p, all N samples miss it with the probability (1 - p)^N, and then p times its
// brightness is missing from the mean. On average, the loss is at most 1 / (e N) of the brightness, which it reaches
// at p = 1 / N.
//
// This function returns that loss for the brightest thing that the pixel's rays can meet, relative to the pixel's mean.
// N counts the samples of the neighbouring pixels too, because a pixel goes on if one of them hits something.
float possible_loss(const vec4 film, const float brightest) {
    const float E = 2.718281828;
    const float PIXELS_AROUND = 9.0;
    float mean = luminance(film.rgb);
    return max(brightest - mean, 0.0) / (E * PIXELS_AROUND * film.w * max(mean, DARKEST));
}

// The largest loss that is allowed, however large the allowed error is: the light would be missing from whole discs.
const float MAX_LOSS = 0.02;

// Larger thresholds are reduced to this one, which is the error after 25 hits. A pixel that stops after fewer hits
// stops because they came early, and is too bright: D. Kirk and J. Arvo, "Unbiased Sampling Techniques for Image
// Synthesis", SIGGRAPH 1991.
const float MAX_THRESHOLD = 0.2;

// Whether a pixel needs more samples, regardless of the pixels around it.
bool is_noisy(const vec4 film, const float moment, const float brightest, const float threshold) {
    return relative_error(film, moment) >= min(threshold, MAX_THRESHOLD)
        || possible_loss(film, brightest) >= min(threshold, MAX_LOSS);
}

#endif
