#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// For overlays: how deep each pixel's middle sees through the centre of the lens, along the optical axis, in
// the middle of the exposure.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "camera/thin_lens.glsl"
#include "core/film.glsl"
#include "scene/intersect.glsl"

layout(set = 0, binding = BINDING_DEPTH_IMAGE, r32f) writeonly uniform image2D depth_image;

layout(push_constant, std430) uniform GeometryPush {
    Camera camera;
    uvec2 extent;
    uint top; // the first row
} push;

void main() {
    keep_scene();
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.top);
    if (!inside(pixel, push.extent)) {
        return;
    }
    vec2 q = view_plane_point(push.camera, push.extent, pixel, vec2(0.0));
    Ray ray = primary_ray(push.camera, q, vec2(0.0));
    bool given_up = false;
    Hit hit = intersect_scene(ray, given_up);
    float depth = hit.distance < MISS ? hit.distance * -dot(ray.direction, push.camera.w) : MISS;
    imageStore(depth_image, ivec2(pixel), vec4(given_up ? MISS : depth));
}
