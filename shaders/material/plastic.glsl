// A clear coat, smooth or rough, over a matte base of the material's color.

#ifndef PLASTIC_GLSL
#define PLASTIC_GLSL

#include "material/layers.glsl"

// Light enters the coat, is scattered by the base, and leaves through the coat again. Seen from below, the coat reflects
// more than from above: radiance inside is larger by the square of the index, but all of it that the base scatters adds up
// to no more than what leaves. What is reflected down is scattered once more, and so on: the sum of this geometric series
// makes a white base lose nothing, and deepens the other colors.
Layers plastic_layers(const Material material, const vec3 color) {
    float squared_index = material.index * material.index;
    float root = (material.index - 1.0) / (material.index + 1.0);
    float coat = root * root; // A. Fresnel
    float leaves = unreflected(mean_albedo(material.roughness), coat);
    vec3 base = color / mix(vec3(squared_index), vec3(leaves), color);
    return Layers(material.roughness, vec3(coat), vec3(0.0), base, coat);
}

Scatter plastic_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    return layers_sample(plastic_layers(material, color), at, to_viewer, xi);
}

Scattered plastic_scattered(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    return layers_scattered(plastic_layers(material, color), at, to_light, to_viewer);
}

#endif
