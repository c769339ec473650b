#version 460
#extension GL_GOOGLE_include_directive : require

// The batch of every pixel, in a buffer instead of the tracing image.

layout(local_size_x = 8, local_size_y = 8) in;

#include "trace_batch.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer Outputs { vec4 outputs[]; };

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (inside(pixel, push.lattice.extent)) {
        outputs[pixel.y * push.lattice.extent.x + pixel.x] = trace_batch(pixel);
    }
}
