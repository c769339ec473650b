// Ray against scene. Distances are along unit directions, in scene units.

#ifndef INTERSECT_GLSL
#define INTERSECT_GLSL

#include "scene/scene.glsl"

// The nearest shape so far.
struct Nearest {
    float distance;
    uint record;
};

// What a ray meets first.
struct Hit {
    float distance; // MISS where that is nothing; the rest means nothing then
    uint material;
    Surface surface;
    vec3 displacement; // of the shape from where it is in the middle of the exposure
};

// Moves a bounded shape. What is no shape at all is left as it is.
void move_shape(inout ShapeRecord shape, vec3 displacement) {
#define MOVE(KIND, kind_) \
    if (has_kind(SHAPE_KINDS, SHAPE_##KIND)) { \
        ShapeRecord moved = shape; \
        move_##kind_(moved, displacement); \
        if (is_of_kind(SHAPE_KINDS & BOUNDED_KINDS, shape.kind, SHAPE_##KIND)) { \
            shape = moved; \
        } \
    }
    FOR_EACH_BOUNDED_KIND(MOVE)
}

// A shape where it is by now, and how far it has come.
ShapeRecord shape_now(ShapeRecord shape, out vec3 displacement) {
    displacement = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        displacement = ray_time * fetch_velocity(shape.index);
        move_shape(shape, displacement);
    }
    return shape;
}

#include "scene/bvh.glsl"
#include "scene/list.glsl"

// The hit of a shape whose record is fetched. ray is the one that the shape was found for.
Hit hit_by_fetching(Ray ray, vec3 inverse_direction, Nearest nearest, vec3 position) {
    vec3 displacement;
    ShapeRecord shape = shape_now(fetch_shape(nearest.record), displacement);
    Surface surface = NO_SURFACE;
#define FETCHED_SURFACE(KIND, kind_) \
    if (has_kind(SHAPE_KINDS, SHAPE_##KIND)) { \
        Surface other = kind_##_surface(ray, inverse_direction, shape, position); \
        if (is_of_kind(SHAPE_KINDS, shape.kind, SHAPE_##KIND)) { \
            surface = other; \
        } \
    }
    FOR_EACH_KIND(FETCHED_SURFACE)
    return Hit(nearest.distance, shape.material, surface, displacement);
}

// How far the ray can go before it meets any bounded shape. What intersecting a shape loses to rounding grows
// with the distance, and lets rays from far away through between the triangles of a mesh: so they start there.
float way_to_shapes(Ray ray) {
    if (!has_tree()) {
        return 0.0;
    }
    float to_middle = -dot(ray.origin, ray.direction);
    // The rounding error of the dot product is below a millionth.
    return larger(to_middle * (1.0 - 1e-6) - get_environment().reach, 0.0);
}

// The nearest hit, or one with distance MISS. given_up: the search for it took too long.
Hit intersect_scene(Ray from, inout bool given_up) {
    Nearest nearest = Nearest(MISS, 0u);
    vec3 inverse_direction = safe_inverse(from.direction);
    float start = way_to_shapes(from);
    Ray ray = Ray(from.origin + start * from.direction, from.direction);
    if (has_tree()) {
        nearest.distance = search_tree(ray, inverse_direction, MISS, false, nearest.record, given_up);
    }
    find_bounded(ray, inverse_direction, nearest);
    nearest.distance += start;
    find_unbounded(from, inverse_direction, nearest);
    vec3 position = from.origin + nearest.distance * from.direction;
    if (SCENE_IS_KEPT == 1u && !has_tree()) {
        return hit_in_list(ray, inverse_direction, nearest, position);
    }
    return hit_by_fetching(ray, inverse_direction, nearest, position);
}

// What f32 may lose of a point of a surface, across it, and of an intersection that starts there, as a share of
// the coordinates: sums of up to six products, each rounded by 2^-24.
const float ROUNDING = 9.5367432e-7; // 16 * 2^-24

// The unit normal of the surface at a hit, on either side. position is where the ray meets it. As far as the
// ray is long, it may be off; so it is moved onto the surface. After that it is within error of it.
vec3 settle(Surface surface, inout vec3 position, out float error) {
    float across_length = length(surface.across);
    vec3 normal = surface.across / across_length;
    float height = surface.is_curved
        ? across_length - surface.offset
        : (dot(surface.across, position) - surface.offset) / across_length;
    position -= height * normal;
    vec3 magnitude = abs(position);
    float largest = larger(larger(magnitude.x, magnitude.y), magnitude.z);
    error = ROUNDING * larger(largest, surface.size);
    return normal;
}

// Whether anything lies on the ray nearer than limit.
bool occluded(Ray from, float limit, inout bool given_up) {
    float distance = MISS;
    vec3 inverse_direction = safe_inverse(from.direction);
    float start = way_to_shapes(from);
    Ray ray = Ray(from.origin + start * from.direction, from.direction);
    if (has_tree()) {
        uint shape;
        distance = search_tree(ray, inverse_direction, limit - start, true, shape, given_up);
    }
    distance = smaller(distance, bounded_distance(ray, inverse_direction));
    distance += start;
    return smaller(distance, unbounded_distance(from, inverse_direction)) < limit;
}

#endif
