// Materials, which say what surfaces do with light. Each kind is a file beside this one: see record.glsl.

#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL

#include "material/kinds.glsl"
#include "texture/texture.glsl"

// Every material but glass looks the same from both sides of a surface. So this turns the normals to the side that the ray comes
// from, and puts the origin of further rays on that side.
void face_forward(inout SurfacePoint at, const vec3 direction) {
    at.from_behind = dot(at.normal, direction) > 0.0;
    at.normal = at.from_behind ? -at.normal : at.normal;
    at.shading_normal = at.from_behind ? -at.shading_normal : at.shading_normal;
    at.offset_position = at.position + at.error * at.normal;
}

#define IF_MATERIAL(KIND) if (IS_OF_KIND(MATERIAL_KINDS, material.kind, MATERIAL_##KIND))

vec3 material_emission(const Material material, const vec3 color) {
    vec3 value = vec3(0.0);
#define EMISSION(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_emission(material, color); }
    FOR_EACH_MATERIAL_EMISSION(EMISSION)
    return value;
}

vec3 material_ambient(const Material material, const vec3 color) {
    vec3 value = vec3(0.0);
#define AMBIENT(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_ambient(material, color); }
    FOR_EACH_MATERIAL_AMBIENT(AMBIENT)
    return value;
}

vec3 material_f(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light,
    const vec3 to_viewer
) {
    vec3 value = vec3(0.0);
#define REFLECTED(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_f(material, color, at, to_light, to_viewer); }
    FOR_EACH_MATERIAL_F(REFLECTED)
    return value;
}

// The weight is zero if the material shows no mirror image.
Scatter material_mirrored(const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer) {
    Scatter value = NO_SCATTER;
#define MIRRORED(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_mirrored(material, color, at, to_viewer); }
    FOR_EACH_MATERIAL_MIRRORED(MIRRORED)
    return value;
}

// The weight is zero if the material scatters no light.
Scatter material_sample(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_viewer, const vec3 xi
) {
    Scatter value = NO_SCATTER;
#define SAMPLE(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_sample(material, color, at, to_viewer, xi); }
    FOR_EACH_MATERIAL_SAMPLE(SAMPLE)
    return value;
}

// Both parts are zero if the material scatters into single directions, or if the light is behind the surface.
Scattered material_scattered(
    const Material material, const vec3 color, const SurfacePoint at, const vec3 to_light, const vec3 to_viewer
) {
    Scattered value = Scattered(vec3(0.0), 0.0);
    if (dot(at.normal, to_light) <= 0.0 || dot(at.shading_normal, to_light) <= 0.0) {
        return value;
    }
#define SCATTERED(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_scattered(material, color, at, to_light, to_viewer); }
    FOR_EACH_MATERIAL_SCATTERED(SCATTERED)
    return value;
}

#endif
