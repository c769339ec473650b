// The radiance along a ray after T. Whitted: the light of lamps, with hard shadows, ambient light, and mirrors. Suffern,
// chapters 14 to 16 and 24.

#ifndef WHITTED_GLSL
#define WHITTED_GLSL

#include "core/sampling.glsl"
#include "light/light.glsl"
#include "material/material.glsl"

// What a light adds at a point.
vec3 reflected_light(Material material, vec3 color, Light light, bool casts_shadows, SurfacePoint at, vec3 to_viewer, inout uint rays, inout bool given_up) {
    LightSample arriving = light_sample(light, at.position);
    float cosine = dot(at.shading_normal, arriving.direction);
    if (cosine <= 0.0 || dot(at.normal, arriving.direction) <= 0.0) {
        return vec3(0.0);
    }
    if (casts_shadows) {
        ++rays;
        if (occluded(Ray(at.lifted, arriving.direction), arriving.distance, given_up)) {
            return vec3(0.0);
        }
    }
    return material_f(material, color, at, arriving.direction, to_viewer) * arriving.radiance * cosine;
}

// Emission, ambient, and direct light with hard shadows.
vec3 shade(Material material, vec3 color, SurfacePoint at, vec3 to_viewer, inout uint rays, inout bool given_up) {
    vec3 sum = material_emission(material, color) + material_ambient(material, color) * get_environment().ambient;
    if (material.kd == 0.0 && material.ks == 0.0) {
        return sum;
    }
    // Loops end at their foot. At their head, Mesa's software device would go through them once more than
    // needed: it looks whether any invocation goes on at the foot alone.
    uint lights = SHADOW_LIGHT_COUNT;
    if (lights > 0u) {
        uint i = 0u;
        do {
            sum += reflected_light(material, color, get_light(i), true, at, to_viewer, rays, given_up);
        } while (++i < lights);
    }
    for (uint i = SHADOW_LIGHT_COUNT; i < LIGHT_COUNT; ++i) {
        sum += reflected_light(material, color, get_light(i), false, at, to_viewer, rays, given_up);
    }
    return sum;
}

// The radiance that arrives along the ray: what the surface shows, plus its mirror image, followed
// for at most max_bounces reflections. rays counts every ray traced, shadow rays among them. given_up: a search
// took too long, and the radiance is of no use. Nothing here is left to chance, so path is not asked.
vec3 radiance(Ray ray, PathSampler path, uint max_bounces, inout uint rays, out bool given_up) {
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
        turn_sides(at, ray.direction);
        Material material = get_material(hit.material);
        vec3 color = texture_value(material.color, at);
        sum += throughput * shade(material, color, at, -ray.direction, rays, given_up);
        Scatter scatter = material_sample(material, color, at, ray.direction);
        throughput *= scatter.weight;
        if (throughput == vec3(0.0)) {
            break;
        }
        ray = Ray(at.lifted, scatter.direction);
    } while (++bounce <= max_bounces);
    return sum;
}

#endif
