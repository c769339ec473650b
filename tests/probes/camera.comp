#version 460
#extension GL_GOOGLE_include_directive : require

// The primary ray of a film position and a lens point.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "camera/thin_lens.glsl"

struct In {
    uvec2 pixel;
    vec2 offset;
    vec2 disk;
};

struct Out {
    vec3 origin;
    vec3 direction;
};

layout(push_constant, std430) uniform CameraPush {
    Camera camera;
    uvec2 extent;
} push;

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        In given = inputs[i];
        vec2 q = view_plane_point(push.camera, push.extent, given.pixel, given.offset);
        Ray ray = primary_ray(push.camera, q, given.disk, GREEN);
        outputs[i] = Out(ray.origin, ray.direction);
    }
}
