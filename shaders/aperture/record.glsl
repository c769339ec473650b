// What every kind of aperture has in common. Each kind is a file beside this one with a function:
//
//   vec3 KIND_point(vec2 q, vec2 xi)
//       Maps a value xi of the unit square to a point of the aperture, in xy. The points are spread evenly, or in
//       proportion to the light that comes in, and lie within the unit disc. The result has in z the share of the light
//       through the point that reaches the film point q.

#ifndef APERTURE_RECORD_GLSL
#define APERTURE_RECORD_GLSL

#include "core/sampling.glsl"

layout(constant_id = ID_APERTURE) const uint APERTURE = APERTURE_DISC;
layout(constant_id = ID_HAS_PROFILE) const uint HAS_PROFILE = 0u;

struct Aperture {
    vec2 stretch; // half the width and half the height, where the diameter is two
    float blade_count;
    float half_blade_angle; // half the angle between two corners of the iris, as seen from its centre
    float tan_half_blade; // the tangent of half_blade_angle
    float straight_share; // the polygon's share of the area; the rest is the disc's
    float inverse_straight_share; // 1 / straight_share, or 0 where that is 0
    float inverse_round_share; // 1 / (1 - straight_share), or 0 where straight_share is 1
    float squared_apothem; // the squared distance of a polygon's edges from the centre, times 1 - roundness
    float roundness; // the disc's part of the squared distance to an edge
    float cats_eye_shift; // how far the second disc is shifted, in radii, for a film point with |q| = 1
    float max_cats_eye_shift; // the largest shift
    uvec2 cells; // columns and rows of the image
    float shutter; // how long the shutter is open, in seconds
    float profile; // how the light is spread over the aperture: -1 at the rim, 0 evenly, 1 in the middle
    vec2 axis; // the film point that the axis of the lens goes through, if it is not the middle of the picture
};

layout(set = 0, binding = BINDING_APERTURE, std430) readonly buffer ApertureBuffer {
    Aperture shape;
    vec2 edges[MAX_BLADES]; // the directions from the centre to the middles of the blades' edges
} aperture_buffer;

// A copy of the aperture, for the same reason as the copy of the scene: see keep_scene.
Aperture aperture;

// This must be called at the start of main().
void keep_aperture() {
    aperture = aperture_buffer.shape;
}

// The light at a point of the aperture, relative to the mean. t is the squared distance from the centre, relative to that of
// the rim, and t is spread evenly over a disc.
float profile_light(const float t) {
    return 1.0 + aperture.profile * (1.0 - 2.0 * t);
}

// Moves points that are spread evenly so that they are spread as the light is: returns by how much t must grow. The light
// within t is (1 + p) t - p t^2, which must be what t was.
float profile_growth(const float t) {
    float p = aperture.profile;
    return 2.0 / max(1.0 + p + sqrt(max((1.0 + p) * (1.0 + p) - 4.0 * p * t, 0.0)), 1e-10);
}

// A point of the unit disk. Points are spread as the light is.
vec2 lit_disk(const vec2 xi) {
    vec2 point = concentric_disk(xi);
    if (HAS_PROFILE == 1u) {
        point *= sqrt(profile_growth(dot(point, point)));
    }
    return point;
}

#endif
