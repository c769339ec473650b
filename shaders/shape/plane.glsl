// An infinite plane, which does not move: position is its unit normal, and its points x fulfil
// dot(position, x) = a.x. u and v are coordinates in the plane, in scene units: see tangent_coordinates().

#ifndef PLANE_GLSL
#define PLANE_GLSL

#include "shape/record.glsl"

float plane_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord plane) {
    float cosine = dot(plane.position, ray.direction);
    float distance = (plane.a.x - dot(plane.position, ray.origin)) / cosine;
    return cosine != 0.0 && distance > 0.0 && distance < MISS ? distance : MISS;
}

Surface plane_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord plane, const vec3 position) {
    return Surface(plane.position, plane.a.x, false, 0.0, vec3(0.0), tangent_coordinates(plane.position, position));
}

#endif
