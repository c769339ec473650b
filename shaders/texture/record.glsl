// What every kind of texture has in common. A kind is a file beside this one with a function:
//
//   vec3 KIND_value(Texture of, SurfacePoint at)
//       Its colour at a point of a surface.

#ifndef TEXTURE_RECORD_GLSL
#define TEXTURE_RECORD_GLSL

#include "interface.glsl"

// A texture as it lies in a material. What the numbers mean is up to the kind.
struct Texture {
    vec3 color;
    uint kind;
    vec3 other_color;
    float inverse_size;
    vec3 phase;
};

// The kinds of textures there are, a bit each: what is for others is left out.
layout(constant_id = ID_TEXTURE_KINDS) const uint TEXTURE_KINDS = 0u;

#endif
