// The scene as the shaders see it. Shapes are numbered spheres first, then boxes, triangles,
// planes; material_of_shape is indexed by that number.

#ifndef SCENE_GLSL
#define SCENE_GLSL

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
    vec3 edge1;
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
    float inverse_checker_size; // 0: one colour
};

struct Light {
    vec3 radiance;
    uint casts_shadows;
    vec3 position_or_direction; // a direction points from the surface to the light
    uint is_directional;
};

struct Environment {
    vec3 horizon;
    vec3 zenith;
    vec3 ambient; // radiance
};

// The numbers of things are specialization constants: a loop with a constant count unrolls, and
// what it loads is then loaded once for all invocations.
layout(constant_id = 1) const uint SPHERE_COUNT = 1u;
layout(constant_id = 2) const uint BOX_COUNT = 1u;
layout(constant_id = 3) const uint TRIANGLE_COUNT = 1u;
layout(constant_id = 4) const uint PLANE_COUNT = 1u;
layout(constant_id = 5) const uint LIGHT_COUNT = 1u;

layout(set = 0, binding = 2, std430) readonly buffer Spheres { Sphere spheres[]; };
layout(set = 0, binding = 3, std430) readonly buffer Boxes { Box boxes[]; };
layout(set = 0, binding = 4, std430) readonly buffer Triangles { Triangle triangles[]; };
layout(set = 0, binding = 5, std430) readonly buffer Planes { Plane planes[]; };
layout(set = 0, binding = 6, std430) readonly buffer MaterialOfShape { uint material_of_shape[]; };
layout(set = 0, binding = 7, std430) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 8, std430) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 9, std430) readonly buffer EnvironmentBuffer { Environment environment; };

#endif
