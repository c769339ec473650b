#version 460
#extension GL_GOOGLE_include_directive : require

// The encoding of linear values.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "core/color.glsl"

struct In {
    vec3 linear;
};

struct Out {
    vec3 encoded;
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        outputs[i].encoded = srgb_encode(inputs[i].linear);
    }
}
