// Suffern's 3D checker: color where the cells' coordinates sum to an even number, other_color where to an odd one. A face
// that lies on the boundary of two layers of cells belongs to the lower one. phase is where the scene's own origin lies in
// the checker, as seen from the device's.

#ifndef CHECKER_GLSL
#define CHECKER_GLSL

#include "scene/surface.glsl"

// The position is taken so much lower as it may be off, and as the phase, of up to two cells, is rounded.
vec3 checker_value(Texture of, SurfacePoint at) {
    vec3 position = at.on_shape;
    position -= at.error + 2.0 * ROUNDING / of.inverse_size;
    if (SCENE_IS_SHIFTED == 1u) {
        position += of.phase;
    }
    ivec3 cell = ivec3(floor(position * of.inverse_size));
    bool odd = ((cell.x + cell.y + cell.z) & 1) != 0;
    return odd ? of.other_color : of.color;
}

#endif
