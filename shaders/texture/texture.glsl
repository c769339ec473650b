// Textures, which are the colours of surfaces. Each kind is a file beside this one: see record.glsl.

#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL

#include "texture/kinds.glsl"

// The colour at a point of a surface.
vec3 texture_value(const Texture of, const SurfacePoint at) {
    vec3 value = vec3(0.0);
#define VALUE(KIND, kind_) \
    if (IS_OF_KIND(TEXTURE_KINDS, of.kind, TEXTURE_##KIND)) { \
        value = kind_##_value(of, at); \
    }
    FOR_EACH_TEXTURE_VALUE(VALUE)
    return value;
}

#endif
