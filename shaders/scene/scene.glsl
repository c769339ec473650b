// The scene as the shaders see it, in coordinates whose origin is near its middle.

#ifndef SCENE_GLSL
#define SCENE_GLSL

#include "light/record.glsl"
#include "material/record.glsl"
#include "shape/kinds.glsl"

// Whether a set of kinds, which has a bit for each kind, contains this one. This is a macro, so that the answer for a
// specialization constant is a constant.
#define HAS_KIND(kinds, kind) (((kinds) >> (kind) & 1u) != 0u)

// Whether a thing is of this kind. Where the scene has one kind alone, the compiler knows the answer.
#define IS_OF_KIND(kinds, kind_of_thing, kind) (HAS_KIND(kinds, kind) && ((kinds) == 1u << (kind) || (kind_of_thing) == (kind)))

// Where lights and listed shapes are read from. A software device copies those of a small scene to variables before any
// control flow: Mesa's loads from a buffer lane by lane inside loops and branches, and once for all lanes outside of
// them, which makes rays about three times as fast. A GPU would run out of registers, so there they are in a uniform
// buffer.
layout(constant_id = ID_SCENE_PLACE) const uint SCENE_PLACE = SCENE_IN_BUFFERS;
// 1 where the scene is copied to variables, otherwise 0.
const uint SCENE_IS_KEPT = SCENE_PLACE >> 1u;

// In a small scene, the numbers of lights and materials are specialization constants, so that loops over them can unroll.
// For shapes, the constants are where the range of each kind ends in the list: see build.rs. In other scenes, all of
// these are read from SceneCounts, so that the pipelines of one scene serve every other scene that has things of the
// same kinds.
layout(constant_id = ID_LIGHT_COUNT) const uint LIGHT_COUNT = 1u;
layout(constant_id = ID_SHADOW_LIGHT_COUNT) const uint SHADOW_LIGHT_COUNT = 1u; // these come first, and cast shadows
layout(constant_id = ID_MATERIAL_COUNT) const uint MATERIAL_COUNT = 1u;

// The numbers of things that the shaders loop over.
struct SceneCounts {
    uvec4 list_ends[(SHAPE_KIND_COUNT + 3u) / 4u]; // where each kind's range ends, counted from the list's first shape
    uint list_begin; // the record of the list's first shape
    uint lights;
    uint shadow_lights; // these come first, and cast shadows
    uint max_tree_steps; // a ray that needs more is given up
    uint lamps;
    float lamp_power; // the sum over the lamps of luminance times area
};

// The kinds of shapes in the scene, a bit for each: the code for all other kinds is left out.
layout(constant_id = ID_SHAPE_KINDS) const uint SHAPE_KINDS = 0u;
// Whether any shape moves.
layout(constant_id = ID_SCENE_MOVES) const uint SCENE_MOVES = 0u;
// Whether checkers have a phase.
layout(constant_id = ID_SCENE_IS_SHIFTED) const uint SCENE_IS_SHIFTED = 0u;

// The nodes and shapes of the tree, if there is one, then the shapes of the list: three texels each.
layout(set = 0, binding = BINDING_RECORDS) uniform usamplerBuffer records;
// The velocity of each shape, by the shape's index, in scene units per second.
layout(set = 0, binding = BINDING_VELOCITIES) uniform usamplerBuffer velocities;
layout(constant_id = ID_LIST_BEGIN) const uint LIST_BEGIN = 0u; // the record of the list's first shape
layout(set = 0, binding = BINDING_MATERIALS, std430) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = BINDING_LIGHTS, std430) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = BINDING_SCENE, std140) uniform Scene {
    Environment environment;
    SceneCounts counts;
    Light small_lights[SMALL_SCENE]; // of a small scene all lights
    ShapeRecord small_list[SMALL_SCENE]; // of a small scene all shapes of the list
};

uint list_begin() { if (SCENE_IS_KEPT == 1u) { return LIST_BEGIN; } return counts.list_begin; }
uint light_count() { if (SCENE_PLACE == SCENE_IN_BUFFERS) { return counts.lights; } return LIGHT_COUNT; }
uint shadow_light_count() { if (SCENE_PLACE == SCENE_IN_BUFFERS) { return counts.shadow_lights; } return SHADOW_LIGHT_COUNT; }
// Where a kind of shapes ends in the list; known is the constant.
uint range_end(const uint kind, const uint known) {
    return SCENE_PLACE == SCENE_IN_BUFFERS ? counts.list_ends[kind / 4u][kind % 4u] : known;
}
uint range_begin(const uint kind, const uint known) { return kind == 0u ? 0u : range_end(kind - 1u, known); }

void fetch_record(const uint index, out uvec4 record[3]) {
    int at = int(3u * index);
    record[0] = texelFetch(records, at);
    record[1] = texelFetch(records, at + 1);
    record[2] = texelFetch(records, at + 2);
}

// The number of a node's children, from the last word of its first texel. In a shape's record this word is the index of
// the material, which is too small to reach the upper byte.
uint child_count(const uint exponents_and_child_count) {
    return exponents_and_child_count >> 24u;
}

// The shape in a record. A node becomes a shape of size zero.
//
// Where branches are only masked, a node also goes through the arithmetic of a shape. Its packed bytes would be
// denormal floats there, and Intel's processors take about a hundred times as long for an operation on one. So
// the integers of a node lie where a shape has integers too, or are cleared before they are taken for floats.
ShapeRecord to_shape(const uvec4 record[3]) {
    // All ones for a shape, zero for a node. This is written without a comparison: a compiler that recognizes the
    // condition of the branch that the call stands in takes it for true, and leaves the mask out.
    uint if_shape = uint(int(child_count(record[0].w)) - 1 >> 31);
    return ShapeRecord(
        uintBitsToFloat(record[0].xyz), record[0].w, uintBitsToFloat(record[1].xyz & if_shape), record[1].w,
        uintBitsToFloat(record[2].xyz & if_shape), record[2].w
    );
}

ShapeRecord fetch_shape(const uint index) {
    uvec4 record[3];
    fetch_record(index, record);
    return to_shape(record);
}

vec3 fetch_velocity(const uint index) {
    return uintBitsToFloat(texelFetch(velocities, int(index)).xyz);
}

// How many of each are copied. There are none where the scene is not copied, because some compilers reserve room for
// every element of an array, whether it is used or not.
const uint KEPT_SHAPES = SHAPES_END * SCENE_IS_KEPT;
const uint KEPT_MATERIALS = MATERIAL_COUNT * SCENE_IS_KEPT;
const uint KEPT_LIGHTS = LIGHT_COUNT * SCENE_IS_KEPT;
const uint KEPT_MOVING = BOUNDED_SHAPES_END * SCENE_IS_KEPT * SCENE_MOVES;

// The copies. Each array has one element to spare, because GLSL has no empty arrays.
ShapeRecord kept_shapes[KEPT_SHAPES + 1u];
Material kept_materials[KEPT_MATERIALS + 1u];
Light kept_lights[KEPT_LIGHTS + 1u];
vec3 kept_velocities[KEPT_MOVING + 1u];
Environment kept_environment;

// This must be the first call in main().
void keep_scene() {
    if (SCENE_IS_KEPT == 0u) {
        return;
    }
    [[unroll]] for (uint i = 0u; i < KEPT_SHAPES; ++i) { kept_shapes[i] = fetch_shape(LIST_BEGIN + i); }
    [[unroll]] for (uint i = 0u; i < KEPT_MATERIALS; ++i) { kept_materials[i] = materials[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_LIGHTS; ++i) { kept_lights[i] = lights[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_MOVING; ++i) { kept_velocities[i] = fetch_velocity(kept_shapes[i].index); }
    kept_environment = environment;
}

ShapeRecord get_listed(const uint i) {
    if (SCENE_IS_KEPT == 1u) {
        return kept_shapes[i];
    }
    if (SCENE_PLACE == SCENE_IN_UNIFORMS) {
        return small_list[i];
    }
    return fetch_shape(list_begin() + i);
}
vec3 get_velocity(const uint i, const ShapeRecord shape) {
    if (SCENE_IS_KEPT == 1u) {
        return kept_velocities[i];
    }
    return fetch_velocity(shape.index);
}
Light get_light(const uint i) {
    if (SCENE_IS_KEPT == 1u) {
        return kept_lights[i];
    }
    if (SCENE_PLACE == SCENE_IN_UNIFORMS) {
        return small_lights[i];
    }
    return lights[i];
}
Environment get_environment() { if (SCENE_IS_KEPT == 1u) { return kept_environment; } return environment; }

// The index differs from invocation to invocation, so the copies are gone through instead of indexed.
Material get_material(const uint index) {
    if (SCENE_IS_KEPT == 0u) {
        return materials[index];
    }
    Material material = kept_materials[0];
    [[unroll]] for (uint i = 1u; i < KEPT_MATERIALS; ++i) {
        if (index == i) {
            material = kept_materials[i];
        }
    }
    return material;
}

#endif
