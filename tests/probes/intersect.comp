#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// What a ray meets first, and whether it meets anything before a limit.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "scene/intersect.glsl"

struct In {
    vec3 origin;
    vec3 direction;
    float limit;
};

struct Out {
    vec3 normal; // unit length, of the surface, as the shape has it
    float distance;
    uint material;
    uint occluded;
    vec2 uv;
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    keep_scene();
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        In given = inputs[i];
        Ray ray = Ray(given.origin, given.direction);
        bool given_up = false;
        Hit hit = intersect_scene(ray, given_up);
        vec3 position = ray.origin + hit.distance * ray.direction;
        float error;
        vec3 normal = project_onto_surface(hit.surface, position, error);
        bool found = hit.distance < MISS;
        outputs[i] = Out(
            found ? normal : vec3(0.0), hit.distance, found ? hit.material : 0u,
            uint(occluded(ray, given.limit, given_up)), found ? hit.surface.uv : vec2(0.0)
        );
    }
}
