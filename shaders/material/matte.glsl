// Reflects light evenly into all directions.

#ifndef MATTE_GLSL
#define MATTE_GLSL

#include "scene/surface.glsl"

const float INVERSE_PI = 0.318309886;

vec3 matte_ambient(const Material material, const vec3 color) {
    return material.ka * color;
}

vec3 matte_f(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light,
    const vec3 to_viewer
) {
    return material.kd * INVERSE_PI * color;
}

#endif
