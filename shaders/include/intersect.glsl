// Ray against shape, and ray against scene. Distances are along unit directions, in scene units.

#ifndef INTERSECT_GLSL
#define INTERSECT_GLSL

#include "camera.glsl"
#include "scene.glsl"

const float MISS = 1e30;

// Not min() and max(): what those must do with a NaN costs a software device three instructions more.
float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a > b ? a : b; }

// A sphere stores its centre negated with curvature 1, flat shapes their normal with curvature 0
// (see surface_normal). So the shape loops keep what they have at hand, and nothing is fetched again
// by a diverging index.
struct Hit {
    float distance;
    uint material;
    vec3 normal;
    float curvature;
    vec3 shading_normal; // zero: the surface's own
    vec3 way; // how far the shape has come by now
};

// The quadratic with the discriminant taken from the closest approach, which keeps its digits for
// small and far spheres: E. Haines et al., Ray Tracing Gems, chapter 7.
float intersect_sphere(Ray ray, Sphere sphere) {
    vec3 to_origin = ray.origin - sphere.center;
    float along = -dot(to_origin, ray.direction);
    vec3 closest = to_origin + along * ray.direction;
    float discriminant = sphere.radius * sphere.radius - dot(closest, closest);
    float half_chord = sqrt(larger(discriminant, 0.0));
    float near = along - half_chord;
    float far = along + half_chord;
    float distance = near > 0.0 ? near : far;
    return discriminant > 0.0 && distance > 0.0 ? distance : MISS;
}

// Slab test. inverse_direction is finite (see safe_inverse). normal is that of the face met.
float intersect_box(Ray ray, vec3 inverse_direction, Box box, out vec3 normal) {
    vec3 to_lower = (box.lower - ray.origin) * inverse_direction;
    vec3 to_upper = (box.upper - ray.origin) * inverse_direction;
    bvec3 upwards = lessThan(to_lower, to_upper);
    vec3 enter = mix(to_upper, to_lower, upwards);
    vec3 leave = mix(to_lower, to_upper, upwards);
    float near = larger(enter.x, larger(enter.y, enter.z));
    float far = smaller(leave.x, smaller(leave.y, leave.z));
    bool outside = near > 0.0;
    float distance = outside ? near : far;
    normal = outside ? vec3(equal(enter, vec3(near))) : vec3(equal(leave, vec3(far)));
    return near <= far && far > 0.0 ? distance : MISS;
}

// T. Moeller and B. Trumbore, JGT 2(1), 1997, both sides. barycentric belongs to the second and third vertex.
float intersect_triangle(Ray ray, Triangle triangle, out vec2 barycentric) {
    vec3 h = cross(ray.direction, triangle.edge2);
    float inverse_determinant = 1.0 / dot(triangle.edge1, h);
    vec3 s = ray.origin - triangle.vertex;
    float b1 = dot(s, h) * inverse_determinant;
    vec3 q = cross(s, triangle.edge1);
    float b2 = dot(ray.direction, q) * inverse_determinant;
    float distance = dot(triangle.edge2, q) * inverse_determinant;
    barycentric = vec2(b1, b2);
    // Written so that a NaN from a ray in the triangle's plane is a miss.
    return b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && distance > 0.0 && distance < MISS ? distance : MISS;
}

float intersect_plane(Ray ray, Plane plane) {
    float distance = (plane.offset - dot(plane.normal, ray.origin)) / dot(plane.normal, ray.direction);
    return distance > 0.0 && distance < MISS ? distance : MISS;
}

// 1 / direction with zero components replaced, so that no slab distance is 0 * infinity.
vec3 safe_inverse(vec3 direction) {
    vec3 tiny = mix(vec3(-1e-20), vec3(1e-20), greaterThanEqual(direction, vec3(0.0)));
    return 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(1e-20)));
}

void keep_nearer(inout Hit hit, float distance, uint shape, vec3 normal, float curvature, vec3 way) {
    if (distance < hit.distance) {
        hit = Hit(distance, get_material_of_shape(shape), normal, curvature, vec3(0.0), way);
    }
}

// A shape of the lists where it is by now.
Sphere sphere_now(uint i, out vec3 way) {
    Sphere sphere = get_sphere(i);
    way = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        way = way_of(i);
        sphere.center += way;
    }
    return sphere;
}

Box box_now(uint i, out vec3 way) {
    Box box = get_box(i);
    way = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        way = way_of(SPHERE_COUNT + i);
        box = Box(box.lower + way, box.upper + way);
    }
    return box;
}

Triangle triangle_now(uint i, out vec3 way) {
    Triangle triangle = get_triangle(i);
    way = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        way = way_of(SPHERE_COUNT + BOX_COUNT + i);
        triangle.vertex += way;
    }
    return triangle;
}

#include "bvh.glsl"

// The nearest hit, or one with distance MISS. given_up: the search for it took too long.
Hit intersect_scene(Ray ray, inout bool given_up) {
    Hit hit = Hit(MISS, 0u, vec3(0.0), 0.0, vec3(0.0), vec3(0.0));
    vec3 inverse_direction = safe_inverse(ray.direction);
    if (has_tree()) {
        hit = intersect_tree(ray, inverse_direction, given_up);
    }
    uint shape = 0u;
    vec3 way;
    [[unroll]] for (uint i = 0u; i < SPHERE_COUNT; ++i, ++shape) {
        Sphere sphere = sphere_now(i, way);
        keep_nearer(hit, intersect_sphere(ray, sphere), shape, -sphere.center, 1.0, way);
    }
    [[unroll]] for (uint i = 0u; i < BOX_COUNT; ++i, ++shape) {
        vec3 normal;
        float distance = intersect_box(ray, inverse_direction, box_now(i, way), normal);
        keep_nearer(hit, distance, shape, normal, 0.0, way);
    }
    [[unroll]] for (uint i = 0u; i < TRIANGLE_COUNT; ++i, ++shape) {
        Triangle triangle = triangle_now(i, way);
        vec3 normal = cross(triangle.edge1, triangle.edge2);
        vec2 barycentric;
        keep_nearer(hit, intersect_triangle(ray, triangle, barycentric), shape, normal, 0.0, way);
    }
    for (uint i = 0u; i < PLANE_COUNT; ++i, ++shape) {
        keep_nearer(hit, intersect_plane(ray, get_plane(i)), shape, get_plane(i).normal, 0.0, vec3(0.0));
    }
    return hit;
}

// The unit normal of the surface at a hit, on either side.
vec3 surface_normal(Hit hit, vec3 position) {
    return normalize(hit.curvature * position + hit.normal);
}

// Whether anything lies on the ray nearer than limit.
bool occluded(Ray ray, float limit, inout bool given_up) {
    float nearest = MISS;
    vec3 inverse_direction = safe_inverse(ray.direction);
    if (has_tree()) {
        uint shape;
        nearest = search_tree(ray, inverse_direction, limit, true, shape, given_up);
    }
    vec3 way;
    [[unroll]] for (uint i = 0u; i < SPHERE_COUNT; ++i) {
        nearest = smaller(nearest, intersect_sphere(ray, sphere_now(i, way)));
    }
    [[unroll]] for (uint i = 0u; i < BOX_COUNT; ++i) {
        vec3 normal;
        nearest = smaller(nearest, intersect_box(ray, inverse_direction, box_now(i, way), normal));
    }
    [[unroll]] for (uint i = 0u; i < TRIANGLE_COUNT; ++i) {
        vec2 barycentric;
        nearest = smaller(nearest, intersect_triangle(ray, triangle_now(i, way), barycentric));
    }
    for (uint i = 0u; i < PLANE_COUNT; ++i) {
        nearest = smaller(nearest, intersect_plane(ray, get_plane(i)));
    }
    return nearest < limit;
}

#endif
