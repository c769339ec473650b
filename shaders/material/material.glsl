// What surfaces do with light. A kind of material is a file beside this one: see record.glsl.

#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL

#include "material/kinds.glsl"
#include "texture/texture.glsl"

// What the sides of a surface mean: nothing. Every material looks the same from both, so the normals are turned to the
// side that the ray comes from, and so is what goes on from there.
void turn_sides(inout SurfacePoint at, vec3 direction) {
    bool from_behind = dot(at.normal, direction) > 0.0;
    at.normal = from_behind ? -at.normal : at.normal;
    at.shading_normal = from_behind ? -at.shading_normal : at.shading_normal;
    at.lifted = at.position + at.error * at.normal;
}

#define IF_MATERIAL(KIND) if (is_of_kind(MATERIAL_KINDS, material.kind, MATERIAL_##KIND))

vec3 material_emission(Material material, vec3 color) {
    vec3 value = vec3(0.0);
#define EMISSION(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_emission(material, color); }
    FOR_EACH_MATERIAL_EMISSION(EMISSION)
    return value;
}

vec3 material_ambient(Material material, vec3 color) {
    vec3 value = vec3(0.0);
#define AMBIENT(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_ambient(material, color); }
    FOR_EACH_MATERIAL_AMBIENT(AMBIENT)
    return value;
}

vec3 material_f(Material material, vec3 color, SurfacePoint at, vec3 to_light, vec3 to_viewer) {
    vec3 value = vec3(0.0);
#define REFLECTED(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_f(material, color, at, to_light, to_viewer); }
    FOR_EACH_MATERIAL_F(REFLECTED)
    return value;
}

// With a weight of zero for those that scatter nothing.
Scatter material_sample(Material material, vec3 color, SurfacePoint at, vec3 direction) {
    Scatter value = Scatter(vec3(0.0), vec3(0.0));
#define SAMPLE(KIND, kind_) IF_MATERIAL(KIND) { value = kind_##_sample(material, color, at, direction); }
    FOR_EACH_MATERIAL_SAMPLE(SAMPLE)
    return value;
}

#endif
