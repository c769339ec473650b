// The sky: a gradient from the horizon to the zenith.

#ifndef BACKGROUND_GLSL
#define BACKGROUND_GLSL

#include "scene/scene.glsl"

vec3 background_radiance(const vec3 direction) {
    float height = clamp(direction.y, 0.0, 1.0);
    // Unlike mix(), this returns exactly the same colour if both colours are equal.
    Environment sky = get_environment();
    return sky.horizon + (sky.zenith - sky.horizon) * (height * (2.0 - height));
}

#endif
