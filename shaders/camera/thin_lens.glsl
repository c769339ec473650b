// The thin-lens camera: Suffern, chapter 10.
//
// Camera frame: right-handed (u, v, w), looking along -w. The film is parallel to the (u, v) plane. The lens lies in this
// plane around the eye, unless it is tilted; then the focal plane is w = -focal_distance.
//
// The lens can be shifted beside the film: then the middle of the picture looks along -w + s, where s is the shift divided
// by the distance of the film. What the struct calls w is w - s, so a shift needs no code.
//
// A tilted lens, whose axis is n, images a plane of sharp focus that is tilted more than the lens is. The thin lens equation
// holds along n. The point in focus p and its film point lie on a line through the centre of the lens, so p lies at the
// depth z with 1 / z + 1 / v = c / f, where (q, -1) . n = c: 1 / z is linear in q. The lens equation is that of Scheimpflug's
// rule, and the slope of 1 / z is that of the hinge rule: docs/optics.md.

#ifndef CAMERA_GLSL
#define CAMERA_GLSL

#include "camera/movements.glsl"
#include "core/ray.glsl"

layout(constant_id = ID_HAS_DISPERSION) const uint HAS_DISPERSION = 0u;

// Where red, green and blue are in DISPERSION. What is in focus is in focus for green light.
const uint RED = 0u;
const uint GREEN = 1u;
const uint BLUE = 2u;

struct Camera {
    vec3 eye;
    float lens_radius;
    vec3 u;
    float inverse_focal_distance; // 1 / z in the middle of the picture; for a hole without a lens -1 / v, where v is the distance of the film
    vec3 v;
    float inverse_view_distance; // 1 / k: k is the view plane's distance in pixels; negative: upside down
    vec3 w; // minus the direction in which the middle of the picture looks, as long as its part along the camera's w is 1
    float jitter; // pixels
    vec2 tilt; // the axis of a tilted lens, as seen from the front: its parts along u and v
    float inverse_focal_length; // 1 / f
    float dispersion; // one over the Abbe number of the glass
};

// The film position of a sample, as a point of the view plane at distance one, y up. The lens equations call it q.
// offset is in pixels from the centre of the pixel, y down.
vec2 view_plane_point(const Camera camera, const uvec2 extent, const uvec2 pixel, const vec2 offset) {
    vec2 from_centre = vec2(pixel) - 0.5 * (vec2(extent) - 1.0) + offset;
    return vec2(from_centre.x, -from_centre.y) * camera.inverse_view_distance;
}

// 1 / z for the depth z in which the film point q is in focus.
float inverse_depth_in_focus(const Camera camera, const vec2 q) {
    float inverse = camera.inverse_focal_distance;
    if (HAS_MOVEMENTS == 1u) {
        inverse += dot(camera.tilt, q) * camera.inverse_focal_length;
    }
    return inverse;
}

// By how much 1 / z is larger for light of this colour. The lens bends it more strongly, so c / f is larger.
float color_error(const Camera camera, const vec2 q, const uint channel) {
    float along_axis = 1.0;
    if (HAS_MOVEMENTS == 1u) {
        vec3 backwards = cross(camera.u, camera.v);
        vec3 aside = camera.tilt.x * camera.u + camera.tilt.y * camera.v;
        vec3 axis = aside - sqrt(1.0 - dot(camera.tilt, camera.tilt)) * backwards;
        along_axis = dot(q.x * camera.u + q.y * camera.v - camera.w, axis);
    }
    return camera.dispersion * DISPERSION[channel] * along_axis * camera.inverse_focal_length;
}

// The primary ray of the film point q and the lens point l (unit disk), for light of a colour.
//
// The centre ray runs from the lens centre through q and meets the focal plane at
// p = (F q.x, F q.y, -F). The primary ray runs from l to p, along (p - l) / F. If the lens radius
// is zero, the ray does not depend on F.
Ray primary_ray(const Camera camera, const vec2 q, const vec2 disk, const uint channel) {
    vec2 l = camera.lens_radius * disk;
    float inverse = inverse_depth_in_focus(camera, q);
    if (HAS_DISPERSION == 1u) {
        inverse += color_error(camera, q, channel);
    }
    if (HAS_MOVEMENTS == 1u) {
        // The shortest turn that takes the axis to that of the tilted lens also turns its points.
        float back = dot(camera.tilt, l);
        l -= camera.tilt * (back / (1.0 + sqrt(1.0 - dot(camera.tilt, camera.tilt))));
        vec3 lens_point = l.x * camera.u + l.y * camera.v + back * cross(camera.u, camera.v);
        vec3 centre_ray = q.x * camera.u + q.y * camera.v - camera.w;
        return Ray(camera.eye + lens_point, normalize(centre_ray - lens_point * inverse));
    }
    vec2 slope = q - l * inverse;
    vec3 origin = camera.eye + l.x * camera.u + l.y * camera.v;
    vec3 direction = slope.x * camera.u + slope.y * camera.v - camera.w;
    return Ray(origin, normalize(direction));
}

#endif
