// The sky as a source of light: a gradient, or an image of all directions (see src/scene/light/panorama.rs). The light of an
// image is sampled: a texel is chosen in proportion to its light, and then an even direction within it. Pharr, Jakob and
// Humphreys, "Physically Based Rendering", 4th edition, section 12.5.

#ifndef SKY_GLSL
#define SKY_GLSL

#include "core/warp.glsl"
#include "light/background.glsl"
#include "light/lamps.glsl"

layout(constant_id = ID_HAS_PANORAMA) const uint HAS_PANORAMA = 0u;

// Two texels of an image in each: r, g, b and opacity, 16 bits each.
layout(set = 0, binding = BINDING_IMAGE_TEXELS) uniform usamplerBuffer image_texels;
// The probability of each row of the panorama or one above it; then, of each of its texels, that of its column or one to its
// left within the row.
layout(set = 0, binding = BINDING_SKY_CHANCES, std430) readonly buffer SkyChances { float sky_chances[]; };

vec3 panorama_texel(const Environment sky, const uint x, const uint y) {
    uint at = y * sky.panorama_size.x + x;
    uvec4 pair = texelFetch(image_texels, int(at >> 1u));
    uvec2 texel = (at & 1u) == 1u ? pair.zw : pair.xy;
    return vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y).x);
}

// The place of a direction in the panorama, in texels from its top left corner.
vec2 panorama_place(const Environment sky, const vec3 direction) {
    // The middle of the image lies in the direction -z, and its columns go clockwise as seen from above.
    float longitude = 0.5 + turns_of(vec2(-direction.z, direction.x)) + sky.panorama_turns;
    float latitude = 2.0 * turns_of(vec2(direction.y, length(direction.xz)));
    return vec2(longitude - floor(longitude), latitude) * vec2(sky.panorama_size);
}

// The radiance of the panorama, linear between the centres of its texels.
vec3 panorama_radiance(const Environment sky, const vec3 direction) {
    uvec2 size = sky.panorama_size;
    vec2 place = panorama_place(sky, direction) - 0.5;
    vec2 corner = floor(place);
    vec2 share = place - corner;
    // Columns go around, and rows end at the poles.
    uint left = corner.x < 0.0 ? size.x - 1u : min(uint(corner.x), size.x - 1u);
    uint right = left + 1u == size.x ? 0u : left + 1u;
    uint above = uint(larger(corner.y, 0.0));
    uint below = min(uint(corner.y + 1.0), size.y - 1u);
    vec3 upper = mix(panorama_texel(sky, left, above), panorama_texel(sky, right, above), share.x);
    vec3 lower = mix(panorama_texel(sky, left, below), panorama_texel(sky, right, below), share.x);
    return sky.panorama_scale * mix(upper, lower, share.y);
}

// The radiance along a ray that meets no surface.
vec3 sky_radiance(const vec3 direction) {
    if (HAS_PANORAMA == 1u) {
        return panorama_radiance(get_environment(), direction);
    }
    return background_radiance(direction);
}

// The density of sampled directions in a texel, per solid angle.
float texel_density(const Environment sky, const uint x, const uint y) {
    uvec2 size = sky.panorama_size;
    uint column = size.y + y * size.x + x;
    float of_row = sky_chances[y] - (y > 0u ? sky_chances[y - 1u] : 0.0);
    float of_column = sky_chances[column] - (x > 0u ? sky_chances[column - 1u] : 0.0);
    float height = on_circle(0.5 * float(y) / float(size.y)).x - on_circle(0.5 * float(y + 1u) / float(size.y)).x;
    return of_row * of_column * float(size.x) / (6.28318531 * height);
}

// How densely samples of the sky fall in this direction, per solid angle.
float sky_density(const vec3 direction) {
    Environment sky = get_environment();
    uvec2 place = min(uvec2(panorama_place(sky, direction)), sky.panorama_size - 1u);
    return texel_density(sky, place.x, place.y);
}

// Finds the first of so many chances that is above xi, and how far xi is on the way to it from the one before.
uint find_chance(const uint first, const uint number, const float xi, out float share) {
    uint from = 0u;
    uint to = number - 1u;
    while (from < to) {
        uint middle = (from + to) / 2u;
        if (xi < sky_chances[first + middle]) {
            to = middle;
        } else {
            from = middle + 1u;
        }
    }
    float before = from > 0u ? sky_chances[first + from - 1u] : 0.0;
    float of_this = sky_chances[first + from] - before;
    share = of_this > 0.0 ? (xi - before) / of_this : 0.5;
    return from;
}

// A direction to the sky for a value of xi.
LampSample sample_sky(const vec2 xi) {
    Environment sky = get_environment();
    uvec2 size = sky.panorama_size;
    vec2 share;
    uint y = find_chance(0u, size.y, xi.x, share.y);
    uint x = find_chance(size.y + y * size.x, size.x, xi.y, share.x);
    float upper = on_circle(0.5 * float(y) / float(size.y)).x;
    float lower = on_circle(0.5 * float(y + 1u) / float(size.y)).x;
    float height = upper + share.y * (lower - upper);
    float radius = sqrt(larger(1.0 - height * height, 0.0));
    vec2 around = on_circle((float(x) + share.x) / float(size.x) - 0.5 - sky.panorama_turns);
    vec3 direction = vec3(radius * around.y, height, -radius * around.x);
    return LampSample(direction, MISS, panorama_radiance(sky, direction), texel_density(sky, x, y));
}

#endif
