// Lights. Each kind is a file beside this one: see record.glsl.

#ifndef LIGHT_GLSL
#define LIGHT_GLSL

#include "light/kinds.glsl"

// The light that arrives from a light source at a point.
LightSample light_sample(const Light light, const vec3 from) {
    LightSample value = LightSample(vec3(0.0), 0.0, vec3(0.0));
#define SAMPLE_LIGHT(KIND, kind_) \
    if (IS_OF_KIND(LIGHT_KINDS, light.kind, LIGHT_##KIND)) { \
        value = kind_##_sample(light, from); \
    }
    FOR_EACH_LIGHT_SAMPLE(SAMPLE_LIGHT)
    return value;
}

// The radiance along a ray that meets no surface.
vec3 background(const vec3 direction) {
    vec3 sum = vec3(0.0);
#define ADD_BACKGROUND(KIND, kind_) sum += kind_##_radiance(direction);
    FOR_EACH_LIGHT_RADIANCE(ADD_BACKGROUND)
    return sum;
}

#endif
