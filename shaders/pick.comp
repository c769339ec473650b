#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// What the camera sees at one place of the film: the ray through the centre of the lens, and what it
// meets. For focusing, and for whoever wants to know what lies under the pointer.

layout(local_size_x = 1) in;

#include "intersect.glsl"

struct PickedRay {
    vec3 origin;
    float distance; // to what it meets; MISS where that is nothing
    vec3 direction;
    uint material;
};

layout(push_constant, std430) uniform PickPush {
    Camera camera;
    uvec2 extent;
    vec2 position; // in pixels from the picture's upper left corner
} push;

layout(set = 0, binding = 0, std430) writeonly buffer PickedRays { PickedRay picked[]; };

void main() {
    keep_scene();
    uvec2 pixel = uvec2(push.position);
    vec2 offset = push.position - vec2(pixel) - 0.5;
    vec2 q = view_plane_point(push.camera, push.extent, pixel, offset);
    Ray ray = primary_ray(push.camera, q, vec2(0.0));
    bool given_up = false;
    Hit hit = intersect_scene(ray, given_up);
    picked[0] = PickedRay(ray.origin, given_up ? MISS : hit.distance, ray.direction, hit.material);
}
