// Emits light of the material's color.

#ifndef EMISSIVE_GLSL
#define EMISSIVE_GLSL

#include "scene/surface.glsl"

vec3 emissive_emission(const Material material, const vec3 color) {
    return color;
}

#endif
