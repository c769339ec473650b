// Light from a point. It does not weaken with distance.

#ifndef POINT_GLSL
#define POINT_GLSL

#include "scene/scene.glsl"

LightSample point_sample(const Light light, const vec3 from) {
    vec3 to_light = light.position_or_direction - from;
    float distance = length(to_light);
    return LightSample(to_light / distance, distance, light.radiance);
}

#endif
