#version 460
#extension GL_GOOGLE_include_directive : require

// Pass 3: turns the film's means into a picture, with exposure and sRGB encoding. A pixel without a sample shows the
// nearest pixel that has some. While the first sample is being filled in, the film bound here is the tracing image, and
// only the texels of a lattice in it belong to this picture. Each of them stands for the cell of pixels around it, and
// an invocation resolves one cell.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "core/adaptive.glsl"
#include "core/color.glsl"
#include "core/overlay.glsl"

layout(set = 0, binding = BINDING_FILM_IMAGE, rgba32f) readonly uniform image2D film_image;
layout(set = 0, binding = BINDING_PICTURE_IMAGE, rgba8) writeonly uniform image2D picture_image;

// Overlays read the surface that each pixel's centre sees, and the second moments of luminance if the film has some.
layout(set = 0, binding = BINDING_SURFACE_IMAGE, rgba32f) readonly uniform image2D surface_image;
layout(set = 0, binding = BINDING_FILM_MOMENTS, r32f) readonly uniform image2D film_moments;

// 0 if every texel is known to have a sample. Mesa's software device runs through branches that are not taken as well,
// so the search for a sample is compiled in only where it may be needed.
layout(constant_id = ID_HAS_HOLES) const uint HAS_HOLES = 1u;
// 0 if no overlay is shown. Overlays are compiled in only where they are needed, for the same reason.
layout(constant_id = ID_HAS_OVERLAY) const uint HAS_OVERLAY = 0u;

layout(push_constant, std430) uniform ResolvePush {
    uvec2 extent;
    uint preview_stride; // the stride of the lattice of pixels with samples: (2, 2) + 4 i, or 2 i, or all pixels
    float exposure; // linear factor
    OverlayScale overlay;
    uint blue_first; // 1: the bytes are copied to a window whose pixels start with blue
} push;

const int SEARCH_RADIUS = 4;

// The texel of the lattice that stands for a cell.
ivec2 site_of(const ivec2 cell) {
    int site_in_cell = push.preview_stride == PREVIEW_STRIDE ? int(PREVIEW_SITE) : 0;
    return cell * int(push.preview_stride) + site_in_cell;
}

// The texel that a cell shows, or an empty one if that texel lies outside the film.
vec4 film_at(const ivec2 cell) {
    ivec2 site = site_of(cell);
    if (site.x < 0 || site.y < 0 || !inside(uvec2(site), push.extent)) {
        return vec4(0.0);
    }
    return imageLoad(film_image, site);
}

// The nearest texel with samples, by Euclidean distance, within SEARCH_RADIUS cells, or an empty one if there is none.
vec4 nearest_sampled(const ivec2 cell) {
    vec4 nearest = vec4(0.0);
    int nearest_distance = 2 * SEARCH_RADIUS * SEARCH_RADIUS + 1;
    for (int y = -SEARCH_RADIUS; y <= SEARCH_RADIUS; ++y) {
        for (int x = -SEARCH_RADIUS; x <= SEARCH_RADIUS; ++x) {
            int distance = x * x + y * y;
            vec4 texel = film_at(cell + ivec2(x, y));
            if (distance < nearest_distance && texel.w > 0.0) {
                nearest = texel;
                nearest_distance = distance;
            }
        }
    }
    return nearest;
}

// The luminance of a neighbour of a cell as it is shown, or that of the cell itself where the neighbour has no sample.
float encoded_luminance(const ivec2 cell, const vec4 film) {
    vec4 texel = film_at(cell);
    return luminance(srgb_encode(push.exposure * (texel.w > 0.0 ? texel : film).rgb));
}

// By how much the encoded luminance changes from cell to cell: the length of the gradient by Sobel's operator.
float contrast_at(const ivec2 cell, const vec4 film) {
    vec2 gradient = vec2(0.0);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            float weight = x == 0 || y == 0 ? 0.25 : 0.125;
            gradient += weight * vec2(x, y) * encoded_luminance(cell + ivec2(x, y), film);
        }
    }
    return length(gradient);
}

void main() {
    uvec2 cell = gl_GlobalInvocationID.xy;
    uvec2 first = cell * push.preview_stride;
    if (!inside(first, push.extent)) {
        return;
    }
    // A cell at the right or lower edge may have no texel. Then the cell before it has the nearest one.
    ivec2 last_cell = (ivec2(push.extent) - 1 - site_of(ivec2(0))) / int(push.preview_stride);
    vec4 film = film_at(min(ivec2(cell), last_cell));
    if (HAS_HOLES == 1u && film.w == 0.0) {
        film = nearest_sampled(ivec2(cell));
    }
    vec3 shown = push.exposure * film.rgb;
    if (HAS_OVERLAY == 1u) {
        ivec2 site = min(site_of(ivec2(cell)), ivec2(push.extent) - 1);
        float error = HAS_MOMENTS == 1u ? relative_error(film, imageLoad(film_moments, site).r) : 0.0;
        float contrast = push.overlay.kind == OVERLAY_FOCUS_PEAKING ? contrast_at(ivec2(cell), film) : 0.0;
        vec4 surface = imageLoad(surface_image, site);
        shown = overlay_color(push.overlay, vec2(site), shown, contrast, film.w, error, surface);
    }
    vec4 color = vec4(srgb_encode(shown), 1.0);
    color = push.blue_first == 1u ? color.bgra : color;
    uvec2 end = min(first + push.preview_stride, push.extent);
    uvec2 at = first;
    do {
        at.x = first.x;
        do {
            imageStore(picture_image, ivec2(at), color);
        } while (++at.x < end.x);
    } while (++at.y < end.y);
}
