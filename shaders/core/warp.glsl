// Maps from the unit square to discs, cones and circles, which take even points to even points.

#ifndef WARP_GLSL
#define WARP_GLSL

#include "core/ray.glsl"

// Concentric map of the unit square onto the unit disk, area preserving:
// P. Shirley and K. Chiu, JGT 2(3), 1997; Suffern, chapter 6.
//
// Within a sector the angle stays in [-pi/4, pi/4], so a short Taylor series gives its sine and
// cosine to f32 precision. Vulkan lets the built-in sin and cos err by 2^-11.
vec2 concentric_disk(const vec2 xi) {
    vec2 square = 2.0 * xi - 1.0;
    bool wide = abs(square.x) > abs(square.y);
    float radius = wide ? square.x : square.y;
    float other = wide ? square.y : square.x;
    float angle = radius == 0.0 ? 0.0 : 0.785398163 * other / radius;

    float a2 = angle * angle;
    float sine = angle * (1.0 + a2 * (-1.0 / 6.0 + a2 * (1.0 / 120.0 + a2 * (-1.0 / 5040.0 + a2 / 362880.0))));
    float cosine = 1.0 + a2 * (-0.5 + a2 * (1.0 / 24.0 + a2 * (-1.0 / 720.0 + a2 / 40320.0)));
    return radius * (wide ? vec2(cosine, sine) : vec2(sine, cosine));
}

// A direction in the cone around the z axis with this cosine at its edge, evenly over its solid angle.
vec3 in_cone(const vec2 xi, const float cosine) {
    vec2 disk = concentric_disk(xi);
    // The square of an even point's distance from the centre of the disc is even too.
    float height = 1.0 - dot(disk, disk) * (1.0 - cosine);
    return vec3(disk * sqrt(larger((1.0 - cosine) * (1.0 + height), 0.0)), height);
}

// A point of the unit circle, evenly: each quarter of the values makes a quarter of the circle.
vec2 on_circle(const float xi) {
    float quarters = 4.0 * xi;
    float quarter = floor(quarters);
    // The upper edge of the square becomes the upper quarter of the circle.
    vec2 point = concentric_disk(vec2(quarters - quarter, 1.0));
    point = quarter == 1.0 || quarter == 3.0 ? vec2(-point.y, point.x) : point;
    return quarter >= 2.0 ? -point : point;
}

#endif
