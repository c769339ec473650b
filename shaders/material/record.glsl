// What every kind of material has in common. A kind is a file beside this one with those of these functions that it needs:
//
//   vec3 KIND_emission(Material material, vec3 color)
//       The radiance that it gives off by itself, into every direction.
//   vec3 KIND_ambient(Material material, vec3 color)
//       The share of the ambient light that it reflects.
//   vec3 KIND_f(Material material, vec3 color, SurfacePoint at, vec3 to_light, vec3 to_viewer)
//       The share of a light's radiance, by the cosine, that it reflects towards the viewer.
//   Scatter KIND_sample(Material material, vec3 color, SurfacePoint at, vec3 direction)
//       The one direction from which it shows what arrives there, for a ray of this direction that meets it.
//
// color is the material's texture at this point, and the normals at it are as turn_sides has turned them.

#ifndef MATERIAL_RECORD_GLSL
#define MATERIAL_RECORD_GLSL

#include "texture/record.glsl"

// A material as it lies in its buffer. What the numbers mean is up to the kind; one without f has zero for kd and ks.
struct Material {
    Texture color;
    float ka; // ambient reflection
    float kd; // diffuse reflection
    float ks; // specular reflection
    float exponent; // of the highlight
    uint kind;
};

// Where a ray goes on, and by how much what arrives from there counts.
struct Scatter {
    vec3 direction;
    vec3 weight;
};

// The kinds of materials there are, a bit each: what is for others is left out.
layout(constant_id = ID_MATERIAL_KINDS) const uint MATERIAL_KINDS = 0u;

#endif
