// Finds the nearest shape along a ray by testing each shape of the list. The list is sorted by kind, so that each loop
// has one kind.

#ifndef LIST_GLSL
#define LIST_GLSL

void keep_nearer(inout Nearest nearest, float distance, uint i) {
    if (distance < nearest.distance) {
        nearest = Nearest(distance, list_begin() + i);
    }
}

// Goes through the shapes of a kind.
#define FOR_EACH_LISTED(KIND) \
    if (has_kind(SHAPE_KINDS, SHAPE_##KIND)) \
        [[unroll]] for (uint i = range_begin(SHAPE_##KIND, KIND##_BEGIN), end = range_end(SHAPE_##KIND, KIND##_END); i < end; ++i)

// A bounded shape of the list, moved to where it is at the time of the ray.
#define LISTED_NOW(kind_) \
    ShapeRecord shape = get_listed(i); \
    if (SCENE_MOVES == 1u) { \
        move_##kind_(shape, ray_time * get_velocity(i, shape)); \
    }

void find_bounded(Ray ray, vec3 inverse_direction, inout Nearest nearest) {
#define FIND_BOUNDED(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        LISTED_NOW(kind_) \
        keep_nearer(nearest, kind_##_distance(ray, inverse_direction, shape), i); \
    }
    FOR_EACH_BOUNDED_KIND(FIND_BOUNDED)
}

void find_unbounded(Ray ray, vec3 inverse_direction, inout Nearest nearest) {
#define FIND_UNBOUNDED(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        keep_nearer(nearest, kind_##_distance(ray, inverse_direction, get_listed(i)), i); \
    }
    FOR_EACH_UNBOUNDED_KIND(FIND_UNBOUNDED)
}

// The hit of a shape in a list that was copied, without a fetch. Each kind searches the range of its own shapes, and
// reads only the copies that it needs. The index differs from invocation to invocation, so the copies are gone through
// instead of indexed. A scene with a copied list and no tree has LIST_BEGIN = 0.
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

// Shadow rays need only the distance.
float bounded_distance(Ray ray, vec3 inverse_direction) {
    float nearest = MISS;
#define BOUNDED_DISTANCE(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        LISTED_NOW(kind_) \
        nearest = smaller(nearest, kind_##_distance(ray, inverse_direction, shape)); \
    }
    FOR_EACH_BOUNDED_KIND(BOUNDED_DISTANCE)
    return nearest;
}

float unbounded_distance(Ray ray, vec3 inverse_direction) {
    float nearest = MISS;
#define UNBOUNDED_DISTANCE(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        nearest = smaller(nearest, kind_##_distance(ray, inverse_direction, get_listed(i))); \
    }
    FOR_EACH_UNBOUNDED_KIND(UNBOUNDED_DISTANCE)
    return nearest;
}

#endif
