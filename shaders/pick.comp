#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// What the camera sees at one place of the film, in the middle of the exposure: along the ray through the centre of the
// lens, along a vertical and a horizontal fan of rays through the lens, and along the first samples of the pixel. The
// result serves for focusing, for drawing the optics, and for telling what lies under the pointer.

layout(local_size_x = 8) in;

#include "aperture/aperture.glsl"
#include "camera/thin_lens.glsl"
#include "scene/intersect.glsl"

struct PickedRay {
    vec3 origin;
    float distance; // to the surface that the ray meets; MISS if it meets none
    vec3 direction;
    uint material;
    vec3 focus; // where the centre ray of the same film position meets the focal plane
};

layout(push_constant, std430) uniform PickPush {
    Camera camera;
    uvec2 extent;
    vec2 position; // in pixels from the picture's upper left corner
    uint fan; // the number of rays in each fan, at least two
    uint samples;
    uint seed;
} push;

layout(set = 0, binding = BINDING_PICKED_RAYS, std430) writeonly buffer PickedRays { PickedRay picked[]; };

// The point of the lens, whose radius is one, that a ray passes: the centre, or a point of a fan from rim to rim.
vec2 fan_point(const uint ray) {
    if (ray == 0u) {
        return vec2(0.0);
    }
    uint of_fan = (ray - 1u) % push.fan;
    float along = 2.0 * float(of_fan) / float(push.fan - 1u) - 1.0;
    return aperture.stretch * (ray <= push.fan ? vec2(0.0, along) : vec2(along, 0.0));
}

void main() {
    keep_scene();
    keep_aperture();
    uint i = gl_GlobalInvocationID.x;
    if (i >= 1u + 2u * push.fan + push.samples) {
        return;
    }
    uvec2 pixel = uvec2(push.position);
    vec2 offset = push.position - vec2(pixel) - 0.5;
    vec2 q = view_plane_point(push.camera, push.extent, pixel, offset);
    vec2 lens_point = fan_point(i);
    if (i > 2u * push.fan) {
        uvec4 keys = sample_keys(push.seed, pixel, BLOCK_FILM_AND_LENS);
        vec4 xi = sample_values(keys, i - 1u - 2u * push.fan);
        q = view_plane_point(push.camera, push.extent, pixel, film_offset(xi.xy, push.camera.jitter));
        lens_point = aperture_point(q, xi.zw).xy;
    }
    Ray ray = primary_ray(push.camera, q, lens_point, GREEN);
    bool given_up = false;
    Hit hit = intersect_scene(ray, given_up);
    Camera camera = push.camera;
    vec3 centre_ray = q.x * camera.u + q.y * camera.v - camera.w;
    vec3 focus = camera.eye + centre_ray / inverse_depth_in_focus(camera, q);
    picked[i] = PickedRay(ray.origin, given_up ? MISS : hit.distance, ray.direction, hit.material, focus);
}
