// Intersects rays with the scene. Distances are along unit directions, in scene units.

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
    float distance; // MISS if the ray meets nothing; the other members are meaningless then
    uint material;
    Surface surface;
    vec3 displacement; // how far the shape is from where it is in the middle of the exposure
};

// Moves a bounded shape. Records that are no bounded shapes stay as they are.
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

// The shape where it is at the time of the ray, and its displacement since the middle of the exposure.
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

// Fetches the record of the nearest shape and makes the hit. ray must be the ray that found the shape.
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

// A distance that the ray can go before it meets any bounded shape: where it enters the scene's bounding sphere, or a
// little earlier. The rounding errors of an intersection grow with the distance. They would let rays from far away pass
// between the triangles of a mesh, so rays start at this distance.
float scene_entry_distance(Ray ray) {
    if (!has_tree()) {
        return 0.0;
    }
    float to_closest = -dot(ray.origin, ray.direction);
    // The rounding error of the dot product is below a millionth.
    return larger(to_closest * (1.0 - 1e-6) - get_environment().bounding_radius, 0.0);
}

// The nearest hit, or one with distance MISS. given_up becomes true if the search took too long.
Hit intersect_scene(Ray from, inout bool given_up) {
    Nearest nearest = Nearest(MISS, 0u);
    vec3 inverse_direction = safe_inverse(from.direction);
    float start = scene_entry_distance(from);
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

// An upper bound for the rounding errors of a point on a surface, along the normal, and of an intersection whose ray
// starts there, relative to the coordinates: f32 sums up to six products, and rounds each by 2^-24.
const float ROUNDING = 9.5367432e-7; // 16 * 2^-24

// Moves a hit's position onto the surface, and returns the unit normal there, which may point to either side. The error
// of position on entry grows with the length of the ray. Afterwards position is within `error` of the surface.
vec3 project_onto_surface(Surface surface, inout vec3 position, out float error) {
    float normal_length = length(surface.normal);
    vec3 normal = surface.normal / normal_length;
    float height = surface.is_curved
        ? normal_length - surface.offset
        : (dot(surface.normal, position) - surface.offset) / normal_length;
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
    float start = scene_entry_distance(from);
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
