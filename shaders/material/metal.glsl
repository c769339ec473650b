// A metal, smooth or rough: it reflects its color at a right angle, and everything at a grazing one.

#ifndef METAL_GLSL
#define METAL_GLSL

#include "material/layers.glsl"

Layers metal_layers(const Material material, const vec3 color) {
    vec3 between = between_facets(color, mean_albedo(material.roughness));
    return Layers(material.roughness, color, between, vec3(0.0), 0.0);
}

Scatter metal_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    return layers_sample(metal_layers(material, color), at, to_viewer, xi);
}

Scattered metal_scattered(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    return layers_scattered(metal_layers(material, color), at, to_light, to_viewer);
}

#endif
