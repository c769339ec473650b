// The nearest shape along a ray, of those in the list: each is tried. The list has the kinds one after the other, and
// the ends of their ranges are specialization constants, so that each loop knows its kind and how often it goes round.

#ifndef LIST_GLSL
#define LIST_GLSL

void keep_nearer(inout Nearest nearest, float distance, uint i) {
    if (distance < nearest.distance) {
        nearest = Nearest(distance, LIST_BEGIN + i);
    }
}

// A bounded shape of the list where it is by now.
#define LISTED_NOW(kind_) \
    ShapeRecord shape = get_listed(i); \
    if (SCENE_MOVES == 1u) { \
        move_##kind_(shape, ray_time * get_velocity(i, shape)); \
    }

void find_bounded(Ray ray, vec3 inverse_direction, inout Nearest nearest) {
#define FIND_BOUNDED(KIND, kind_) \
    [[unroll]] for (uint i = KIND##_BEGIN; i < KIND##_END; ++i) { \
        LISTED_NOW(kind_) \
        keep_nearer(nearest, kind_##_distance(ray, inverse_direction, shape), i); \
    }
    FOR_EACH_BOUNDED_KIND(FIND_BOUNDED)
}

void find_unbounded(Ray ray, vec3 inverse_direction, inout Nearest nearest) {
#define FIND_UNBOUNDED(KIND, kind_) \
    for (uint i = KIND##_BEGIN; i < KIND##_END; ++i) { \
        keep_nearer(nearest, kind_##_distance(ray, inverse_direction, get_listed(i)), i); \
    }
    FOR_EACH_UNBOUNDED_KIND(FIND_UNBOUNDED)
}

// The hit of a shape of a kept list, without a fetch: each kind is looked for among its own, and only for what it
// needs. The index differs from invocation to invocation. A scene with a kept list and no tree has LIST_BEGIN = 0.
Hit hit_in_list(Ray ray, vec3 inverse_direction, Nearest nearest, vec3 position) {
    uint index = nearest.record;
    Hit hit = Hit(nearest.distance, 0u, NO_SURFACE, vec3(0.0));
#define LOOK_UP(value, kept_values, KIND) \
    value = kept_values[KIND##_BEGIN]; \
    [[unroll]] for (uint i = KIND##_BEGIN + 1u; i < KIND##_END; ++i) { \
        if (index == i) { \
            value = kept_values[i]; \
        } \
    }
#define KEEP_HIT(KIND, kind_) \
    Surface surface = kind_##_surface(ray, inverse_direction, shape, position); \
    if (index >= KIND##_BEGIN) { \
        hit = Hit(nearest.distance, shape.material, surface, displacement); \
    }
#define HIT_BOUNDED(KIND, kind_) \
    if (has_kind(SHAPE_KINDS, SHAPE_##KIND)) { \
        ShapeRecord shape; \
        LOOK_UP(shape, kept_shapes, KIND) \
        vec3 displacement = vec3(0.0); \
        if (SCENE_MOVES == 1u) { \
            LOOK_UP(displacement, kept_velocities, KIND) \
            displacement *= ray_time; \
            move_##kind_(shape, displacement); \
        } \
        KEEP_HIT(KIND, kind_) \
    }
#define HIT_UNBOUNDED(KIND, kind_) \
    if (has_kind(SHAPE_KINDS, SHAPE_##KIND)) { \
        ShapeRecord shape; \
        LOOK_UP(shape, kept_shapes, KIND) \
        vec3 displacement = vec3(0.0); \
        KEEP_HIT(KIND, kind_) \
    }
    FOR_EACH_BOUNDED_KIND(HIT_BOUNDED)
    FOR_EACH_UNBOUNDED_KIND(HIT_UNBOUNDED)
    return hit;
}

// For shadows: the distances alone.
float bounded_distance(Ray ray, vec3 inverse_direction) {
    float nearest = MISS;
#define BOUNDED_DISTANCE(KIND, kind_) \
    [[unroll]] for (uint i = KIND##_BEGIN; i < KIND##_END; ++i) { \
        LISTED_NOW(kind_) \
        nearest = smaller(nearest, kind_##_distance(ray, inverse_direction, shape)); \
    }
    FOR_EACH_BOUNDED_KIND(BOUNDED_DISTANCE)
    return nearest;
}

float unbounded_distance(Ray ray, vec3 inverse_direction) {
    float nearest = MISS;
#define UNBOUNDED_DISTANCE(KIND, kind_) \
    for (uint i = KIND##_BEGIN; i < KIND##_END; ++i) { \
        nearest = smaller(nearest, kind_##_distance(ray, inverse_direction, get_listed(i))); \
    }
    FOR_EACH_UNBOUNDED_KIND(UNBOUNDED_DISTANCE)
    return nearest;
}

#endif
