// The material of models: a mixture of a metal and of a coat over a matte base, both of the material's color. See
// "Metallic-Roughness Material" in appendix B of the specification of glTF 2.0.

#ifndef STANDARD_GLSL
#define STANDARD_GLSL

#include "material/layers.glsl"

// What the coat reflects at a right angle, by that specification.
const float STANDARD_COAT = 0.04;

// The specification lets a renderer share the light between coat and base in its own way, if it loses none.
Layers standard_layers(const Material material, const vec3 color) {
    vec2 mean = mean_albedo(material.roughness);
    vec3 reflectance = mix(vec3(STANDARD_COAT), color, material.metallic);
    vec3 between = material.metallic * between_facets(color, mean);
    vec3 base = (1.0 - material.metallic) / unreflected(mean, STANDARD_COAT) * color;
    return Layers(material.roughness, reflectance, between, base, STANDARD_COAT);
}

Scatter standard_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    return layers_sample(standard_layers(material, color), at, to_viewer, xi);
}

Scattered standard_scattered(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    return layers_scattered(standard_layers(material, color), at, to_light, to_viewer);
}

#endif
