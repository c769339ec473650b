// The opening that light comes in through: points evenly all over it, and how much of it is open.

#ifndef APERTURE_GLSL
#define APERTURE_GLSL

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

// Running sums of the image's light, from 0 to 1: of its rows, then within each row. Four to a texel.
layout(set = 0, binding = BINDING_APERTURE_SUMS) uniform utextureBuffer aperture_sums;

// Cosine and sine of an angle up to pi / 3: the built-in ones may err by 2^-11.
vec2 cosine_and_sine(float angle) {
    float a2 = angle * angle;
    float cosine = 1.0 + a2 * (-0.5 + a2 * (1.0 / 24.0 + a2 * (-1.0 / 720.0 + a2 * (1.0 / 40320.0 - a2 / 3628800.0))));
    float sine = angle * (1.0 + a2 * (-1.0 / 6.0 + a2 * (1.0 / 120.0 + a2 * (-1.0 / 5040.0 + a2 / 362880.0))));
    return vec2(cosine, sine);
}

// M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 4.4.46, for values from 0 to 1.
float arc_cosine(float x) {
    float sum = 1.5707963050 + x * (-0.2145988016 + x * (0.0889789874 + x * (-0.0501743046 + x * (0.0308918810
        + x * (-0.0170881256 + x * (0.0066700901 - x * 0.0012624911))))));
    return sqrt(1.0 - x) * sum;
}

// Of an iris whose edges are bent: the squared distance of an edge is a mixture of a polygon's and a
// disc's, and so is the density of directions. The distance within a direction goes with the root.
vec2 bladed_point(vec2 xi) {
    float place = xi.x * aperture.blade_count;
    float blade = min(floor(place), aperture.blade_count - 1.0);
    float along = 2.0 * (place - blade) - 1.0;
    float share = abs(along);
    float tangent = share * aperture.inverse_straight * aperture.tangent;
    vec2 straight = vec2(1.0, tangent) / sqrt(1.0 + tangent * tangent);
    vec2 bent = cosine_and_sine((share - aperture.straight) * aperture.inverse_bent * aperture.half_blade);
    vec2 direction = share <= aperture.straight ? straight : bent;
    float square = aperture.straight_square / (direction.x * direction.x) + aperture.roundness;
    direction *= sqrt(square * xi.y);
    vec2 edge = aperture_buffer.edges[uint(blade)];
    return direction.x * edge + sign(along) * direction.y * vec2(-edge.y, edge.x);
}

// psi - sin(psi) for psi from 0 to pi, without losing the digits of small ones.
float excess(float psi) {
    float p2 = psi * psi;
    float sum = 1.0 / 6.0 + p2 * (-1.0 / 120.0 + p2 * (1.0 / 5040.0 + p2 * (-1.0 / 362880.0 + p2 * (1.0 / 39916800.0
        + p2 * (-1.0 / 6227020800.0 + p2 * (1.0 / 1307674368000.0 - p2 / 355687428096000.0))))));
    return psi * p2 * sum;
}

// Of the overlap of two unit discs, the second one off by so much; in z the overlap's share of a disc. It
// is two caps back to back. A cap is cut into equal areas across: a cut at cos(psi / 2) leaves
// (psi - sin psi) / 2 outside, which is Kepler's equation.
vec3 overlap_point(vec2 off, vec2 xi) {
    float distance = length(off);
    vec2 axis = distance > 0.0 ? off / distance : vec2(1.0, 0.0);
    float middle = 0.5 * distance;
    float cap = excess(2.0 * arc_cosine(middle));
    float side = 2.0 * xi.x - 1.0;
    float outside = (1.0 - abs(side)) * cap;
    float root = pow(6.0 * outside, 1.0 / 3.0);
    float r2 = root * root;
    float psi = min(root * (1.0 + r2 * (1.0 / 60.0 + r2 / 1400.0)), 3.14159265);
    vec2 quarter;
    [[unroll]] for (int i = 0; i < 2; ++i) {
        quarter = cosine_and_sine(0.25 * psi);
        float sine = 2.0 * quarter.x * quarter.y;
        psi -= psi > 0.0 ? (excess(psi) - outside) / (2.0 * sine * sine) : 0.0;
    }
    quarter = cosine_and_sine(0.25 * psi);
    float cosine = 1.0 - 2.0 * quarter.y * quarter.y;
    float sine = 2.0 * quarter.x * quarter.y;
    float x = middle + sign(side) * (cosine - middle);
    float y = (2.0 * xi.y - 1.0) * sine;
    return vec3(x * axis + y * vec2(-axis.y, axis.x), cap / 3.14159265);
}

float sum_at(uint i) {
    return uintBitsToFloat(texelFetch(aperture_sums, int(i >> 2u))[i & 3u]);
}

// The cell of a value, of those whose sums start there, and in its fraction how far within.
float cell_place(uint first, uint cells, float value) {
    uint cell = 0u;
    [[unroll]] for (uint step = 128u; step > 0u; step >>= 1u) {
        if (cell + step < cells && sum_at(first + cell + step) <= value) {
            cell += step;
        }
    }
    float before = sum_at(first + cell);
    float light = sum_at(first + cell + 1u) - before;
    return float(cell) + (light > 0.0 ? (value - before) / light : 0.5);
}

// Of the image, more often where it is brighter.
vec2 imaged_point(vec2 xi) {
    uvec2 cells = aperture.cells;
    float down = cell_place(0u, cells.y, xi.y);
    uint row = min(uint(down), cells.y - 1u);
    float across = cell_place(cells.y + 1u + row * (cells.x + 1u), cells.x, xi.x);
    return vec2(2.0 * across / float(cells.x) - 1.0, 1.0 - 2.0 * down / float(cells.y));
}

// A point of the opening, whose rim is at one or nearer; and in z the share of light that is let in on the
// way to the film point q.
vec3 aperture_point(vec2 q, vec2 xi) {
    switch (APERTURE) {
    case APERTURE_BLADES:
        return vec3(aperture.stretch * bladed_point(xi), 1.0);
    case APERTURE_CATS_EYE:
        // What comes from the right has passed the front rim farther left.
        vec2 off = -aperture.cats_eye * q;
        off *= min(1.0, aperture.most_cats_eye / max(length(off), 1e-20));
        vec3 point = overlap_point(off, xi);
        return vec3(aperture.stretch * point.xy, point.z);
    case APERTURE_IMAGE:
        return vec3(aperture.stretch * imaged_point(xi), 1.0);
    case APERTURE_ELLIPSE:
        return vec3(aperture.stretch * concentric_disk(xi), 1.0);
    default:
        return vec3(concentric_disk(xi), 1.0);
    }
}

#endif
