// Rough surfaces as many small facets, each a mirror: B. Walter et al., "Microfacet Models for Refraction through Rough
// Surfaces", EGSR 2007, with the distribution GGX and the shadowing of E. Heitz, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs", JCGT 3(2), 2014.
//
// Directions are local: z goes along the shading normal. alpha is the width of the slopes of the facets.

#ifndef MICROFACET_GLSL
#define MICROFACET_GLSL

#include "core/sampling.glsl"
#include "material/albedo.glsl"
#include "scene/surface.glsl"

// The slopes of a rough surface look evenly spaced to the eye if they grow with the square of its roughness: B. Burley,
// "Physically-Based Shading at Disney", SIGGRAPH Courses 2012.
float facet_alpha(const float roughness) {
    return roughness * roughness;
}

// The viewer must be above the shading normal's horizon. A smoothed mesh may show parts that are not.
const float LEAST_COSINE = 1e-3;

// A world direction on the side of the normals, in local coordinates.
vec3 to_local(const SurfacePoint at, const vec3 direction) {
    vec3 first, second;
    find_tangents(at.shading_normal, first, second);
    return vec3(dot(first, direction), dot(second, direction), dot(at.shading_normal, direction));
}

vec3 viewer_to_local(const SurfacePoint at, const vec3 to_viewer) {
    vec3 viewer = to_local(at, to_viewer);
    viewer.z = larger(viewer.z, LEAST_COSINE);
    return normalize(viewer);
}

// The density of facets with this normal, over the area of the surface.
float facet_density(const vec3 facet, const float alpha) {
    float slope = dot(facet.xy, facet.xy) / (alpha * alpha) + facet.z * facet.z;
    return 1.0 / (3.14159265 * alpha * alpha * slope * slope);
}

// The hidden area of facets, relative to the visible one, as seen from this direction.
float hidden_share(const vec3 direction, const float alpha) {
    float squared_slope = alpha * alpha * dot(direction.xy, direction.xy) / (direction.z * direction.z);
    return 0.5 * (sqrt(1.0 + squared_slope) - 1.0);
}

// A facet that the viewer sees, chosen in proportion to its visible area: J. Dupuy and A. Benyoub, "Sampling Visible GGX
// Normals with Spherical Caps", CGF 42(8), 2023.
vec3 visible_facet(const vec3 viewer, const float alpha, const vec2 xi) {
    vec3 stretched = normalize(vec3(alpha * viewer.xy, viewer.z));
    vec2 disk = concentric_disk(xi);
    // The square of an even point's distance from the centre is even too.
    float height = 1.0 - dot(disk, disk) * (1.0 + stretched.z);
    vec3 cap = vec3(disk * sqrt(larger((1.0 + stretched.z) * (1.0 + height), 0.0)), height);
    vec3 facet = cap + stretched;
    return normalize(vec3(alpha * facet.xy, larger(facet.z, 1e-6)));
}

// The density of the mirrored directions at visible facets, per solid angle.
float mirrored_density(const vec3 viewer, const vec3 facet, const float alpha) {
    float visible = 1.0 / (1.0 + hidden_share(viewer, alpha));
    return 0.25 * facet_density(facet, alpha) * visible / viewer.z;
}

// The part of a visible facet's light, from or to the other direction, that no other facet blocks.
float unblocked_share(const vec3 viewer, const vec3 other, const float alpha) {
    float hidden = hidden_share(viewer, alpha);
    return (1.0 + hidden) / (1.0 + hidden + hidden_share(other, alpha));
}

#endif
