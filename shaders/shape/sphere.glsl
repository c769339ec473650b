// A sphere: position is its centre, a.x its radius. u goes around the y axis, starting where z = 0 and x < 0, and v
// goes from the south pole to the north pole, both from 0 to 1.

#ifndef SPHERE_GLSL
#define SPHERE_GLSL

#include "shape/record.glsl"

// The quadratic equation is solved with a discriminant from the point of closest approach, which is precise even for
// small and distant spheres: E. Haines et al., Ray Tracing Gems, chapter 7.
float sphere_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord sphere) {
    float radius = sphere.a.x;
    vec3 to_origin = ray.origin - sphere.position;
    float along = -dot(to_origin, ray.direction);
    vec3 closest = to_origin + along * ray.direction;
    float discriminant = radius * radius - dot(closest, closest);
    float half_chord = sqrt(larger(discriminant, 0.0));
    float near = along - half_chord;
    float far = along + half_chord;
    float distance = near > 0.0 ? near : far;
    return discriminant > 0.0 && distance > 0.0 ? distance : MISS;
}

Surface sphere_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord sphere, const vec3 position) {
    float radius = sphere.a.x;
    vec3 from_centre = position - sphere.position;
    vec2 uv = vec2(0.5 + atan(from_centre.z, from_centre.x) / 6.28318531, 0.5 + asin(clamp(from_centre.y / radius, -1.0, 1.0)) / 3.14159265);
    return Surface(from_centre, radius, true, radius, vec3(0.0), uv);
}

void move_sphere(inout ShapeRecord sphere, const vec3 displacement) {
    sphere.position += displacement;
}

vec3 sphere_point(const ShapeRecord sphere, const vec2 xi, out vec3 normal) {
    normal = in_cone(xi, -1.0);
    return sphere.position + sphere.a.x * normal;
}

#endif
