// A plane, which has no end and does not move: position is its unit normal, and its points x have
// dot(position, x) = a.x. u and v are coordinates in the plane, in scene units: along the world's axes x and z of a
// level plane, and of others along directions that are turned with the normal from these.

#ifndef PLANE_GLSL
#define PLANE_GLSL

#include "shape/record.glsl"

float plane_distance(Ray ray, vec3 inverse_direction, ShapeRecord plane) {
    float cosine = dot(plane.position, ray.direction);
    float distance = (plane.a.x - dot(plane.position, ray.origin)) / cosine;
    return cosine != 0.0 && distance > 0.0 && distance < MISS ? distance : MISS;
}

// T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, with y upwards.
Surface plane_surface(Ray ray, vec3 inverse_direction, ShapeRecord plane, vec3 position) {
    vec3 n = plane.position;
    float up = n.y < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (up + n.y);
    float b = n.x * n.z * a;
    vec3 along_u = vec3(1.0 + up * n.x * n.x * a, -up * n.x, up * b);
    vec3 along_v = vec3(b, -n.z, up + n.z * n.z * a);
    return Surface(n, plane.a.x, false, 0.0, vec3(0.0), vec2(dot(along_u, position), dot(along_v, position)));
}

#endif
