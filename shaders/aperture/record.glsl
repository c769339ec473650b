// What every kind of aperture has in common. A kind is a file beside this one with a function:
//
//   vec3 KIND_point(vec2 q, vec2 xi)
//       For a value xi of the unit square, the point of the opening in xy: evenly spread over it, or more often where it
//       is brighter; its rim is at one or nearer. In z the share of light that is let in on the way to the film point q.

#ifndef APERTURE_RECORD_GLSL
#define APERTURE_RECORD_GLSL

#include "core/sampling.glsl"

layout(constant_id = ID_APERTURE) const uint APERTURE = APERTURE_DISC;

struct Aperture {
    vec2 stretch; // half its width and height, of an opening of diameter two
    float blade_count;
    float half_blade; // half the angle of a blade
    float tangent; // of that
    float straight; // the share of the area that belongs to a polygon, and its inverse, or 0
    float inverse_straight;
    float inverse_bent; // of the rest's share, or 0
    float straight_square; // the polygon's part of the squared distance to the middle of an edge
    float roundness; // the disc's part
    float cats_eye; // how far the second disc is off, in radii, for a film point at distance one
    float most_cats_eye; // and at most
    uvec2 cells; // of the image: columns and rows
    float shutter; // how long it is open, in seconds
};

layout(set = 0, binding = BINDING_APERTURE, std430) readonly buffer ApertureBuffer {
    Aperture shape;
    vec2 edges[MOST_BLADES]; // the directions of the blades' edges, from the middle
} aperture_buffer;

// A copy, for the same reason as the scene's (see keep_scene).
Aperture aperture;

// To be called first thing in main().
void keep_aperture() {
    aperture = aperture_buffer.shape;
}

// Cosine and sine of an angle up to pi / 3: the built-in ones may err by 2^-11.
vec2 cosine_and_sine(float angle) {
    float a2 = angle * angle;
    float cosine = 1.0 + a2 * (-0.5 + a2 * (1.0 / 24.0 + a2 * (-1.0 / 720.0 + a2 * (1.0 / 40320.0 - a2 / 3628800.0))));
    float sine = angle * (1.0 + a2 * (-1.0 / 6.0 + a2 * (1.0 / 120.0 + a2 * (-1.0 / 5040.0 + a2 / 362880.0))));
    return vec2(cosine, sine);
}

#endif
