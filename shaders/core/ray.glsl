// Rays, and what is counted for each.

#ifndef RAY_GLSL
#define RAY_GLSL

#include "interface.glsl"

struct Ray {
    vec3 origin;
    vec3 direction; // unit length
};

// Of the sample that is traced: seconds from the middle of the exposure, where the shapes are as given.
float ray_time = 0.0;

// Not min() and max(): what those must do with a NaN costs a software device three instructions more.
float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a > b ? a : b; }

// 1 / direction with zero components replaced, so that no distance to a plane across an axis is 0 * infinity.
vec3 safe_inverse(vec3 direction) {
    vec3 tiny = mix(vec3(-1e-20), vec3(1e-20), greaterThanEqual(direction, vec3(0.0)));
    return 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(1e-20)));
}

#endif
