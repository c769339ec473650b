// A matte material with a highlight around the direction of the mirrored light.

#ifndef PHONG_GLSL
#define PHONG_GLSL

#include "material/matte.glsl"

float phong_highlight(const Material material, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer) {
    vec3 reflected = 2.0 * dot(at.shading_normal, to_light) * at.shading_normal - to_light;
    float highlight = larger(dot(reflected, to_viewer), 0.0);
    // pow(0, 0) is undefined.
    return highlight > 0.0 ? material.ks * pow(highlight, material.exponent) : 0.0;
}

vec3 phong_ambient(const Material material, const vec3 color) {
    return matte_ambient(material, color);
}

vec3 phong_f(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light,
    const vec3 to_viewer
) {
    return matte_f(material, color, at, to_light, to_viewer) + phong_highlight(material, at, to_light, to_viewer);
}

#endif
