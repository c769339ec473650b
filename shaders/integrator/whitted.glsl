// The radiance along a ray after T. Whitted: direct light with hard shadows, ambient light, and mirrors. Suffern,
// chapters 14 to 16 and 24.

#ifndef WHITTED_GLSL
#define WHITTED_GLSL

#include "core/limits.glsl"
#include "core/sampling.glsl"
#include "light/light.glsl"
#include "material/material.glsl"

// Whether light from this direction arrives at the outside of the surface. cosine is that of the angle to its normal.
bool lights_up(const SurfacePoint at, const vec3 direction, out float cosine) {
    cosine = dot(at.shading_normal, direction);
    return cosine > 0.0 && dot(at.normal, direction) > 0.0;
}

// The radiance of one light that the surface reflects towards the viewer.
vec3 reflected_light(
    const Material material, const vec3 color, const SurfacePoint at, const LightSample arriving,
    const float cosine, const vec3 to_viewer
) {
    return material_f(material, color, at, arriving.direction, to_viewer) * arriving.radiance * cosine;
}

// The radiance that the surface emits, and that it reflects of the ambient light and of all lights.
vec3 shade(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, inout uint rays,
    inout bool given_up
) {
    vec3 sum = material_emission(material, color) + material_ambient(material, color) * get_environment().ambient;
    if (material.kd == 0.0 && material.ks == 0.0) {
        return sum;
    }
    // This loop tests its condition at the end. If it did so at the start, Mesa's software device would run it once
    // more than needed, because that device checks only at the end whether any invocation goes on.
    uint lights = shadow_light_count();
    float cosine;
    if (lights > 0u) {
        uint i = 0u;
        do {
            LightSample arriving = light_sample(get_light(i), at.position);
            if (lights_up(at, arriving.direction, cosine)) {
                ++rays;
                if (!occluded(Ray(at.offset_position, arriving.direction), arriving.distance, given_up)) {
                    sum += reflected_light(material, color, at, arriving, cosine, to_viewer);
                }
            }
        } while (++i < lights);
    }
    // The loops are two, so that drivers do not have to compile a search for shadows that nothing casts.
    for (uint i = lights, end = light_count(); i < end; ++i) {
        LightSample arriving = light_sample(get_light(i), at.position);
        if (lights_up(at, arriving.direction, cosine)) {
            sum += reflected_light(material, color, at, arriving, cosine, to_viewer);
        }
    }
    return sum;
}

// The radiance that arrives along the ray: the radiance of the surface, plus that of its mirror image, followed for at
// most as many reflections as the limits allow. rays counts every ray traced, including shadow rays. given_up is true if a search took
// too long; the radiance is then of no use. This integrator makes no random decisions, so it takes no values of path.
vec3 radiance(Ray ray, const PathSampler path, const uint limits, inout uint rays, out bool given_up) {
    vec3 sum = vec3(0.0);
    vec3 throughput = vec3(1.0);
    given_up = false;
    uint bounce = 0u;
    do {
        ++rays;
        Hit hit = intersect_scene(ray, given_up);
        if (hit.distance >= MISS) {
            sum += throughput * background(ray.direction);
            break;
        }
        SurfacePoint at = surface_point(ray, hit);
        face_forward(at, ray.direction);
        Material material = get_material(hit.material);
        vec3 color = texture_value(material.color, at);
        sum += throughput * shade(material, color, at, -ray.direction, rays, given_up);
        Scatter scatter = material_mirrored(material, color, at, -ray.direction);
        throughput *= scatter.weight;
        if (throughput == vec3(0.0)) {
            break;
        }
        ray = Ray(at.offset_position, scatter.direction);
    } while (++bounce <= most_bounces(limits));
    return sum;
}

#endif
