#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// Trace and accumulate in one kernel, for two_pass.rs to compare with. Not part of the program.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "integrator/whitted.glsl"
#include "core/trace_batch.glsl"

layout(set = 0, binding = BINDING_FILM_IMAGE, rgba32f) uniform image2D film_image;

void main() {
    keep_scene();
    keep_aperture();
    TracePush push = push_constants;
    uvec2 pixel;
    if (find_pixel(push.lattice, pixel)) {
        float moment;
        vec4 film = imageLoad(film_image, ivec2(pixel));
        imageStore(film_image, ivec2(pixel), merge(film, trace_batch(push, pixel, moment)));
    }
}
