// Maps from the unit square to discs, cones and circles, which take even points to even points.
// Vulkan lets the built-in sine, cosine and arc tangent err by 2^-11, so these have series of their own.

#ifndef WARP_GLSL
#define WARP_GLSL

#include "core/ray.glsl"

// The cosine and the sine of an angle up to pi / 3, to f32 precision, by a short Taylor series.
vec2 cosine_and_sine(const float angle) {
    float a2 = angle * angle;
    float cosine = 1.0 + a2 * (-0.5 + a2 * (1.0 / 24.0 + a2 * (-1.0 / 720.0 + a2 * (1.0 / 40320.0 - a2 / 3628800.0))));
    float sine = angle * (1.0 + a2 * (-1.0 / 6.0 + a2 * (1.0 / 120.0 + a2 * (-1.0 / 5040.0 + a2 / 362880.0))));
    return vec2(cosine, sine);
}

// Concentric map of the unit square onto the unit disk, area preserving:
// P. Shirley and K. Chiu, JGT 2(3), 1997; Suffern, chapter 6. Within a sector the angle stays in [-pi/4, pi/4], so the
// series can be shorter.
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

// The point of the unit circle that lies so many turns from the x axis, towards the y axis.
vec2 on_circle(const float turns) {
    float quarters = 4.0 * turns;
    float quarter = floor(quarters + 0.5);
    vec2 point = cosine_and_sine(1.57079633 * (quarters - quarter));
    int turned = int(quarter) & 3;
    point = (turned & 1) == 1 ? vec2(-point.y, point.x) : point;
    return turned >= 2 ? -point : point;
}

// The angle from the x axis to a vector, towards the y axis, in turns from -1/2 to 1/2. 0 for a vector of length 0.
float turns_of(const vec2 vector) {
    vec2 size = abs(vector);
    bool steep = size.y > size.x;
    float longer = steep ? size.y : size.x;
    float slope = longer == 0.0 ? 0.0 : (steep ? size.x : size.y) / longer;
    // The polynomial, whose last terms are fitted, is right to 3e-9 for a slope of less than the tangent of pi/8. A larger
    // one is taken from pi/4.
    bool wide = slope > 0.414213562;
    float less = wide ? (slope - 1.0) / (slope + 1.0) : slope;
    float s2 = less * less;
    float angle = less * (1.0 + s2 * (-0.333333333 + s2 * (0.2 + s2 * (-0.142755540 + s2 * (0.108399520 + s2 * -0.067099300)))));
    angle = wide ? 0.785398163 + angle : angle;
    angle = steep ? 1.57079633 - angle : angle;
    angle = vector.x < 0.0 ? 3.14159265 - angle : angle;
    return 0.159154943 * (vector.y < 0.0 ? -angle : angle);
}

#endif
