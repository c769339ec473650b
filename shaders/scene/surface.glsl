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
    vec3 offset_position; // the position, moved off the surface by error: where further rays start
    vec3 rest_position; // the same point of the shape, where it is in the middle of the exposure
    bool from_behind; // whether the ray comes from the side that the shape's own normal points away from
    float index_ratio; // the refractive index beyond the surface, divided by that on the side that the ray comes from
};

// The point where the ray meets a surface. The normals point as those of the shape do: face_forward() turns them, and
// moves offset_position off the surface.
SurfacePoint surface_point(const Ray ray, const Hit hit) {
    SurfacePoint at;
    at.position = ray.origin + hit.distance * ray.direction;
    at.normal = project_onto_surface(hit.surface, at.position, at.error);
    at.rest_position = at.position;
    if (SCENE_MOVES == 1u) {
        at.rest_position -= hit.displacement;
    }
    at.shading_normal = hit.surface.shading_normal == vec3(0.0) ? at.normal : hit.surface.shading_normal;
    at.offset_position = at.position;
    at.from_behind = false;
    at.index_ratio = 1.0;
    return at;
}

// Where a ray in this direction starts: off the surface, on the side that the direction points to.
vec3 start_towards(const SurfacePoint at, const vec3 direction) {
    return at.position + (dot(direction, at.normal) < 0.0 ? -at.error : at.error) * at.normal;
}

#endif
