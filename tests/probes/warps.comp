#version 460
#extension GL_GOOGLE_include_directive : require

// Where a sample's values put it: on the film, in which pixel, on the lens.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "core/sampling.glsl"

struct In {
    vec2 film;
    vec2 lens;
    float jitter;
};

struct Out {
    vec2 offset;
    ivec2 landing;
    vec2 disk;
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        In given = inputs[i];
        vec2 offset = film_offset(given.film, given.jitter);
        outputs[i] = Out(offset, landing_step(offset), concentric_disk(given.lens));
    }
}
