// Optical vignetting: light must pass both the disc of the lens and its front rim. Seen from a point of the film, the
// rim is shifted against the disc, and the shift grows with the distance of the point from the axis of the lens.

#ifndef CATS_EYE_GLSL
#define CATS_EYE_GLSL

#include "aperture/record.glsl"
#include "camera/movements.glsl"

// M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 4.4.46, for values from 0 to 1.
float arc_cosine(const float x) {
    float sum = 1.5707963050 + x * (-0.2145988016 + x * (0.0889789874 + x * (-0.0501743046 + x * (0.0308918810
        + x * (-0.0170881256 + x * (0.0066700901 - x * 0.0012624911))))));
    return sqrt(1.0 - x) * sum;
}

// psi - sin(psi) for psi from 0 to pi, without losing the digits of small ones.
float excess(const float psi) {
    float p2 = psi * psi;
    float sum = 1.0 / 6.0 + p2 * (-1.0 / 120.0 + p2 * (1.0 / 5040.0 + p2 * (-1.0 / 362880.0 + p2 * (1.0 / 39916800.0
        + p2 * (-1.0 / 6227020800.0 + p2 * (1.0 / 1307674368000.0 - p2 / 355687428096000.0))))));
    return psi * p2 * sum;
}

// A point of the overlap of two unit discs, the second of which is shifted by `off`, and in z the area of the overlap
// as a share of a disc's. The overlap is two caps back to back. The value xi.x chooses a cut across a cap by the area
// outside the cut: a cut at cos(psi / 2) leaves (psi - sin psi) / 2 outside. Solving this for psi is solving Kepler's
// equation.
vec3 overlap_point(const vec2 off, const vec2 xi) {
    float distance = length(off);
    vec2 axis = distance > 0.0 ? off / distance : vec2(1.0, 0.0);
    float middle = 0.5 * distance;
    float cap = excess(2.0 * arc_cosine(middle));
    float side = 2.0 * xi.x - 1.0;
    float outside = (1.0 - abs(side)) * cap;
    float root = pow(6.0 * outside, 1.0 / 3.0);
    float r2 = root * root;
    float psi = min(root * (1.0 + r2 * (1.0 / 60.0 + r2 / 1400.0)), 3.14159265);
    vec2 quarter;
    [[unroll]] for (int i = 0; i < 2; ++i) {
        quarter = cosine_and_sine(0.25 * psi);
        float sine = 2.0 * quarter.x * quarter.y;
        psi -= psi > 0.0 ? (excess(psi) - outside) / (2.0 * sine * sine) : 0.0;
    }
    quarter = cosine_and_sine(0.25 * psi);
    float cosine = 1.0 - 2.0 * quarter.y * quarter.y;
    float sine = 2.0 * quarter.x * quarter.y;
    float x = middle + sign(side) * (cosine - middle);
    float y = (2.0 * xi.y - 1.0) * sine;
    return vec3(x * axis + y * vec2(-axis.y, axis.x), cap / 3.14159265);
}

vec3 cats_eye_point(const vec2 q, const vec2 xi) {
    // Light that arrives from the right has passed the front rim farther to the left.
    vec2 from_axis = HAS_MOVEMENTS == 1u ? q - aperture.axis : q;
    vec2 off = -aperture.cats_eye_shift * from_axis;
    off *= min(1.0, aperture.max_cats_eye_shift / max(length(off), 1e-20));
    vec3 point = overlap_point(off, xi);
    if (HAS_PROFILE == 1u) {
        // The rim cuts off a part of the light, not of its middle, so the points keep their places and have weights.
        point.z *= profile_light(dot(point.xy, point.xy));
    }
    return vec3(aperture.stretch * point.xy, point.z);
}

#endif
