#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// For overlays: the surface that each pixel's centre sees through the centre of the lens, in the middle of the
// exposure. In xyz is the unit normal on the side that is seen, in the camera's frame: right, up, and back towards the
// lens. In w is the depth along the optical axis, or MISS where there is no surface.

#include "interface.glsl"

layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

#include "camera/thin_lens.glsl"
#include "core/film.glsl"
#include "scene/intersect.glsl"

layout(set = 0, binding = BINDING_SURFACE_IMAGE, rgba32f) writeonly uniform image2D surface_image;

layout(push_constant, std430) uniform GeometryPush {
    Camera camera;
    vec3 w; // backwards along the optical axis
    uint top; // the first row of pixels of this dispatch
    uvec2 extent;
} push;

void main() {
    keep_scene();
    uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.top);
    if (!inside(pixel, push.extent)) {
        return;
    }
    vec2 q = view_plane_point(push.camera, push.extent, pixel, vec2(0.0));
    Ray ray = primary_ray(push.camera, q, vec2(0.0), GREEN);
    bool given_up = false;
    Hit hit = intersect_scene(ray, given_up);
    vec4 seen = vec4(vec3(0.0), MISS);
    if (hit.distance < MISS && !given_up) {
        vec3 position = ray.origin + hit.distance * ray.direction;
        float error;
        vec3 normal = project_onto_surface(hit.surface, position, error);
        float side = dot(normal, ray.direction) > 0.0 ? -1.0 : 1.0;
        normal = side * (hit.surface.shading_normal == vec3(0.0) ? normal : hit.surface.shading_normal);
        seen.xyz = normal * mat3(push.camera.u, push.camera.v, push.w);
        seen.w = hit.distance * -dot(ray.direction, push.w);
    }
    imageStore(surface_image, ivec2(pixel), seen);
}
