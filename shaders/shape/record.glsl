// What every kind of shape has in common. A kind is a file beside this one with two functions:
//
//   float KIND_distance(Ray ray, vec3 inverse_direction, ShapeRecord shape)
//       The distance along the ray to the nearest point of the shape before its origin; MISS if there is none.
//       inverse_direction is safe_inverse(ray.direction).
//   Surface KIND_surface(Ray ray, vec3 inverse_direction, ShapeRecord shape, vec3 position)
//       The surface at that point. The position may be off as far as the ray is long.
//
// A kind that can move also has
//
//   void move_KIND(inout ShapeRecord shape, vec3 displacement)

#ifndef RECORD_GLSL
#define RECORD_GLSL

#include "core/ray.glsl"

// A shape as it lies in lists and in the tree. What position, a and b mean is up to the kind.
struct ShapeRecord {
    vec3 position;
    uint material;
    vec3 a;
    uint kind;
    vec3 b;
    uint index; // of its velocity, and in the tree of its corner normals
};

// The surface of a shape near a point x of it. Where it is flat, its points have dot(across, x) = offset. Where it is
// curved, across goes from the centre, or from the nearest point of the axis, to x, and the points of the surface
// are at the distance offset from there.
struct Surface {
    vec3 across; // of any length
    float offset;
    bool is_curved;
    float size; // of the numbers that it was computed from, along an axis
    vec3 shading_normal; // of unit length; zero: the surface's own
    vec2 uv; // where on the shape: see the kinds
};

// The coordinates of a vector along two directions across a unit normal: the world's axes x and z where that points up
// or down, and turned with it elsewhere. T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017,
// with y upwards.
vec2 across_normal(vec3 n, vec3 vector) {
    float up = n.y < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (up + n.y);
    float b = n.x * n.z * a;
    vec3 first = vec3(1.0 + up * n.x * n.x * a, -up * n.x, up * b);
    vec3 second = up * vec3(b, -n.z, up + n.z * n.z * a);
    return vec2(dot(first, vector), dot(second, vector));
}

const Surface NO_SURFACE = Surface(vec3(0.0), 0.0, false, 0.0, vec3(0.0), vec2(0.0));

#endif
