// A clear body, smooth or frosted. Its surface reflects a part of the light and refracts the rest (A. Fresnel); the color
// is the absorption inside, per scene unit (A. Beer). Radiance is divided by the square of the refractive index of the
// medium it is in. This basic radiance stays the same as light is refracted.
//
// Light that goes on from facet to facet is given back with the light that leaves at once, in proportion: E. Turquin,
// "Practical Multiple Scattering Compensation for Microfacet Models", 2019.

#ifndef GLASS_GLSL
#define GLASS_GLSL

#include "material/microfacet.glsl"

// The fraction of unpolarized light that is reflected at a facet. ratio is the refractive index beyond it, divided by
// that on the side where the light comes from. refracted is the cosine beyond it, or 0 if all light is reflected.
float fresnel(const float cosine, const float ratio, out float refracted) {
    float squared = 1.0 - (1.0 - cosine * cosine) / (ratio * ratio);
    refracted = 0.0;
    if (squared <= 0.0) {
        return 1.0;
    }
    refracted = sqrt(squared);
    float parallel = (ratio * cosine - refracted) / (ratio * cosine + refracted);
    float perpendicular = (cosine - ratio * refracted) / (cosine + ratio * refracted);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// Lamps are met by chance only: so the density is given as 0, as that of a single direction.
Scatter glass_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    bool smooth_surface = is_smooth(material.roughness);
    float alpha = smooth_surface ? 0.0 : facet_alpha(material.roughness);
    vec3 viewer = viewer_to_local(at, to_viewer);
    vec3 facet = smooth_surface ? vec3(0.0, 0.0, 1.0) : visible_facet(viewer, alpha, xi.xy);
    float cosine = dot(viewer, facet);
    float refracted;
    float reflected_share = fresnel(cosine, at.index_ratio, refracted);
    bool is_reflected = xi.z < reflected_share;
    vec3 other = is_reflected
        ? 2.0 * cosine * facet - viewer
        : (cosine / at.index_ratio - refracted) * facet - viewer / at.index_ratio;
    vec3 direction = around_normal(at.shading_normal, other);
    float side = is_reflected ? 1.0 : -1.0;
    // A direction that leads to the wrong side of the surface brings nothing.
    if (side * other.z <= 0.0 || side * dot(direction, at.normal) <= 0.0) {
        return NO_SCATTER;
    }
    if (smooth_surface) {
        return Scatter(direction, vec3(1.0), 0.0);
    }
    float leaves = glass_albedo(viewer.z, material.roughness, at.index_ratio);
    return Scatter(direction, vec3(unblocked_share(viewer, other, alpha) / leaves), 0.0);
}

#endif
