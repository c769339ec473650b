// The side of a cylinder, open at both ends and visible from inside too: Suffern, chapter 19. position is the middle of
// the axis, a the unit direction of the axis, b.x the radius, b.y half the length. u goes around the axis and v along
// it, both from 0 to 1.

#ifndef CYLINDER_GLSL
#define CYLINDER_GLSL

#include "shape/record.glsl"

// The component of a vector that is perpendicular to the axis.
vec3 perpendicular_to_axis(const ShapeRecord cylinder, const vec3 vector) {
    return vector - dot(vector, cylinder.a) * cylinder.a;
}

// The equation is that of the sphere, in the plane perpendicular to the axis.
float cylinder_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord cylinder) {
    vec3 to_origin = ray.origin - cylinder.position;
    vec3 origin = perpendicular_to_axis(cylinder, to_origin);
    vec3 direction = perpendicular_to_axis(cylinder, ray.direction);
    float squared = dot(direction, direction);
    // A ray along the axis meets nothing.
    float inverse_squared = 1.0 / larger(squared, 1e-12);
    float along = -dot(origin, direction) * inverse_squared;
    vec3 closest = origin + along * direction;
    float discriminant = cylinder.b.x * cylinder.b.x - dot(closest, closest);
    float half_chord = sqrt(larger(discriminant, 0.0) * inverse_squared);
    float near = along - half_chord;
    float far = along + half_chord;
    float height = dot(to_origin, cylinder.a);
    float climb = dot(ray.direction, cylinder.a);
    bool meets_near = near > 0.0 && abs(height + near * climb) <= cylinder.b.y;
    bool meets_far = far > 0.0 && abs(height + far * climb) <= cylinder.b.y;
    float distance = meets_near ? near : far;
    return squared > 1e-12 && discriminant > 0.0 && (meets_near || meets_far) ? distance : MISS;
}

Surface cylinder_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord cylinder, const vec3 position) {
    vec3 from_middle = position - cylinder.position;
    vec3 from_axis = perpendicular_to_axis(cylinder, from_middle);
    vec2 turned = tangent_coordinates(cylinder.a, from_axis);
    float v = 0.5 + 0.5 * dot(from_middle, cylinder.a) / cylinder.b.y;
    vec2 uv = vec2(0.5 + atan(turned.y, turned.x) / 6.28318531, v);
    return Surface(from_axis, cylinder.b.x, true, cylinder.b.x + cylinder.b.y, vec3(0.0), uv);
}

vec3 cylinder_point(const ShapeRecord cylinder, const vec2 xi, out vec3 normal) {
    normal = around_normal(cylinder.a, vec3(on_circle(xi.x), 0.0));
    return cylinder.position + cylinder.b.x * normal + (2.0 * xi.y - 1.0) * cylinder.b.y * cylinder.a;
}

void move_cylinder(inout ShapeRecord cylinder, const vec3 displacement) {
    cylinder.position += displacement;
}

#endif
