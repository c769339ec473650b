// An axis-aligned box: position is its lower corner, a its upper corner. On a face perpendicular to an axis, u and v go
// along the next two axes, from 0 to 1.

#ifndef BOX_GLSL
#define BOX_GLSL

#include "shape/record.glsl"

// The distances at which the ray enters and leaves the box's three slabs. For each axis, front is the coordinate of the
// face that the ray meets first, and back is the coordinate of the other face.
struct Slabs {
    vec3 front;
    vec3 back;
    vec3 enter;
    vec3 leave;
    float near;
    float far;
};

Slabs slabs_of(const Ray ray, const vec3 inverse_direction, const ShapeRecord box) {
    Slabs slabs;
    bvec3 upwards = greaterThan(inverse_direction, vec3(0.0));
    slabs.front = mix(box.a, box.position, upwards);
    slabs.back = mix(box.position, box.a, upwards);
    slabs.enter = (slabs.front - ray.origin) * inverse_direction;
    slabs.leave = (slabs.back - ray.origin) * inverse_direction;
    slabs.near = larger(slabs.enter.x, larger(slabs.enter.y, slabs.enter.z));
    slabs.far = smaller(slabs.leave.x, smaller(slabs.leave.y, slabs.leave.z));
    return slabs;
}

float box_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord box) {
    Slabs slabs = slabs_of(ray, inverse_direction, box);
    float distance = slabs.near > 0.0 ? slabs.near : slabs.far;
    return slabs.near <= slabs.far && slabs.far > 0.0 ? distance : MISS;
}

// The face that the ray meets. Its normal points outwards along an axis.
Surface box_surface(const Ray ray, const vec3 inverse_direction, const ShapeRecord box, const vec3 position) {
    Slabs slabs = slabs_of(ray, inverse_direction, box);
    bool outside = slabs.near > 0.0;
    vec3 axis = outside ? vec3(equal(slabs.enter, vec3(slabs.near))) : vec3(equal(slabs.leave, vec3(slabs.far)));
    // A ray that goes up an axis enters through the lower face, and leaves through the upper one.
    bvec3 upwards = greaterThan(inverse_direction, vec3(0.0));
    axis *= mix(vec3(1.0), vec3(-1.0), outside ? upwards : not(upwards));
    float offset = dot(axis, outside ? slabs.front : slabs.back);
    vec3 place = (position - box.position) / (box.a - box.position);
    vec2 uv = axis.x != 0.0 ? place.yz : axis.y != 0.0 ? place.zx : place.xy;
    return Surface(axis, offset, false, 0.0, vec3(0.0), uv);
}

// The first value chooses one of the six faces by its area, and then a place along an edge of it.
vec3 box_point(const ShapeRecord box, const vec2 xi, out vec3 normal) {
    vec3 size = box.a - box.position;
    vec3 areas = size.yzx * size.zxy; // of the faces perpendicular to x, y and z
    float at = xi.x * 2.0 * (areas.x + areas.y + areas.z);
    uint axis = at < 2.0 * areas.x ? 0u : at < 2.0 * (areas.x + areas.y) ? 1u : 2u;
    at -= axis == 0u ? 0.0 : 2.0 * areas.x + (axis == 1u ? 0.0 : 2.0 * areas.y);
    float along = at / areas[axis];
    bool upper = along >= 1.0;
    along = clamp(upper ? along - 1.0 : along, 0.0, 1.0);
    vec3 share = axis == 0u ? vec3(upper, along, xi.y) : axis == 1u ? vec3(xi.y, upper, along) : vec3(along, xi.y, upper);
    normal = vec3(axis == 0u, axis == 1u, axis == 2u);
    return box.position + share * size;
}

void move_box(inout ShapeRecord box, const vec3 displacement) {
    box.position += displacement;
    box.a += displacement;
}

#endif
