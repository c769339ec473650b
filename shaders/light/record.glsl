// What every kind of light has in common. Each kind is a file beside this one with one of these functions:
//
//   LightSample KIND_sample(Light light, vec3 from)
//       The light that arrives at the point `from`.
//   vec3 KIND_radiance(vec3 direction)
//       The radiance along a ray that meets no surface.

#ifndef LIGHT_RECORD_GLSL
#define LIGHT_RECORD_GLSL

#include "interface.glsl"

// The record of a light in the buffer of lights.
struct Light {
    vec3 radiance;
    uint kind;
    vec3 position_or_direction; // as the kind defines it
};

// The light that arrives from a light source at a point.
struct LightSample {
    vec3 direction; // to the light, of unit length
    float distance; // shapes that are nearer can cast a shadow
    vec3 radiance;
};

struct Environment {
    vec3 horizon;
    vec3 zenith;
    vec3 ambient; // radiance
    float bounding_radius; // every shape but planes lies within this distance of the origin, at any time
    uvec2 panorama_size; // columns and rows
    float panorama_scale; // what the texels are multiplied by
    float panorama_turns; // by how much the sky is turned anticlockwise, as seen from above
};

// The kinds of lights in the buffer, a bit for each: the code for all other kinds is left out.
layout(constant_id = ID_LIGHT_KINDS) const uint LIGHT_KINDS = 0u;

#endif
