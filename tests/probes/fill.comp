#version 460

// Puts a film of a test's choice into an image.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std430) readonly buffer Inputs { vec4 texels[]; };
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D film_image;

void main() {
    ivec2 extent = imageSize(film_image);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x < extent.x && pixel.y < extent.y) {
        imageStore(film_image, pixel, texels[pixel.y * extent.x + pixel.x]);
    }
}
