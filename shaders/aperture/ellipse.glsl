// An ellipse.

#ifndef ELLIPSE_GLSL
#define ELLIPSE_GLSL

#include "aperture/record.glsl"

vec3 ellipse_point(const vec2 q, const vec2 xi) {
    return vec3(aperture.stretch * lit_disk(xi), 1.0);
}

#endif
