#version 460
#extension GL_GOOGLE_include_directive : require

// Puts a film of a test's choice into an image.

layout(local_size_x = 8, local_size_y = 8) in;

#include "interface.glsl"

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { vec4 texels[]; };
layout(set = 0, binding = BINDING_FILM_IMAGE, rgba32f) writeonly uniform image2D film_image;

void main() {
    ivec2 extent = imageSize(film_image);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x < extent.x && pixel.y < extent.y) {
        imageStore(film_image, pixel, texels[pixel.y * extent.x + pixel.x]);
    }
}
