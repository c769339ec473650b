// The same colour everywhere.

#ifndef CONSTANT_GLSL
#define CONSTANT_GLSL

#include "scene/surface.glsl"

vec3 constant_value(const Texture of, const SurfacePoint at) {
    return of.color;
}

#endif
