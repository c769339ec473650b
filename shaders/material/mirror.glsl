// A mirror, whose reflectance is the material's color. It may also show highlights of the lights.

#ifndef MIRROR_GLSL
#define MIRROR_GLSL

#include "material/phong.glsl"

vec3 mirror_f(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light,
    const vec3 to_viewer
) {
    return vec3(phong_highlight(material, at, to_light, to_viewer));
}

vec3 mirror_direction(const SurfacePoint at, const vec3 to_viewer) {
    vec3 mirrored = reflect(-to_viewer, at.shading_normal);
    // A direction that would enter the surface is mirrored out of the surface again.
    mirrored -= 2.0 * smaller(dot(mirrored, at.normal), 0.0) * at.normal;
    return mirrored;
}

Scatter mirror_mirrored(const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer) {
    return Scatter(mirror_direction(at, to_viewer), color, 0.0);
}

// There is one direction only.
Scatter mirror_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    return mirror_mirrored(material, color, at, to_viewer);
}

#endif
