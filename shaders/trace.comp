#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// Pass 1: traces a batch of samples for each pixel of the lattice and writes one texel: their mean
// and their number.

layout(local_size_x = 8, local_size_y = 8) in;

#include "trace_batch.glsl"

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D batch_image;

void main() {
    keep_scene();
    TracePush push = push_constants;
    uvec2 pixel = lattice_pixel(push.lattice, gl_GlobalInvocationID.xy);
    if (inside(pixel, push.lattice.extent)) {
        imageStore(batch_image, ivec2(pixel), trace_batch(push, pixel));
    }
}
