// A rectangle, visible from both sides: position is a corner, a and b are the two edges from there, which are
// perpendicular. u and v go along these edges, from 0 to 1.

#ifndef RECTANGLE_GLSL
#define RECTANGLE_GLSL

#include "shape/record.glsl"

// The coordinates along the edges of a vector from the corner.
vec2 along_edges(const ShapeRecord rectangle, const vec3 from_corner) {
    vec2 squared = vec2(dot(rectangle.a, rectangle.a), dot(rectangle.b, rectangle.b));
    return vec2(dot(from_corner, rectangle.a), dot(from_corner, rectangle.b)) / squared;
}

float rectangle_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord rectangle) {
    vec3 normal = cross(rectangle.a, rectangle.b);
    vec3 to_corner = rectangle.position - ray.origin;
    float slope = dot(normal, ray.direction);
    float distance = dot(normal, to_corner) / slope;
    vec2 uv = along_edges(rectangle, distance * ray.direction - to_corner);
    bool is_inside = uv.x >= 0.0 && uv.y >= 0.0 && uv.x <= 1.0 && uv.y <= 1.0;
    // A ray in the plane must be detected by the slope: a driver may assume that there are no infinities.
    return slope != 0.0 && is_inside && distance > 0.0 && distance < MISS ? distance : MISS;
}

Surface rectangle_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord rectangle, const vec3 position) {
    vec3 normal = cross(rectangle.a, rectangle.b);
    vec3 longest = max(abs(rectangle.a), abs(rectangle.b));
    float size = larger(longest.x, larger(longest.y, longest.z));
    vec2 uv = along_edges(rectangle, position - rectangle.position);
    return Surface(normal, dot(normal, rectangle.position), false, size, vec3(0.0), uv);
}

vec3 rectangle_point(const ShapeRecord rectangle, const vec2 xi, out vec3 normal) {
    normal = normalize(cross(rectangle.a, rectangle.b));
    return rectangle.position + xi.x * rectangle.a + xi.y * rectangle.b;
}

void move_rectangle(inout ShapeRecord rectangle, const vec3 displacement) {
    rectangle.position += displacement;
}

#endif
