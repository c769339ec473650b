// Rough surfaces that lose no light. The facets of a surface reflect a part of the light at once. The rest goes on
// between the facets, or enters the base below them, and leaves in all directions: in proportion to the shares that the
// facets do not reflect of light from there, and of light towards the viewer. So light and viewer can be exchanged:
// C. Kulla and A. Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH Courses 2017.

#ifndef LAYERS_GLSL
#define LAYERS_GLSL

#include "material/matte.glsl"
#include "material/microfacet.glsl"
#include "material/mirror.glsl"

struct Layers {
    float roughness;
    vec3 reflectance; // of a facet at a right angle; more at other angles, all of the light at a grazing one
    vec3 between; // what leaves after reflections between facets: see between_facets()
    vec3 base; // what leaves after it entered the base through the coat
    float coat; // the reflectance of the facets at a right angle that are above the base
};

// The share of light that a facet reflects: C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering",
// CGF 13(3), 1994.
vec3 facet_reflectance(const vec3 reflectance, const float cosine) {
    return mix(vec3(fifth_power(larger(1.0 - cosine, 0.0))), vec3(1.0), reflectance);
}

// The light between facets of this reflectance, for Layers. A facet lets the mean share of light go. The rest meets another
// facet, and so on: the shares that leave after two, three and more reflections are a geometric series.
vec3 between_facets(const vec3 reflectance, const vec2 mean) {
    vec3 reflected = mix(reflectance, vec3(1.0), 1.0 / 21.0); // the mean over all angles
    float lost = 1.0 - mean.x;
    // Smooth surfaces lose so little that it does not matter.
    return reflected * reflected * mean.x / ((1.0 - reflected * lost) * larger(lost, 1e-4));
}

// Two parts of the BRDF, times pi, for the albedos of both directions. For the mean albedo instead of that of the light,
// each is the share of all light that leaves towards the viewer.
vec3 from_between(const Layers layers, const vec2 viewer, const vec2 light) {
    return layers.between * (unreflected(viewer, 1.0) * unreflected(light, 1.0));
}

vec3 from_base(const Layers layers, const vec2 viewer, const vec2 light) {
    return layers.base * (unreflected(viewer, layers.coat) * unreflected(light, layers.coat));
}

// The probabilities with which layers_sample() chooses a direction as light leaves the facets, the space between them, and
// the base: by how much light each of them brings.
vec3 chances(const Layers layers, const vec2 viewer) {
    vec2 mean = mean_albedo(layers.roughness);
    vec3 brings = vec3(
        largest(mix(viewer.yyy, viewer.xxx, layers.reflectance)), largest(from_between(layers, viewer, mean)),
        largest(from_base(layers, viewer, mean))
    );
    float all = brings.x + brings.y + brings.z;
    return all > 0.0 ? brings / all : vec3(1.0, 0.0, 0.0);
}

// The smoother a surface is, the nearer to the horizon are the directions whose light goes on between the facets. The lost
// share falls about as 1 / (alpha^2 + cosine^2), and the density of these directions is that times the cosine.
vec3 between_direction(const vec2 xi, const float alpha) {
    vec2 disk = concentric_disk(xi);
    float squared_radius = dot(disk, disk);
    float squared_alpha = alpha * alpha;
    float power = pow(1.0 + 1.0 / squared_alpha, 1.0 - squared_radius);
    float squared_height = clamp(squared_alpha * (power - 1.0), 0.0, 1.0);
    return vec3(disk * sqrt((1.0 - squared_height) / larger(squared_radius, 1e-12)), sqrt(squared_height));
}

float between_density(const float cosine, const float alpha) {
    float squared_alpha = alpha * alpha;
    return INVERSE_PI * cosine / ((squared_alpha + cosine * cosine) * log(1.0 + 1.0 / squared_alpha));
}

// For local directions, both above the surface.
Scattered layers_between(const Layers layers, const vec3 viewer, const vec3 light) {
    vec2 of_viewer = albedo_of(viewer.z, layers.roughness);
    vec2 of_light = albedo_of(light.z, layers.roughness);
    vec3 chance = chances(layers, of_viewer);
    float cosine = INVERSE_PI * light.z;
    vec3 share = cosine * (from_between(layers, of_viewer, of_light) + from_base(layers, of_viewer, of_light));
    float density = cosine * chance.z;
    if (!is_smooth(layers.roughness)) {
        float alpha = facet_alpha(layers.roughness);
        vec3 facet = normalize(viewer + light);
        float of_facets = mirrored_density(viewer, facet, alpha);
        float unblocked = unblocked_share(viewer, light, alpha);
        share += of_facets * unblocked * facet_reflectance(layers.reflectance, dot(viewer, facet));
        density += of_facets * chance.x + between_density(light.z, alpha) * chance.y;
    }
    return Scattered(share, density);
}

Scattered layers_scattered(
    const Layers layers, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    return layers_between(layers, viewer_to_local(at, to_viewer), to_local(at, to_light));
}

Scatter layers_sample(const Layers layers, const SurfacePoint at, const vec3 to_viewer, const vec3 xi) {
    vec3 viewer = viewer_to_local(at, to_viewer);
    float alpha = facet_alpha(layers.roughness);
    vec3 chance = chances(layers, albedo_of(viewer.z, layers.roughness));
    vec3 other;
    if (xi.z >= chance.x + chance.y) {
        other = cosine_direction(xi.xy);
    } else if (xi.z >= chance.x) {
        other = between_direction(xi.xy, alpha);
    } else if (is_smooth(layers.roughness)) {
        vec3 weight = facet_reflectance(layers.reflectance, viewer.z) / chance.x;
        return Scatter(mirror_direction(at, to_viewer), weight, 0.0);
    } else {
        other = reflect(-viewer, visible_facet(viewer, alpha, xi.xy));
    }
    vec3 direction = around_normal(at.shading_normal, other);
    if (other.z <= 0.0 || dot(direction, at.normal) <= 0.0) {
        return NO_SCATTER;
    }
    Scattered scattered = layers_between(layers, viewer, other);
    return Scatter(direction, scattered.share / scattered.density, scattered.density);
}

#endif
