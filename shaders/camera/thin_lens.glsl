// The thin-lens camera: Suffern, chapter 10.
//
// Camera frame: right-handed (u, v, w), looking along -w. The lens lies in the (u, v) plane
// around the eye; the focal plane is w = -focal_distance.

#ifndef CAMERA_GLSL
#define CAMERA_GLSL

#include "core/ray.glsl"

struct Camera {
    vec3 eye;
    float lens_radius;
    vec3 u;
    float inverse_focal_distance; // for a hole without a lens: -1 / v, where the film is at the distance v behind it
    vec3 v;
    float inverse_view_distance; // 1 / k: k is the view plane's distance in pixels; negative: upside down
    vec3 w;
    float jitter; // pixels
};

// The film position of a sample, as a point of the view plane at distance one, y up. The lens equations call it q.
// offset is in pixels from the centre of the pixel, y down.
vec2 view_plane_point(const Camera camera, const uvec2 extent, const uvec2 pixel, const vec2 offset) {
    vec2 from_centre = vec2(pixel) - 0.5 * (vec2(extent) - 1.0) + offset;
    return vec2(from_centre.x, -from_centre.y) * camera.inverse_view_distance;
}

// The primary ray of the film point q and the lens point l (unit disk).
//
// The centre ray runs from the lens centre through q and meets the focal plane at
// p = (F q.x, F q.y, -F). The primary ray runs from l to p, along (p - l) / F. If the lens radius
// is zero, the ray does not depend on F.
Ray primary_ray(const Camera camera, const vec2 q, const vec2 disk) {
    vec2 l = camera.lens_radius * disk;
    vec2 slope = q - l * camera.inverse_focal_distance;
    vec3 origin = camera.eye + l.x * camera.u + l.y * camera.v;
    vec3 direction = slope.x * camera.u + slope.y * camera.v - camera.w;
    return Ray(origin, normalize(direction));
}

#endif
