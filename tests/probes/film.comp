#version 460
#extension GL_GOOGLE_include_directive : require

// Merging a batch into a texel of the film, and which colours are finite.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "core/film.glsl"

struct In {
    vec4 film;
    vec4 batch;
};

struct Out {
    vec4 merged;
    uint batch_is_finite;
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        In given = inputs[i];
        outputs[i] = Out(merge(given.film, given.batch), uint(is_finite(given.batch.rgb)));
    }
}
