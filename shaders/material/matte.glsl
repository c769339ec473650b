// Reflects light evenly into all directions.

#ifndef MATTE_GLSL
#define MATTE_GLSL

#include "core/sampling.glsl"
#include "scene/surface.glsl"

const float INVERSE_PI = 0.318309886;

vec3 matte_ambient(const Material material, const vec3 color) {
    return material.ka * color;
}

vec3 matte_f(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light,
    const vec3 to_viewer
) {
    return material.kd * INVERSE_PI * color;
}

// A local direction whose density is its cosine / pi. Such directions lie above even points of the unit disc (N. Malley;
// Pharr, Jakob and Humphreys, Physically Based Rendering, "Sampling Functions").
vec3 cosine_direction(const vec2 xi) {
    vec2 disk = concentric_disk(xi);
    float height = sqrt(larger(1.0 - dot(disk, disk), 0.0));
    return vec3(disk, height);
}

Scatter matte_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    vec3 other = cosine_direction(xi.xy);
    vec3 direction = around_normal(at.shading_normal, other);
    // Where the normals of a mesh are smoothed, a direction may lead below the surface. No light comes from there.
    vec3 weight = dot(direction, at.normal) > 0.0 ? material.kd * color : vec3(0.0);
    return Scatter(direction, weight, INVERSE_PI * other.z);
}

Scattered matte_scattered(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    float density = INVERSE_PI * dot(at.shading_normal, to_light);
    return Scattered(material.kd * color * density, density);
}

#endif
