// A triangle, visible from both sides: position is its first corner, which is opposite the longest edge. a and b are
// the edges from there to the second and the third corner. u and v are the barycentric coordinates that belong to
// these two corners.

#ifndef TRIANGLE_GLSL
#define TRIANGLE_GLSL

#include "shape/record.glsl"

// Normals at the corners of the tree's triangles, three texels for each triangle. Zeros stand for the triangle's own
// normal.
layout(set = 0, binding = BINDING_CORNER_NORMALS) uniform usamplerBuffer corner_normals;

// Whether any triangle has such normals.
layout(constant_id = ID_HAS_CORNER_NORMALS) const uint HAS_CORNER_NORMALS = 0u;

// T. Moeller and B. Trumbore, JGT 2(1), 1997, for both sides. barycentric belongs to the second and third corner.
float intersect_triangle(const Ray ray, const ShapeRecord triangle, out vec2 barycentric) {
    vec3 h = cross(ray.direction, triangle.b);
    float determinant = dot(triangle.a, h);
    float inverse_determinant = 1.0 / determinant;
    vec3 s = ray.origin - triangle.position;
    float b1 = dot(s, h) * inverse_determinant;
    vec3 q = cross(s, triangle.a);
    float b2 = dot(ray.direction, q) * inverse_determinant;
    float distance = dot(triangle.b, q) * inverse_determinant;
    barycentric = vec2(b1, b2);
    // A ray in the triangle's plane must be detected by the determinant, because a driver may assume that there are no
    // infinities and no NaNs.
    return determinant != 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && distance > 0.0 && distance < MISS ? distance : MISS;
}

float triangle_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord triangle) {
    vec2 barycentric;
    return intersect_triangle(ray, triangle, barycentric);
}

// The unit shading normal of a triangle with normals at its corners. It is interpolated linearly and lies on the same
// side as the triangle's own normal, which replaces it where the corner normals cancel out.
vec3 interpolated_normal(const uint index, const vec2 barycentric, const vec3 own) {
    vec3 sum = vec3(0.0);
    vec3 weights = vec3(1.0 - barycentric.x - barycentric.y, barycentric);
    [[unroll]] for (uint corner = 0u; corner < 3u; ++corner) {
        sum += weights[corner] * uintBitsToFloat(texelFetch(corner_normals, int(3u * index + corner)).xyz);
    }
    sum = sum == vec3(0.0) ? own : sum;
    return normalize(dot(sum, own) < 0.0 ? -sum : sum);
}

Surface triangle_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord triangle, const vec3 position) {
    vec3 normal = cross(triangle.a, triangle.b);
    vec3 longest = max(abs(triangle.a), abs(triangle.b));
    float size = larger(longest.x, larger(longest.y, longest.z));
    float offset = dot(normal, triangle.position);
    vec2 barycentric;
    intersect_triangle(ray, triangle, barycentric);
    vec3 shading_normal = vec3(0.0);
    if (HAS_CORNER_NORMALS == 1u) {
        shading_normal = interpolated_normal(triangle.index, barycentric, normal);
    }
    return Surface(normal, offset, false, size, shading_normal, barycentric);
}

vec3 triangle_point(const ShapeRecord triangle, const vec2 xi, out vec3 normal) {
    normal = normalize(cross(triangle.a, triangle.b));
    float from_corner = sqrt(xi.x);
    return triangle.position + from_corner * ((1.0 - xi.y) * triangle.a + xi.y * triangle.b);
}

void move_triangle(inout ShapeRecord triangle, const vec3 displacement) {
    triangle.position += displacement;
}

#endif
