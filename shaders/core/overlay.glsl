// Overlays, which are shown instead of the picture or drawn on it. Colours are linear.

#ifndef OVERLAY_GLSL
#define OVERLAY_GLSL

#include "interface.glsl"

// How far from the focal plane a point may lie and still count as in it, relative to the focal distance.
const float SLICE_HALF_WIDTH = 0.006;
// Where the contrast of the encoded picture is at least this, from pixel to pixel, there is an edge.
const float EDGE_CONTRAST = 0.05;

struct OverlayScale {
    uint kind;
    float full_scale; // the value at the end of the colour scale; for focus peaking, the largest blur that is sharp
    float blur; // the diameter of the lens times k, in pixels times scene units
    float inverse_image_distance; // 1 / F; for a hole -1 / v
    float inverse_focal_distance;
    vec2 gradient; // for a tilted lens: by how much 1 / F grows from pixel to pixel, to the right and downwards
    vec2 axis; // the pixel that looks along the optical axis
};

// How much larger 1 / F is at a pixel than on the optical axis.
float focus_of_tilt(const OverlayScale scale, const vec2 pixel) {
    return dot(scale.gradient, pixel - scale.axis);
}

// The diameter of the circle of confusion in pixels: D k (1 / F - 1 / z). It is positive behind the focal plane. Across the
// direction of a tilt this is also the diameter of the circle that a tilted lens makes.
float circle_of_confusion(const OverlayScale scale, const vec2 pixel, const float depth) {
    return scale.blur * (scale.inverse_image_distance + focus_of_tilt(scale, pixel) - 1.0 / depth);
}

// A colour scale from black over red and yellow to white.
vec3 heat(const float share) {
    return clamp(vec3(3.0 * share, 3.0 * share - 1.0, 3.0 * share - 2.0), 0.0, 1.0);
}

// surface is the normal at the point that the pixel's centre sees, in the camera's frame, and in w the depth. contrast is
// by how much the encoded luminance of the picture changes from pixel to pixel; only focus peaking reads it.
vec3 overlay_color(
    const OverlayScale scale, const vec2 pixel, const vec3 picture, const float contrast, const float count,
    const float error, const vec4 surface
) {
    float depth = surface.w;
    switch (scale.kind) {
    case OVERLAY_COUNT:
        return vec3(count / scale.full_scale);
    case OVERLAY_ERROR:
        return heat(error / scale.full_scale);
    case OVERLAY_DEPTH: // white at the lens, grey in the focal plane, black far away
        return vec3(1.0 / (1.0 + depth * scale.inverse_focal_distance));
    case OVERLAY_NORMALS: // black where there is no surface
        return depth < MISS ? 0.5 + 0.5 * surface.xyz : vec3(0.0);
    case OVERLAY_CIRCLE_OF_CONFUSION:
        float share = clamp(circle_of_confusion(scale, pixel, depth) / scale.full_scale, -1.0, 1.0);
        return mix(vec3(1.0), share < 0.0 ? IN_FRONT : BEHIND, abs(share));
    case OVERLAY_FOCUS_PEAKING: // edges as cameras mark them, and a tint where something sharp has none
        bool sharp = abs(circle_of_confusion(scale, pixel, depth)) <= scale.full_scale;
        float mark = contrast >= EDGE_CONTRAST ? 0.9 : 0.12;
        return sharp ? mix(picture, MARK, mark) : picture;
    case OVERLAY_FOCAL_PLANE: // a sheet that covers what is behind it, and a line where it cuts surfaces
        float inverse = scale.inverse_focal_distance + focus_of_tilt(scale, pixel);
        float behind = depth * inverse - 1.0;
        float sheet = abs(behind) <= SLICE_HALF_WIDTH ? 0.75 : behind > 0.0 ? 0.2 : 0.0;
        return mix(picture, SLICE, sheet);
    default:
        return picture;
    }
}

#endif
