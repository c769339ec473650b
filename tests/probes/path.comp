#version 460
#extension GL_GOOGLE_include_directive : require

// The values of a path's sampler, as whole numbers of 2^-24.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "core/sampling.glsl"

struct In {
    uvec2 pixel;
    uint sample_index;
    uint seed;
    uint bounce;
    uint use;
};

struct Out {
    uvec4 values;
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        In given = inputs[i];
        PathSampler path = PathSampler(given.seed, given.pixel, given.sample_index);
        outputs[i].values = uvec4(path_values(path, given.bounce, given.use) * 16777216.0);
    }
}
