// A flat disc, visible from both sides: position is its centre, a its unit normal, b.x its radius. u and v are
// coordinates along the tangents of find_tangents(), from 0 to 1 in the square around the disc.

#ifndef SHAPE_DISC_GLSL
#define SHAPE_DISC_GLSL

#include "shape/record.glsl"

float disc_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord disc) {
    vec3 to_centre = disc.position - ray.origin;
    float slope = dot(disc.a, ray.direction);
    float distance = dot(disc.a, to_centre) / slope;
    vec3 from_centre = distance * ray.direction - to_centre;
    bool is_inside = dot(from_centre, from_centre) <= disc.b.x * disc.b.x;
    // A ray in the plane must be detected by the slope: a driver may assume that there are no infinities.
    return slope != 0.0 && is_inside && distance > 0.0 && distance < MISS ? distance : MISS;
}

Surface disc_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord disc, const vec3 position) {
    vec2 uv = 0.5 + 0.5 * tangent_coordinates(disc.a, position - disc.position) / disc.b.x;
    return Surface(disc.a, dot(disc.a, disc.position), false, disc.b.x, vec3(0.0), uv);
}

vec3 disc_point(const ShapeRecord disc, const vec2 xi, out vec3 normal) {
    normal = disc.a;
    return disc.position + around_normal(disc.a, vec3(disc.b.x * concentric_disk(xi), 0.0));
}

void move_disc(inout ShapeRecord disc, const vec3 displacement) {
    disc.position += displacement;
}

#endif
