#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// The radiance along a ray.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "integrator/whitted.glsl"

struct In {
    vec3 origin;
    vec3 direction;
    float limit; // of no use here
};

struct Out {
    vec3 radiance;
    uint rays;
};

layout(push_constant, std430) uniform RadiancePush {
    uint limits;
} push;

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    keep_scene();
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        uint rays = 0u;
        bool given_up;
        vec3 sum = radiance(Ray(inputs[i].origin, inputs[i].direction), PathSampler(0u, uvec2(i, 0u), 0u), push.limits, rays, given_up);
        outputs[i] = Out(sum, rays);
    }
}
