// The radiance along a ray, by path tracing: J. Kajiya, "The Rendering Equation", SIGGRAPH 1986. A path goes on from each
// surface in one random direction, so light arrives by any number of reflections, in proportion to its probability.

#ifndef PATH_GLSL
#define PATH_GLSL

#include "core/limits.glsl"
#include "core/sampling.glsl"
#include "integrator/media.glsl"
#include "light/sky.glsl"
#include "material/material.glsl"

// A path of so many surfaces always goes on. After that, it ends by chance (Russian roulette), the sooner the less light
// it can still bring, and stands for the paths that have ended.
const uint SURFACES_BEFORE_ROULETTE = 3u;
const float MOST_SURVIVAL = 0.95;

// The probability that a path goes on from the surface after so many bounces, if its light counts so much.
float survival_probability(const vec3 throughput, const uint bounce) {
    float most = largest(throughput);
    if (bounce + 1u < SURFACES_BEFORE_ROULETTE) {
        return most > 0.0 ? 1.0 : 0.0;
    }
    return smaller(most, MOST_SURVIVAL);
}

// The weight of a sample that another strategy could have chosen too, with this density: the power heuristic of E. Veach,
// "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 9.2.
float strategy_weight(const float own, const float other) {
    // The square of the density of a tiny lamp would overflow.
    float ratio = other / own;
    return 1.0 / (1.0 + ratio * ratio);
}

// The share of light samples that the sky gets: half of them where there are lamps too.
float share_of_sky() {
    if (HAS_PANORAMA == 0u) {
        return 0.0;
    }
    if (HAS_LAMPS == 0u) {
        return 1.0;
    }
    return 0.5;
}

// A direction in which the sky or a lamp can be seen from a point.
LampSample sample_light(const vec3 from, const vec4 xi) {
    float of_sky = share_of_sky();
    if (HAS_PANORAMA == 1u && xi.w < of_sky) {
        LampSample chosen = sample_sky(xi.yz);
        chosen.density *= of_sky;
        return chosen;
    }
    LampSample chosen = sample_lamps(from, xi);
    chosen.density *= 1.0 - of_sky;
    return chosen;
}

// The light of a lamp or of the sky that the surface scatters towards the viewer.
vec3 direct_light(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const Media here,
    const vec4 xi, inout uint rays, inout bool given_up
) {
    LampSample lamp = sample_light(at.offset_position, xi);
    Scattered scattered = material_scattered(material, color, at, lamp.direction, to_viewer);
    if (scattered.density <= 0.0 || lamp.density <= 0.0) {
        return vec3(0.0);
    }
    ++rays;
    if (occluded(Ray(at.offset_position, lamp.direction), before_lamp(lamp), given_up)) {
        return vec3(0.0);
    }
    float weight = strategy_weight(lamp.density, scattered.density);
    vec3 arriving = lamp.radiance;
    if (HAS_MEDIA) {
        // Nothing lies between the surface and the lamp, so they are in the same body.
        arriving *= transmittance(here, lamp.distance);
    }
    return (weight / lamp.density) * scattered.share * arriving;
}

// The radiance that arrives along the ray, by light that was scattered no more often than the limits allow. rays counts every
// ray traced. given_up is true if a search took too long; the radiance is then of no use.
vec3 radiance(Ray ray, const PathSampler path, const uint limits, inout uint rays, out bool given_up) {
    vec3 sum = vec3(0.0);
    vec3 throughput = vec3(1.0);
    given_up = false;
    Media here = in_air();
    float density = 0.0; // with which the direction of the ray was chosen; 0 if it was the only one
    uint bounce = 0u;
    uint diffuse_bounces = 0u;
    // The sum up to the second surface. It is kept wherever light is added, because Mesa 22.3.6 loses it at the start of the
    // loop.
    vec3 of_first_surface = vec3(0.0);
    do {
        ++rays;
        Hit hit = intersect_scene(ray, given_up);
        if (hit.distance >= MISS) {
            vec3 seen = sky_radiance(ray.direction);
            if (HAS_PANORAMA == 1u && density > 0.0) {
                seen *= strategy_weight(density, share_of_sky() * sky_density(ray.direction));
            }
            sum += throughput * seen;
            of_first_surface = bounce == 0u ? sum : of_first_surface;
            break;
        }
        SurfacePoint at = surface_point(ray, hit);
        face_forward(at, ray.direction);
        Material material = get_material(hit.material);
        vec3 color = texture_value(material.color, at);
        Media beyond = here;
        if (HAS_MEDIA) {
            throughput *= transmittance(here, hit.distance);
            if (material.kind == MATERIAL_GLASS) {
                beyond = beyond_surface(here, hit.material, at.from_behind);
                at.index_ratio = index_of(beyond) / index_of(here);
            }
        }
        vec3 emitted = material_emission(material, color);
        if (HAS_LAMPS == 1u && density > 0.0 && emitted != vec3(0.0) && HAS_KIND(BOUNDED_KINDS, hit.kind)) {
            float of_lamps = (1.0 - share_of_sky()) * lamp_density(hit, ray.origin, ray.direction, at, emitted);
            emitted *= strategy_weight(density, of_lamps);
        }
        sum += throughput * emitted;
        of_first_surface = bounce == 0u ? sum : of_first_surface;
        if (bounce == most_bounces(limits)) {
            break;
        }
        bool may_spread = diffuse_bounces < most_diffuse_bounces(limits);
        if (may_spread && (HAS_LAMPS | HAS_PANORAMA) == 1u) {
            vec4 of_light = path_values(path, bounce, USE_LIGHT);
            sum += throughput * direct_light(material, color, at, -ray.direction, here, of_light, rays, given_up);
            of_first_surface = bounce == 0u ? sum : of_first_surface;
        }
        vec4 xi = path_values(path, bounce, USE_DIRECTION);
        Scatter scatter = material_sample(material, color, at, -ray.direction, xi.xyz);
        throughput *= scatter.weight;
        density = scatter.density;
        if (density > 0.0) {
            if (!may_spread) {
                break;
            }
            ++diffuse_bounces;
        }
        float survival = survival_probability(throughput, bounce);
        if (xi.w >= survival) {
            break;
        }
        throughput /= survival;
        if (HAS_MEDIA && dot(scatter.direction, at.normal) < 0.0) {
            here = beyond;
        }
        ray = Ray(start_towards(at, scatter.direction), scatter.direction);
    } while (++bounce <= most_bounces(limits));
    float most = most_indirect(limits);
    if (most > 0.0) {
        vec3 indirect = sum - of_first_surface;
        float found = luminance(indirect);
        sum = found > most ? of_first_surface + (most / found) * indirect : sum;
    }
    return sum;
}

#endif
