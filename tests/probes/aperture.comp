#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// A point of the aperture, for a film point and two sample values.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "aperture/aperture.glsl"

struct In {
    vec2 q;
    vec2 xi;
};

struct Out {
    vec3 point;
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    keep_aperture();
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        outputs[i] = Out(aperture_point(inputs[i].q, inputs[i].xi));
    }
}
