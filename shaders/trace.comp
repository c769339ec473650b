#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// Pass 1: traces a batch of samples for each pixel of the lattice and writes one texel: their mean
// and their number. In an adaptive picture, their second moment too.

layout(local_size_x = 8, local_size_y = 8) in;

#include "trace_batch.glsl"

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D batch_image;
layout(set = 0, binding = 14, r32f) writeonly uniform image2D batch_moments;

void main() {
    keep_scene();
    keep_aperture();
    TracePush push = push_constants;
    uvec2 pixel;
    if (find_pixel(push.lattice, pixel)) {
        float moment;
        imageStore(batch_image, ivec2(pixel), trace_batch(push, pixel, moment));
        if (IS_ADAPTIVE == 1u) {
            imageStore(batch_moments, ivec2(pixel), vec4(moment));
        }
    }
}
