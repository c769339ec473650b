// Ray against shape, and ray against scene. Distances are along unit directions, in scene units.

#ifndef INTERSECT_GLSL
#define INTERSECT_GLSL

#include "camera.glsl"
#include "scene.glsl"

// Not min() and max(): what those must do with a NaN costs a software device three instructions more.
float smaller(float a, float b) { return a < b ? a : b; }
float larger(float a, float b) { return a > b ? a : b; }

// A sphere stores its centre negated with curvature 1 and its radius as offset, flat shapes their normal with
// curvature 0 and as offset dot(normal, x) of their points x (see find_surface). So the shape loops keep what
// they have at hand, and nothing is fetched again by a diverging index.
struct Hit {
    float distance;
    uint material;
    vec3 normal;
    float curvature;
    float offset;
    float size; // of a triangle: its longest edge along an axis
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

// Slab test. inverse_direction is finite (see safe_inverse). The normal is that of the face met, along an axis,
// and the offset is the face's coordinate there.
float intersect_box(Ray ray, vec3 inverse_direction, Box box, out vec3 normal, out float offset) {
    bvec3 upwards = greaterThan(inverse_direction, vec3(0.0));
    vec3 front = mix(box.upper, box.lower, upwards);
    vec3 back = mix(box.lower, box.upper, upwards);
    vec3 enter = (front - ray.origin) * inverse_direction;
    vec3 leave = (back - ray.origin) * inverse_direction;
    float near = larger(enter.x, larger(enter.y, enter.z));
    float far = smaller(leave.x, smaller(leave.y, leave.z));
    bool outside = near > 0.0;
    float distance = outside ? near : far;
    normal = outside ? vec3(equal(enter, vec3(near))) : vec3(equal(leave, vec3(far)));
    offset = dot(normal, outside ? front : back);
    return near <= far && far > 0.0 ? distance : MISS;
}

// T. Moeller and B. Trumbore, JGT 2(1), 1997, both sides. barycentric belongs to the second and third vertex.
float intersect_triangle(Ray ray, Triangle triangle, out vec2 barycentric) {
    vec3 h = cross(ray.direction, triangle.edge2);
    float determinant = dot(triangle.edge1, h);
    float inverse_determinant = 1.0 / determinant;
    vec3 s = ray.origin - triangle.vertex;
    float b1 = dot(s, h) * inverse_determinant;
    vec3 q = cross(s, triangle.edge1);
    float b2 = dot(ray.direction, q) * inverse_determinant;
    float distance = dot(triangle.edge2, q) * inverse_determinant;
    barycentric = vec2(b1, b2);
    // A driver may assume that there are no infinities and no NaNs: a ray in the triangle's plane is seen by the
    // determinant.
    return determinant != 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && distance > 0.0 && distance < MISS ? distance : MISS;
}

float intersect_plane(Ray ray, Plane plane) {
    float cosine = dot(plane.normal, ray.direction);
    float distance = (plane.offset - dot(plane.normal, ray.origin)) / cosine;
    return cosine != 0.0 && distance > 0.0 && distance < MISS ? distance : MISS;
}

// 1 / direction with zero components replaced, so that no slab distance is 0 * infinity.
vec3 safe_inverse(vec3 direction) {
    vec3 tiny = mix(vec3(-1e-20), vec3(1e-20), greaterThanEqual(direction, vec3(0.0)));
    return 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(1e-20)));
}

void keep_nearer(inout Hit hit, uint shape, Hit other) {
    if (other.distance < hit.distance) {
        hit = other;
        hit.material = get_material_of_shape(shape);
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
        triangle.offset += dot(cross(triangle.edge1, triangle.edge2), way);
    }
    return triangle;
}

#include "bvh.glsl"

// How far the ray can go before it meets any shape but planes. What intersecting a shape loses to rounding grows
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
    Hit hit = Hit(MISS, 0u, vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0));
    vec3 inverse_direction = safe_inverse(from.direction);
    float start = way_to_shapes(from);
    Ray ray = Ray(from.origin + start * from.direction, from.direction);
    if (has_tree()) {
        hit = intersect_tree(ray, inverse_direction, given_up);
    }
    uint shape = 0u;
    vec3 way;
    [[unroll]] for (uint i = 0u; i < SPHERE_COUNT; ++i, ++shape) {
        Sphere sphere = sphere_now(i, way);
        float distance = intersect_sphere(ray, sphere);
        keep_nearer(hit, shape, Hit(distance, 0u, -sphere.center, 1.0, sphere.radius, 0.0, vec3(0.0), way));
    }
    [[unroll]] for (uint i = 0u; i < BOX_COUNT; ++i, ++shape) {
        vec3 normal;
        float offset;
        float distance = intersect_box(ray, inverse_direction, box_now(i, way), normal, offset);
        keep_nearer(hit, shape, Hit(distance, 0u, normal, 0.0, offset, 0.0, vec3(0.0), way));
    }
    [[unroll]] for (uint i = 0u; i < TRIANGLE_COUNT; ++i, ++shape) {
        Triangle triangle = triangle_now(i, way);
        vec3 normal = cross(triangle.edge1, triangle.edge2);
        vec2 barycentric;
        float distance = intersect_triangle(ray, triangle, barycentric);
        keep_nearer(hit, shape, Hit(distance, 0u, normal, 0.0, triangle.offset, triangle.size, vec3(0.0), way));
    }
    hit.distance += start;
    for (uint i = 0u; i < PLANE_COUNT; ++i, ++shape) {
        Plane plane = get_plane(i);
        float distance = intersect_plane(from, plane);
        keep_nearer(hit, shape, Hit(distance, 0u, plane.normal, 0.0, plane.offset, 0.0, vec3(0.0), vec3(0.0)));
    }
    return hit;
}

// What f32 may lose of a point of a surface, across it, and of an intersection that starts there, as a share of
// the coordinates: sums of up to six products, each rounded by 2^-24.
const float ROUNDING = 9.5367432e-7; // 16 * 2^-24

// The unit normal of the surface at a hit, on either side. position is where the ray meets it. As far as the
// ray is long, it may be off; so it is moved onto the surface. After that it is within error of it.
vec3 find_surface(Hit hit, inout vec3 position, out float error) {
    vec3 across = hit.curvature * position + hit.normal;
    float across_length = length(across);
    vec3 normal = across / across_length;
    float height = hit.curvature > 0.0 ? across_length - hit.offset : (dot(across, position) - hit.offset) / across_length;
    position -= height * normal;
    vec3 magnitude = abs(position);
    float largest = larger(larger(magnitude.x, magnitude.y), magnitude.z);
    error = ROUNDING * larger(largest, larger(hit.curvature * hit.offset, hit.size));
    return normal;
}

// Whether anything lies on the ray nearer than limit.
bool occluded(Ray from, float limit, inout bool given_up) {
    float nearest = MISS;
    vec3 inverse_direction = safe_inverse(from.direction);
    float start = way_to_shapes(from);
    Ray ray = Ray(from.origin + start * from.direction, from.direction);
    if (has_tree()) {
        uint shape;
        nearest = search_tree(ray, inverse_direction, limit - start, true, shape, given_up);
    }
    vec3 way;
    [[unroll]] for (uint i = 0u; i < SPHERE_COUNT; ++i) {
        nearest = smaller(nearest, intersect_sphere(ray, sphere_now(i, way)));
    }
    [[unroll]] for (uint i = 0u; i < BOX_COUNT; ++i) {
        vec3 normal;
        float offset;
        nearest = smaller(nearest, intersect_box(ray, inverse_direction, box_now(i, way), normal, offset));
    }
    [[unroll]] for (uint i = 0u; i < TRIANGLE_COUNT; ++i) {
        vec2 barycentric;
        nearest = smaller(nearest, intersect_triangle(ray, triangle_now(i, way), barycentric));
    }
    nearest += start;
    for (uint i = 0u; i < PLANE_COUNT; ++i) {
        nearest = smaller(nearest, intersect_plane(from, get_plane(i)));
    }
    return nearest < limit;
}

#endif
