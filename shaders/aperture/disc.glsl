// A disc.

#ifndef DISC_GLSL
#define DISC_GLSL

#include "aperture/record.glsl"

vec3 disc_point(const vec2 q, const vec2 xi) {
    return vec3(lit_disk(xi), 1.0);
}

#endif
