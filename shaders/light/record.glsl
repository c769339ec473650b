// What every kind of light has in common. A kind is a file beside this one with one of these functions:
//
//   LightSample KIND_sample(Light light, vec3 from)
//       What arrives from the light at a point.
//   vec3 KIND_radiance(vec3 direction)
//       What a ray sees that meets nothing.

#ifndef LIGHT_RECORD_GLSL
#define LIGHT_RECORD_GLSL

#include "interface.glsl"

// A light as it lies in its buffer.
struct Light {
    vec3 radiance;
    uint kind;
    vec3 position_or_direction; // up to the kind
};

// What arrives from a light at a point.
struct LightSample {
    vec3 direction; // to the light, of unit length
    float distance; // what lies nearer can keep it off
    vec3 radiance;
};

struct Environment {
    vec3 horizon;
    vec3 zenith;
    vec3 ambient; // radiance
    float reach; // every shape but planes lies within this distance of the origin, at any time
};

// The kinds of lights in the buffer, a bit each: what is for others is left out.
layout(constant_id = ID_LIGHT_KINDS) const uint LIGHT_KINDS = 0u;

#endif
