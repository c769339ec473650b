#version 460
#extension GL_GOOGLE_include_directive : require

// What the shaders' own functions give for one sample of each pixel, for optics tests to look at.

layout(local_size_x = 64) in;

#include "camera.glsl"
#include "color.glsl"
#include "sampling.glsl"

struct Probe {
    uvec4 bits;
    vec2 disk;
    vec2 offset;
    vec3 origin;
    float srgb; // of the first sample value
    vec3 direction;
    int landing; // steps to the right
};

layout(push_constant, std430) uniform ProbePush {
    Camera camera;
    uvec2 extent;
    uint seed;
    uint sample_index;
} push;

layout(set = 0, binding = 0, std430) writeonly buffer Probes { Probe probes[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.extent.x * push.extent.y) {
        return;
    }
    uvec2 pixel = uvec2(i % push.extent.x, i / push.extent.x);
    vec4 xi = sample_values(push.seed, pixel, push.sample_index, BLOCK_FILM_AND_LENS);
    vec2 offset = film_offset(xi.xy, push.camera.jitter);
    vec2 disk = concentric_disk(xi.zw);
    Ray ray = primary_ray(push.camera, view_plane_point(push.camera, push.extent, pixel, offset), disk);
    probes[i].bits = uvec4(xi * 16777216.0);
    probes[i].disk = disk;
    probes[i].offset = offset;
    probes[i].origin = ray.origin;
    probes[i].srgb = srgb_encode(vec3(xi.x)).x;
    probes[i].direction = ray.direction;
    probes[i].landing = landing_step(offset).x;
}
