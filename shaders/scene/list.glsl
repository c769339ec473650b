// Finds the nearest shape along a ray by testing each shape of the list. The list is sorted by kind, so that each loop
// has one kind.

#ifndef LIST_GLSL
#define LIST_GLSL

void keep_nearer(inout Nearest nearest, const float distance, const uint i) {
    if (distance < nearest.distance) {
        nearest = Nearest(distance, list_begin() + i);
    }
}

// Goes through the shapes of a kind.
#define FOR_EACH_LISTED(KIND) \
    if (HAS_KIND(SHAPE_KINDS, SHAPE_##KIND)) \
        [[unroll]] for (uint i = range_begin(SHAPE_##KIND, KIND##_BEGIN), end = range_end(SHAPE_##KIND, KIND##_END); i < end; ++i)

// A bounded shape of the list, moved to where it is at the time of the ray.
#define LISTED_NOW(kind_) \
    ShapeRecord shape = get_listed(i); \
    if (SCENE_MOVES == 1u) { \
        move_##kind_(shape, ray_time * get_velocity(i, shape)); \
    }

void find_bounded(const Ray ray, const vec3 inverse_direction, inout Nearest nearest) {
#define FIND_BOUNDED(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        LISTED_NOW(kind_) \
        keep_nearer(nearest, kind_##_distance(ray, inverse_direction, shape), i); \
    }
    FOR_EACH_BOUNDED_KIND(FIND_BOUNDED)
}

void find_unbounded(const Ray ray, const vec3 inverse_direction, inout Nearest nearest) {
#define FIND_UNBOUNDED(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        keep_nearer(nearest, kind_##_distance(ray, inverse_direction, get_listed(i)), i); \
    }
    FOR_EACH_UNBOUNDED_KIND(FIND_UNBOUNDED)
}

// Shadow rays need only the distance.
float bounded_distance(const Ray ray, const vec3 inverse_direction) {
    float nearest = MISS;
#define BOUNDED_DISTANCE(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        LISTED_NOW(kind_) \
        nearest = smaller(nearest, kind_##_distance(ray, inverse_direction, shape)); \
    }
    FOR_EACH_BOUNDED_KIND(BOUNDED_DISTANCE)
    return nearest;
}

float unbounded_distance(const Ray ray, const vec3 inverse_direction) {
    float nearest = MISS;
#define UNBOUNDED_DISTANCE(KIND, kind_) \
    FOR_EACH_LISTED(KIND) { \
        nearest = smaller(nearest, kind_##_distance(ray, inverse_direction, get_listed(i))); \
    }
    FOR_EACH_UNBOUNDED_KIND(UNBOUNDED_DISTANCE)
    return nearest;
}

#endif
