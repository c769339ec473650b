// The aperture, through which light comes in. Each kind is a file beside this one: see record.glsl.

#ifndef APERTURE_GLSL
#define APERTURE_GLSL

#include "aperture/kinds.glsl"

// A point of the aperture, and in z the share of the light through it that reaches the film point q.
vec3 aperture_point(const vec2 q, const vec2 xi) {
#define KIND_POINT(KIND, kind_) \
    if (APERTURE == APERTURE_##KIND) { \
        return kind_##_point(q, xi); \
    }
    FOR_EACH_APERTURE_POINT(KIND_POINT)
    return vec3(0.0); // there is no other kind
}

#endif
