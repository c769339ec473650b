// Light along parallel lines, from a source that is farther away than every shape.

#ifndef DIRECTIONAL_GLSL
#define DIRECTIONAL_GLSL

#include "scene/scene.glsl"

LightSample directional_sample(const Light light, const vec3 from) {
    return LightSample(light.position_or_direction, MISS, light.radiance);
}

#endif
