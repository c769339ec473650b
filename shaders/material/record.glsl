// What every kind of material has in common. Each kind is a file beside this one, with the functions that it needs out
// of these:
//
//   vec3 KIND_emission(Material material, vec3 color)
//       The radiance that the material emits, the same in every direction.
//   vec3 KIND_ambient(Material material, vec3 color)
//       The share of the ambient light that the material reflects.
//   vec3 KIND_f(Material material, vec3 color, SurfacePoint at, vec3 to_light, vec3 to_viewer)
//       The BRDF: the radiance reflected towards the viewer, divided by the light's radiance and by the cosine.
//   Scatter KIND_mirrored(Material material, vec3 color, SurfacePoint at, vec3 to_viewer)
//       The direction of the mirror image that the viewer sees.
//   Scatter KIND_sample(Material material, vec3 color, SurfacePoint at, vec3 to_viewer, vec3 xi)
//       A random direction from which light is scattered towards the viewer, chosen by three values in [0, 1).
//   Scattered KIND_scattered(Material material, vec3 color, SurfacePoint at, vec3 to_light, vec3 to_viewer)
//       The light that is scattered from another direction. A kind without it scatters into single directions only.
//
// color is the value of the material's texture at the point. face_forward() has turned the normals at the point.

#ifndef MATERIAL_RECORD_GLSL
#define MATERIAL_RECORD_GLSL

#include "texture/record.glsl"

// The record of a material in the buffer of materials. The kind defines what the numbers mean. Where a kind has no
// function f, kd and ks are zero.
struct Material {
    Texture color;
    float ka; // ambient reflection
    float kd; // diffuse reflection
    float ks; // specular reflection
    float exponent; // the exponent of the highlight
    uint kind;
    float roughness; // from 0 to 1
    float index; // the refractive index
    float metallic; // from 0 to 1, the share of metal in a mixture
};

// A direction from which light comes that is scattered towards the viewer, and the weight of its radiance: of a random
// direction, the BRDF times the cosine, divided by the probability density.
struct Scatter {
    vec3 direction;
    vec3 weight;
    float density; // per solid angle; 0 where the material scatters into single directions
};

const Scatter NO_SCATTER = Scatter(vec3(0.0), vec3(0.0), 0.0);

// What a material scatters from one direction towards the viewer.
struct Scattered {
    vec3 share; // the BRDF times the cosine
    float density; // with which KIND_sample() chooses this direction, per solid angle
};

// The kinds of materials in the scene, a bit for each: the code for all other kinds is left out.
layout(constant_id = ID_MATERIAL_KINDS) const uint MATERIAL_KINDS = 0u;

#endif
