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
    uint kind; // of the shape
    Surface surface;
    vec3 displacement; // how far the shape is from where it is in the middle of the exposure
};

#include "scene/bvh.glsl"
#include "scene/list.glsl"

// Whether there are copies of all shapes, so that a hit needs no fetch. LIST_BEGIN is 0 then.
bool all_shapes_are_kept() {
    return SCENE_IS_KEPT == 1u && !has_tree();
}

// The hit of the nearest shape. ray must be the ray that found it. A shape's index differs from invocation to
// invocation, so copies are gone through instead of indexed: each kind goes through its own, and reads only the members
// that it needs.
Hit hit_of(const Ray ray, const vec3 inverse_direction, const Nearest nearest, const vec3 position) {
    Hit hit = Hit(nearest.distance, 0u, 0u, NO_SURFACE, vec3(0.0));
    ShapeRecord fetched;
    vec3 fetched_velocity = vec3(0.0);
    if (!all_shapes_are_kept()) {
        fetched = fetch_shape(nearest.record);
        if (SCENE_MOVES == 1u) {
            fetched_velocity = fetch_velocity(fetched.index);
        }
    }
#define LOOK_UP(value, kept_values, KIND) \
    value = kept_values[KIND##_BEGIN]; \
    [[unroll]] for (uint i = KIND##_BEGIN + 1u; i < KIND##_END; ++i) { \
        if (nearest.record == i) { \
            value = kept_values[i]; \
        } \
    }
#define FIND_RECORD(KIND) \
    ShapeRecord shape = fetched; \
    if (all_shapes_are_kept()) { \
        LOOK_UP(shape, kept_shapes, KIND) \
    }
#define KEEP_HIT(KIND, kind_) \
    Surface surface = kind_##_surface(ray, inverse_direction, shape, position); \
    if (all_shapes_are_kept() ? nearest.record >= KIND##_BEGIN : IS_OF_KIND(SHAPE_KINDS, shape.kind, SHAPE_##KIND)) { \
        hit = Hit(nearest.distance, shape.material, SHAPE_##KIND, surface, displacement); \
    }
#define HIT_BOUNDED(KIND, kind_) \
    if (HAS_KIND(SHAPE_KINDS, SHAPE_##KIND)) { \
        FIND_RECORD(KIND) \
        vec3 displacement = vec3(0.0); \
        if (SCENE_MOVES == 1u) { \
            vec3 velocity = fetched_velocity; \
            if (all_shapes_are_kept()) { \
                LOOK_UP(velocity, kept_velocities, KIND) \
            } \
            displacement = ray_time * velocity; \
            move_##kind_(shape, displacement); \
        } \
        KEEP_HIT(KIND, kind_) \
    }
#define HIT_UNBOUNDED(KIND, kind_) \
    if (HAS_KIND(SHAPE_KINDS, SHAPE_##KIND)) { \
        FIND_RECORD(KIND) \
        vec3 displacement = vec3(0.0); \
        KEEP_HIT(KIND, kind_) \
    }
    FOR_EACH_BOUNDED_KIND(HIT_BOUNDED)
    FOR_EACH_UNBOUNDED_KIND(HIT_UNBOUNDED)
    return hit;
}

// A distance that the ray can go before it meets any bounded shape: where it enters the scene's bounding sphere, or a
// little earlier. The rounding errors of an intersection grow with the distance. They would let rays from far away pass
// between the triangles of a mesh, so rays start at this distance.
float scene_entry_distance(const Ray ray) {
    if (!has_tree()) {
        return 0.0;
    }
    float to_closest = -dot(ray.origin, ray.direction);
    // The rounding error of the dot product is below a millionth.
    return larger(to_closest * (1.0 - 1e-6) - get_environment().bounding_radius, 0.0);
}

// The nearest hit, or one with distance MISS. given_up becomes true if the search took too long.
Hit intersect_scene(const Ray from, inout bool given_up) {
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
    return hit_of(ray, inverse_direction, nearest, position);
}

// An upper bound for the rounding errors of a point on a surface, along the normal, and of an intersection whose ray
// starts there, relative to the coordinates: f32 sums up to six products, and rounds each by 2^-24.
const float ROUNDING = 9.5367432e-7; // 16 * 2^-24

// Moves a hit's position onto the surface, and returns the unit normal there, which may point to either side. The error
// of position on entry grows with the length of the ray. Afterwards position is within `error` of the surface.
vec3 project_onto_surface(const Surface surface, inout vec3 position, out float error) {
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
bool occluded(const Ray from, const float limit, inout bool given_up) {
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
