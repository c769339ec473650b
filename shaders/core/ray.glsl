// Rays, and the arithmetic that every intersection needs.

#ifndef RAY_GLSL
#define RAY_GLSL

#include "interface.glsl"

struct Ray {
    vec3 origin;
    vec3 direction; // unit length
};

// The time of the sample that is traced, in seconds from the middle of the exposure, when the shapes are where the
// scene has them.
float ray_time = 0.0;

// These replace min() and max(), whose rules for NaNs cost a software device three more instructions.
float smaller(const float a, const float b) { return a < b ? a : b; }
float larger(const float a, const float b) { return a > b ? a : b; }
float largest(const vec3 of) { return larger(larger(of.x, of.y), of.z); }

// 1 / direction with zero components replaced, so that no distance to an axis-aligned plane is 0 * infinity.
vec3 safe_inverse(const vec3 direction) {
    vec3 tiny = mix(vec3(-1e-20), vec3(1e-20), greaterThanEqual(direction, vec3(0.0)));
    return 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(1e-20)));
}

#endif
