// What can be shown instead of the picture, or on it. Colours are linear.

#ifndef OVERLAY_GLSL
#define OVERLAY_GLSL

const uint OVERLAY_COUNT = 1u; // samples, as a share of full_scale
const uint OVERLAY_ERROR = 2u; // the standard error of a pixel's mean, from none to full_scale
const uint OVERLAY_DEPTH = 3u; // white at the lens, grey in the focal plane, black far away
const uint OVERLAY_BLUR = 4u; // the circle of confusion, in front and behind, up to full_scale pixels
const uint OVERLAY_PEAKING = 5u; // the picture, with what is blurred over less than full_scale pixels marked
const uint OVERLAY_FOCAL_PLANE = 6u; // the picture, with what lies in the focal plane marked

const vec3 IN_FRONT = vec3(0.02, 0.22, 1.0);
const vec3 BEHIND = vec3(1.0, 0.2, 0.01);
const vec3 MARK = vec3(0.05, 1.0, 0.1);
const vec3 SLICE = vec3(1.0, 0.6, 0.0);

// How far from the focal plane a point still counts as in it, as a share of its distance.
const float SLICE_HALF_WIDTH = 0.006;

struct OverlayScale {
    uint kind;
    float full_scale;
    float blur; // the diameter of the lens times k, in pixels times scene units
    float inverse_image_distance; // of the focal plane; of a hole -1 / v
    float inverse_focal_distance;
};

// In pixels: D k (1 / F - 1 / z). Behind the focal plane it is positive.
float circle_of_confusion(OverlayScale scale, float depth) {
    return scale.blur * (scale.inverse_image_distance - 1.0 / depth);
}

// From black over red and yellow to white.
vec3 heat(float share) {
    return clamp(vec3(3.0 * share, 3.0 * share - 1.0, 3.0 * share - 2.0), 0.0, 1.0);
}

vec3 overlay_color(OverlayScale scale, vec3 picture, float count, float error, float depth) {
    switch (scale.kind) {
    case OVERLAY_COUNT:
        return vec3(count / scale.full_scale);
    case OVERLAY_ERROR:
        return heat(error / scale.full_scale);
    case OVERLAY_DEPTH:
        return vec3(1.0 / (1.0 + depth * scale.inverse_focal_distance));
    case OVERLAY_BLUR:
        float share = clamp(circle_of_confusion(scale, depth) / scale.full_scale, -1.0, 1.0);
        return mix(vec3(1.0), share < 0.0 ? IN_FRONT : BEHIND, abs(share));
    case OVERLAY_PEAKING:
        bool sharp = abs(circle_of_confusion(scale, depth)) <= scale.full_scale;
        return sharp ? mix(picture, MARK, 0.6) : picture;
    case OVERLAY_FOCAL_PLANE:
        bool in_plane = abs(depth * scale.inverse_focal_distance - 1.0) <= SLICE_HALF_WIDTH;
        return in_plane ? mix(picture, SLICE, 0.75) : picture;
    default:
        return picture;
    }
}

#endif
