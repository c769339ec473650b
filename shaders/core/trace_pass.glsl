// Pass 1: traces a batch of samples for each pixel of the lattice, and writes their mean and their number to a texel of
// the tracing image. If the film has second moments, it also writes the second moment of the batch.

#ifndef TRACE_PASS_GLSL
#define TRACE_PASS_GLSL

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "core/trace_batch.glsl"

layout(set = 0, binding = BINDING_TRACED_IMAGE, rgba32f) writeonly uniform image2D traced_image;
layout(set = 0, binding = BINDING_TRACED_MOMENTS, r32f) writeonly uniform image2D traced_moments;

void main() {
    keep_scene();
    keep_aperture();
    TracePush push = push_constants;
    uvec2 pixel;
    if (find_pixel(push.lattice, pixel)) {
        float moment;
        imageStore(traced_image, ivec2(pixel), trace_batch(push, pixel, moment));
        if (HAS_MOMENTS == 1u) {
            imageStore(traced_moments, ivec2(pixel), vec4(moment));
        }
    }
}

#endif
