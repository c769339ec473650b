// What every kind of texture has in common. Each kind is a file beside this one with a function:
//
//   vec3 KIND_value(Texture of, SurfacePoint at)
//       The texture's colour at a point of a surface.

#ifndef TEXTURE_RECORD_GLSL
#define TEXTURE_RECORD_GLSL

#include "interface.glsl"

// The record of a texture in a material. The kind defines what the numbers mean.
struct Texture {
    vec3 color;
    uint kind;
    vec3 other_color;
    float inverse_size;
    vec3 phase;
};

// The kinds of textures in the scene, a bit for each: the code for all other kinds is left out.
layout(constant_id = ID_TEXTURE_KINDS) const uint TEXTURE_KINDS = 0u;

#endif
