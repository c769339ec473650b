// Suffern's 3D checker: color where the sum of a cell's coordinates is even, other_color where it is odd. A face that
// lies on the boundary of two layers of cells belongs to the lower layer. phase is where the origin of the device's
// coordinates lies in the scene's own coordinates, modulo the period of the checker.

#ifndef CHECKER_GLSL
#define CHECKER_GLSL

#include "scene/surface.glsl"

// The position is lowered by as much as it may be off, and by the rounding error of the phase, which is up to two
// cells.
vec3 checker_value(const Texture of, const SurfacePoint at) {
    vec3 position = at.rest_position;
    position -= at.error + 2.0 * ROUNDING / of.inverse_size;
    if (SCENE_IS_SHIFTED == 1u) {
        position += of.phase;
    }
    ivec3 cell = ivec3(floor(position * of.inverse_size));
    bool odd = ((cell.x + cell.y + cell.z) & 1) != 0;
    return odd ? of.other_color : of.color;
}

#endif
