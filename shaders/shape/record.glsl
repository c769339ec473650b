// What every kind of shape has in common. Each kind is a file beside this one with two functions:
//
//   float KIND_distance(Ray ray, vec3 inverse_direction, ShapeRecord shape)
//       The distance along the ray to the nearest point of the shape in front of the ray's origin; MISS if there is
//       none. inverse_direction is safe_inverse(ray.direction).
//   Surface KIND_surface(Ray ray, vec3 inverse_direction, ShapeRecord shape, vec3 position)
//       The surface at that point. The error of position grows with the length of the ray.
//
// A kind that can move also has
//
//   void move_KIND(inout ShapeRecord shape, vec3 displacement)
//
// and one that can be a lamp has
//
//   vec3 KIND_point(ShapeRecord shape, vec2 xi, out vec3 normal)
//       A point of the surface, chosen evenly by two values in [0, 1), and the unit normal there, to either side.

#ifndef RECORD_GLSL
#define RECORD_GLSL

#include "core/ray.glsl"
#include "core/warp.glsl"

// The record of a shape, in the list or in the tree. The kind defines what position, a and b mean.
struct ShapeRecord {
    vec3 position;
    uint material;
    vec3 a;
    uint kind;
    vec3 b;
    uint index; // the index of the velocity and, for shapes of the tree, of the corner normals
};

// The surface of a shape near a point x of it. On a flat surface, all points x fulfil dot(normal, x) = offset. On a
// curved surface, normal goes from the centre of the sphere, or from the nearest point of the cylinder's axis, to x,
// and offset is the distance of the surface from there.
struct Surface {
    vec3 normal; // of any length
    float offset;
    bool is_curved;
    float size; // the magnitude of the numbers that the surface was computed from, along an axis
    vec3 shading_normal; // of unit length; zero if it is the same as the normal
    vec2 uv; // surface coordinates, as the kind defines them
};

// Two tangents, which are perpendicular to a unit normal and to each other. They are the world's axes x
// and z, turned as the normal is turned from the vertical. T. Duff et al., "Building an Orthonormal Basis, Revisited",
// JCGT 6(1), 2017, with y upwards.
void find_tangents(const vec3 n, out vec3 first, out vec3 second) {
    float up = n.y < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (up + n.y);
    float b = n.x * n.z * a;
    first = vec3(1.0 + up * n.x * n.x * a, -up * n.x, up * b);
    second = up * vec3(b, -n.z, up + n.z * n.z * a);
}

// The coordinates of a vector along these tangents.
vec2 tangent_coordinates(const vec3 n, const vec3 vector) {
    vec3 first, second;
    find_tangents(n, first, second);
    return vec2(dot(first, vector), dot(second, vector));
}

// The vector with these coordinates along the tangents of a unit normal, and along the normal.
vec3 around_normal(const vec3 n, const vec3 coordinates) {
    vec3 first, second;
    find_tangents(n, first, second);
    return coordinates.x * first + coordinates.y * second + coordinates.z * n;
}

const Surface NO_SURFACE = Surface(vec3(0.0), 0.0, false, 0.0, vec3(0.0), vec2(0.0));

#endif
