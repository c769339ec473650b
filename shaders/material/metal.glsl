// A metal, smooth or rough: it reflects its color at a right angle, and everything at a grazing one (C. Schlick, "An
// Inexpensive BRDF Model for Physically-based Rendering", CGF 13(3), 1994).

#ifndef METAL_GLSL
#define METAL_GLSL

#include "material/microfacet.glsl"
#include "material/mirror.glsl"

vec3 metal_reflectance(const vec3 color, const float cosine) {
    float away = larger(1.0 - cosine, 0.0);
    float squared = away * away;
    return color + (1.0 - color) * (squared * squared * away);
}

Scatter metal_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    if (is_smooth(material.roughness)) {
        Scatter mirrored = mirror_mirrored(material, color, at, to_viewer);
        mirrored.weight = metal_reflectance(color, dot(at.shading_normal, to_viewer));
        return mirrored;
    }
    float alpha = facet_alpha(material.roughness);
    vec3 viewer = viewer_to_local(at, to_viewer);
    vec3 facet = visible_facet(viewer, alpha, xi.xy);
    vec3 other = reflect(-viewer, facet);
    vec3 direction = around_normal(at.shading_normal, other);
    if (other.z <= 0.0 || dot(direction, at.normal) <= 0.0) {
        return NO_SCATTER;
    }
    vec3 weight = metal_reflectance(color, dot(viewer, facet)) * unblocked_share(viewer, other, alpha);
    return Scatter(direction, weight, mirrored_density(viewer, facet, alpha));
}

Scattered metal_scattered(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    if (is_smooth(material.roughness)) {
        return Scattered(vec3(0.0), 0.0);
    }
    float alpha = facet_alpha(material.roughness);
    vec3 viewer = viewer_to_local(at, to_viewer);
    vec3 light = to_local(at, to_light);
    vec3 facet = normalize(viewer + light);
    float density = mirrored_density(viewer, facet, alpha);
    vec3 weight = metal_reflectance(color, dot(viewer, facet)) * unblocked_share(viewer, light, alpha);
    return Scattered(weight * density, density);
}

#endif
