// Lamps: the bounded shapes whose material emits light. A lamp is chosen in proportion to the power that it emits, and
// then a point of it, evenly on its surface; or, of a sphere, evenly over the cone that it fills. Pharr, Jakob and
// Humphreys, "Physically Based Rendering", 4th edition, section 12.

#ifndef LAMPS_GLSL
#define LAMPS_GLSL

#include "core/color.glsl"
#include "core/sampling.glsl"
#include "scene/surface.glsl"

layout(constant_id = ID_HAS_LAMPS) const uint HAS_LAMPS = 0u;

struct Lamp {
    ShapeRecord shape;
    vec3 radiance;
    float end; // the share of the power that this lamp and all before it emit
    vec3 velocity; // in scene units per second
};

layout(set = 0, binding = BINDING_LAMPS, std430) readonly buffer Lamps { Lamp lamps[]; };

// A direction in which a lamp can be seen.
struct LampSample {
    vec3 direction;
    float distance; // a shape that is nearer casts a shadow
    vec3 radiance;
    float density; // of the directions, per solid angle
};

// The share of all samples that fall on a part of a lamp of area 1.
float density_per_area(const vec3 radiance) {
    return luminance(radiance) / counts.lamp_power;
}

// The solid angle of a sphere, as seen from a point outside, and the cosine at the edge of the cone that it fills.
float cone_of_sphere(const float radius, const float distance, out float cosine) {
    float squared_sine = (radius / distance) * (radius / distance);
    cosine = sqrt(larger(1.0 - squared_sine, 0.0));
    return 6.28318531 * squared_sine / (1.0 + cosine);
}

float area_of_sphere(const float radius) {
    return 12.5663706 * radius * radius;
}

// How densely light samples fall in this direction, per solid angle, in which a ray from the point `from` has met a lamp at
// this distance.
float lamp_density(const Hit hit, const vec3 from, const vec3 direction, const SurfacePoint at, const vec3 radiance) {
    float per_area = density_per_area(radiance);
    if (hit.kind == SHAPE_SPHERE && !at.from_behind) {
        // The surface's own normal goes from the centre to the point.
        float radius = hit.surface.offset;
        float cosine;
        float solid_angle = cone_of_sphere(radius, length(from + hit.surface.normal - at.position), cosine);
        return per_area * area_of_sphere(radius) / solid_angle;
    }
    return per_area * hit.distance * hit.distance / larger(abs(dot(at.normal, direction)), 1e-9);
}

// A lamp's point for a value of xi, as seen from a point.
LampSample sample_lamps(const vec3 from, const vec4 xi) {
    uint first = 0u;
    uint last = counts.lamps - 1u;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (xi.x < lamps[middle].end) {
            last = middle;
        } else {
            first = middle + 1u;
        }
    }
    Lamp lamp = lamps[first];
    ShapeRecord shape = lamp.shape;
    float per_area = density_per_area(lamp.radiance);
    LampSample chosen = LampSample(vec3(0.0), 0.0, lamp.radiance, 0.0);
    vec3 displacement = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        displacement = ray_time * lamp.velocity;
    }
    if (HAS_KIND(SHAPE_KINDS, SHAPE_SPHERE) && shape.kind == SHAPE_SPHERE) {
        vec3 to_centre = shape.position + displacement - from;
        float distance = length(to_centre);
        float radius = shape.a.x;
        if (distance > radius) {
            float cosine;
            float solid_angle = cone_of_sphere(radius, distance, cosine);
            vec3 local = in_cone(xi.yz, cosine);
            chosen.direction = around_normal(to_centre / distance, local);
            float across = distance * distance * dot(local.xy, local.xy);
            chosen.distance = distance * local.z - sqrt(larger(radius * radius - across, 0.0));
            chosen.density = per_area * area_of_sphere(radius) / solid_angle;
            return chosen;
        }
    }
    vec3 normal = vec3(0.0);
    vec3 point = vec3(0.0);
#define POINT(KIND, kind_) if (IS_OF_KIND(SHAPE_KINDS, shape.kind, SHAPE_##KIND)) { point = kind_##_point(shape, xi.yz, normal); }
    FOR_EACH_SHAPE_POINT(POINT)
    vec3 to_point = point + displacement - from;
    chosen.distance = length(to_point);
    chosen.direction = to_point / chosen.distance;
    float cosine = abs(dot(normal, chosen.direction));
    chosen.density = cosine > 0.0 ? per_area * chosen.distance * chosen.distance / cosine : 0.0;
    return chosen;
}

// The part of a lamp that is met where a sample of it was chosen does not cast a shadow on that sample.
float before_lamp(const LampSample lamp) {
    return 0.9999 * lamp.distance;
}

#endif
