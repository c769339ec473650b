// The clear bodies that a path is inside of. Bodies may lie in each other, or overlap: then the one that the path has
// entered last counts. So a drink that overlaps its glass a little touches it, without air in between.

#ifndef MEDIA_GLSL
#define MEDIA_GLSL

#include "scene/scene.glsl"

const bool HAS_MEDIA = HAS_KIND(MATERIAL_KINDS, MATERIAL_GLASS);

// The materials of up to four bodies, the one that was entered last first.
struct Media {
    uvec4 materials;
};

const uint AIR = 0xffffffffu;

Media in_air() {
    return Media(uvec4(AIR));
}

// The media after the surface of a body with this material is passed.
Media beyond_surface(const Media here, const uint material, const bool leaves) {
    uvec4 inside = here.materials;
    if (!leaves) {
        return Media(uvec4(material, inside.xyz));
    }
    if (inside.x == material) {
        return Media(uvec4(inside.yzw, AIR));
    }
    if (inside.y == material) {
        return Media(uvec4(inside.x, inside.zw, AIR));
    }
    if (inside.z == material) {
        return Media(uvec4(inside.xy, inside.w, AIR));
    }
    return inside.w == material ? Media(uvec4(inside.xyz, AIR)) : here;
}

float index_of(const Media media) {
    return media.materials.x == AIR ? 1.0 : get_material(media.materials.x).index;
}

// The share of light that is left after this distance.
vec3 transmittance(const Media media, const float distance) {
    return media.materials.x == AIR ? vec3(1.0) : exp(-distance * get_material(media.materials.x).color.color);
}

#endif
