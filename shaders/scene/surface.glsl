// Points of surfaces, as materials and textures see them.

#ifndef SURFACE_GLSL
#define SURFACE_GLSL

#include "scene/intersect.glsl"

// A point of a surface. Both normals are of unit length.
struct SurfacePoint {
    vec3 position;
    vec3 normal;
    vec3 shading_normal;
    float error; // how far off the surface the position may be
    vec3 lifted; // the position, moved off the surface by this much
    vec3 on_shape; // the position where the shape was in the middle of the exposure
};

// Where the ray meets a surface, with the normals as the shape has them. The material says what its sides mean, and
// lifts it.
SurfacePoint surface_point(Ray ray, Hit hit) {
    SurfacePoint at;
    at.position = ray.origin + hit.distance * ray.direction;
    at.normal = settle(hit.surface, at.position, at.error);
    at.on_shape = at.position;
    if (SCENE_MOVES == 1u) {
        at.on_shape -= hit.displacement;
    }
    at.shading_normal = hit.surface.shading_normal == vec3(0.0) ? at.normal : hit.surface.shading_normal;
    at.lifted = at.position;
    return at;
}

#endif
