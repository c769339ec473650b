// The scene as the shaders see it, in coordinates whose origin is near its middle. Shapes are numbered spheres
// first, then boxes, triangles, planes; material_of_shape is indexed by that number.

#ifndef SCENE_GLSL
#define SCENE_GLSL

#include "interface.glsl"

struct Sphere {
    vec3 center;
    float radius;
};

struct Box {
    vec3 lower;
    vec3 upper;
};

struct Triangle {
    vec3 vertex;
    float offset; // dot(cross(edge1, edge2), vertex)
    vec3 edge1;
    float size; // of its longest edge, along an axis
    vec3 edge2;
};

// Points x with dot(normal, x) = offset.
struct Plane {
    vec3 normal;
    float offset;
};

struct Material {
    vec3 color;
    float ka;
    vec3 odd_color; // the checker's second colour
    float kd;
    vec3 reflectance; // kr * colour of the mirror
    float ks;
    vec3 emission;
    float exponent;
    vec3 checker_phase; // where the scene's own origin lies in the checker, as seen from the device's
    float inverse_checker_size; // 0: one colour
};

struct Light {
    vec3 radiance;
    uint is_directional;
    vec3 position_or_direction; // a direction points from the surface to the light
};

struct Environment {
    vec3 horizon;
    vec3 zenith;
    vec3 ambient; // radiance
    float reach; // every shape but planes lies within this distance of the origin, at any time
};

// The numbers of things are specialization constants, so that loops over them can unroll.
layout(constant_id = ID_SPHERE_COUNT) const uint SPHERE_COUNT = 1u;
layout(constant_id = ID_BOX_COUNT) const uint BOX_COUNT = 1u;
layout(constant_id = ID_TRIANGLE_COUNT) const uint TRIANGLE_COUNT = 1u;
layout(constant_id = ID_PLANE_COUNT) const uint PLANE_COUNT = 1u;
layout(constant_id = ID_LIGHT_COUNT) const uint LIGHT_COUNT = 1u;
layout(constant_id = ID_SHADOW_LIGHT_COUNT) const uint SHADOW_LIGHT_COUNT = 1u; // the first so many lights cast shadows
layout(constant_id = ID_MATERIAL_COUNT) const uint MATERIAL_COUNT = 1u;
// Whether the scene is copied to variables before any control flow. Mesa's software device loads from
// a buffer lane by lane inside loops and branches, and once for all lanes outside of them, which makes
// rays about three times as fast. A GPU would run out of registers.
layout(constant_id = ID_SCENE_IS_KEPT) const uint SCENE_IS_KEPT = 0u;

// Whether any shape moves.
layout(constant_id = ID_SCENE_MOVES) const uint SCENE_MOVES = 0u;
// Whether checkers have a phase.
layout(constant_id = ID_SCENE_IS_SHIFTED) const uint SCENE_IS_SHIFTED = 0u;

// Of the sample that is traced: seconds from the middle of the exposure, where the shapes are as given.
float ray_time = 0.0;

layout(set = 0, binding = BINDING_SPHERES, std430) readonly buffer Spheres { Sphere spheres[]; };
layout(set = 0, binding = BINDING_BOXES, std430) readonly buffer Boxes { Box boxes[]; };
layout(set = 0, binding = BINDING_TRIANGLES, std430) readonly buffer Triangles { Triangle triangles[]; };
layout(set = 0, binding = BINDING_PLANES, std430) readonly buffer Planes { Plane planes[]; };
layout(set = 0, binding = BINDING_MATERIAL_OF_SHAPE, std430) readonly buffer MaterialOfShape { uint material_of_shape[]; };
layout(set = 0, binding = BINDING_MATERIALS, std430) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = BINDING_LIGHTS, std430) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = BINDING_ENVIRONMENT, std430) readonly buffer EnvironmentBuffer { Environment environment; };

layout(set = 0, binding = BINDING_VELOCITIES, std430) readonly buffer Velocities { vec4 velocities[]; }; // a second

// How many of each are copied: none where the scene is not, for some compilers find room for every element of
// an array, used or not.
const uint KEPT_SPHERES = SPHERE_COUNT * SCENE_IS_KEPT;
const uint KEPT_BOXES = BOX_COUNT * SCENE_IS_KEPT;
const uint KEPT_TRIANGLES = TRIANGLE_COUNT * SCENE_IS_KEPT;
const uint KEPT_PLANES = PLANE_COUNT * SCENE_IS_KEPT;
const uint KEPT_MATERIALS = MATERIAL_COUNT * SCENE_IS_KEPT;
const uint KEPT_LIGHTS = LIGHT_COUNT * SCENE_IS_KEPT;
const uint KEPT_MOVING = (SPHERE_COUNT + BOX_COUNT + TRIANGLE_COUNT) * SCENE_IS_KEPT * SCENE_MOVES;
const uint KEPT_SHAPES = (SPHERE_COUNT + BOX_COUNT + TRIANGLE_COUNT + PLANE_COUNT) * SCENE_IS_KEPT;

// The copies. There is one element to spare, for there are no empty arrays.
Sphere kept_spheres[KEPT_SPHERES + 1u];
Box kept_boxes[KEPT_BOXES + 1u];
Triangle kept_triangles[KEPT_TRIANGLES + 1u];
Plane kept_planes[KEPT_PLANES + 1u];
uint kept_material_of_shape[KEPT_SHAPES + 1u];
Material kept_materials[KEPT_MATERIALS + 1u];
Light kept_lights[KEPT_LIGHTS + 1u];
vec4 kept_velocities[KEPT_MOVING + 1u];
Environment kept_environment;

// To be called first thing in main().
void keep_scene() {
    if (SCENE_IS_KEPT == 0u) {
        return;
    }
    [[unroll]] for (uint i = 0u; i < KEPT_SPHERES; ++i) { kept_spheres[i] = spheres[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_BOXES; ++i) { kept_boxes[i] = boxes[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_TRIANGLES; ++i) { kept_triangles[i] = triangles[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_PLANES; ++i) { kept_planes[i] = planes[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_SHAPES; ++i) { kept_material_of_shape[i] = material_of_shape[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_MATERIALS; ++i) { kept_materials[i] = materials[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_LIGHTS; ++i) { kept_lights[i] = lights[i]; }
    [[unroll]] for (uint i = 0u; i < KEPT_MOVING; ++i) { kept_velocities[i] = velocities[i]; }
    kept_environment = environment;
}

Sphere get_sphere(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_spheres[i]; } return spheres[i]; }
Box get_box(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_boxes[i]; } return boxes[i]; }
Triangle get_triangle(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_triangles[i]; } return triangles[i]; }
Plane get_plane(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_planes[i]; } return planes[i]; }
uint get_material_of_shape(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_material_of_shape[i]; } return material_of_shape[i]; }
Light get_light(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_lights[i]; } return lights[i]; }
vec4 get_velocity(uint i) { if (SCENE_IS_KEPT == 1u) { return kept_velocities[i]; } return velocities[i]; }
Environment get_environment() { if (SCENE_IS_KEPT == 1u) { return kept_environment; } return environment; }

// How far a shape of the lists has come by now.
vec3 way_of(uint shape) {
    return ray_time * get_velocity(shape).xyz;
}

// The index differs from invocation to invocation.
Material get_material(uint index) {
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
