// An iris of blades, whose edges may be curved: the squared distance of an edge from the centre is a mixture of a
// polygon's and a disc's, and so is the density of directions. Within a direction, the distance from the centre is
// proportional to the square root of the sample value.

#ifndef BLADES_GLSL
#define BLADES_GLSL

#include "aperture/record.glsl"

vec3 blades_point(const vec2 q, const vec2 xi) {
    float place = xi.x * aperture.blade_count;
    float blade = min(floor(place), aperture.blade_count - 1.0);
    float along = 2.0 * (place - blade) - 1.0;
    float share = abs(along);
    float tangent = share * aperture.inverse_straight_share * aperture.tan_half_blade;
    vec2 straight = vec2(1.0, tangent) / sqrt(1.0 + tangent * tangent);
    vec2 bent = cosine_and_sine(
        (share - aperture.straight_share) * aperture.inverse_round_share * aperture.half_blade_angle
    );
    vec2 direction = share <= aperture.straight_share ? straight : bent;
    float square = aperture.squared_apothem / (direction.x * direction.x) + aperture.roundness;
    float outwards = xi.y;
    if (HAS_PROFILE == 1u) {
        outwards *= profile_growth(outwards);
    }
    direction *= sqrt(square * outwards);
    vec2 edge = aperture_buffer.edges[uint(blade)];
    vec2 point = direction.x * edge + sign(along) * direction.y * vec2(-edge.y, edge.x);
    return vec3(aperture.stretch * point, 1.0);
}

#endif
