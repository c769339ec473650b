// What rough surfaces reflect in all directions together, from the table of examples/facet_albedo.rs.
//
// An albedo has two parts: that of facets which reflect everything, and that of facets which reflect the share
// (1 - cos)^5 at an angle. Each is the share of light that leaves the surface after one reflection. The rest meets
// further facets.

#ifndef ALBEDO_GLSL
#define ALBEDO_GLSL

#include "interface.glsl"
#include "core/ray.glsl"

// A texel has the corners of a cell between four nodes: first the two of the lower roughness. A corner has both parts, in
// 16 bits each. The last texel of a row has the means over all directions.
layout(set = 0, binding = BINDING_FACET_ALBEDO) uniform utextureBuffer facet_albedo;
const uint ALBEDO_CELLS = 63u; // in a row
const uint ALBEDO_ROWS = 31u;

// A surface whose roughness is less than this is smooth.
const float LEAST_ROUGHNESS = 0.03;

bool is_smooth(const float roughness) {
    return roughness < LEAST_ROUGHNESS;
}

float fifth_power(const float base) {
    float squared = base * base;
    return squared * squared * base;
}

// Interpolates in a column of cells. across is the place between the two sides of the cell.
vec2 interpolated_albedo(const uint column, const float across, const float roughness) {
    float place = float(ALBEDO_ROWS) * roughness;
    float row = smaller(floor(place), float(ALBEDO_ROWS - 1u));
    uvec4 corners = texelFetch(facet_albedo, int(uint(row) * (ALBEDO_CELLS + 1u) + column));
    vec2 smoother = mix(unpackUnorm2x16(corners.x), unpackUnorm2x16(corners.y), across);
    vec2 rougher = mix(unpackUnorm2x16(corners.z), unpackUnorm2x16(corners.w), across);
    return mix(smoother, rougher, place - row);
}

// The albedo for light from, or towards, a direction with this cosine to the normal.
vec2 albedo_of(const float cosine, const float roughness) {
    if (is_smooth(roughness)) {
        return vec2(1.0, fifth_power(larger(1.0 - cosine, 0.0)));
    }
    // The nodes are even in the root of the cosine.
    float place = float(ALBEDO_CELLS) * sqrt(cosine);
    float column = smaller(floor(place), float(ALBEDO_CELLS - 1u));
    return interpolated_albedo(uint(column), place - column, roughness);
}

// The mean over all directions, each of which counts by its cosine.
vec2 mean_albedo(const float roughness) {
    return is_smooth(roughness) ? vec2(1.0, 1.0 / 21.0) : interpolated_albedo(ALBEDO_CELLS, 0.0, roughness);
}

// The second table, of glass, begins here. A texel has the eight corners of a cell, in 16 bits each: two that differ in the
// refractive index, then those of the next roughness, then those of the next cosine.
const uint GLASS_ALBEDO_BEGIN = ALBEDO_ROWS * (ALBEDO_CELLS + 1u);
const float GLASS_CELLS = 16.0; // along each axis
const float MOST_GLASS_INDEX = 4.0; // the indices are up to this one, and their inverses

float between_indices(const uint corners, const float across) {
    vec2 both = unpackUnorm2x16(corners);
    return mix(both.x, both.y, across);
}

// The share of light that leaves rough glass after one reflection or refraction. index_ratio is that of SurfacePoint.
float glass_albedo(const float cosine, const float roughness, const float index_ratio) {
    float root = (index_ratio - 1.0) / (index_ratio + 1.0) * ((MOST_GLASS_INDEX + 1.0) / (MOST_GLASS_INDEX - 1.0));
    float side = sqrt(smaller(abs(root), 1.0));
    vec3 place = GLASS_CELLS * vec3(0.5 + 0.5 * (root < 0.0 ? -side : side), roughness, sqrt(cosine));
    vec3 cell = min(floor(place), GLASS_CELLS - 1.0);
    vec3 across = place - cell;
    uint at = uint((cell.z * GLASS_CELLS + cell.y) * GLASS_CELLS + cell.x);
    uvec4 corners = texelFetch(facet_albedo, int(GLASS_ALBEDO_BEGIN + at));
    vec2 smoother = vec2(between_indices(corners.x, across.x), between_indices(corners.z, across.x));
    vec2 rougher = vec2(between_indices(corners.y, across.x), between_indices(corners.w, across.x));
    vec2 ends = mix(smoother, rougher, across.y);
    return mix(ends.x, ends.y, across.z);
}

// The share of light that facets with this reflectance at a right angle do not reflect at once.
float unreflected(const vec2 albedo, const float reflectance) {
    return 1.0 - mix(albedo.y, albedo.x, reflectance);
}

#endif
