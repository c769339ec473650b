// One pixel's batch of samples: the body of the trace pass. The shader includes its integrator first.

#ifndef TRACE_BATCH_GLSL
#define TRACE_BATCH_GLSL

#include "camera/thin_lens.glsl"
#include "core/adaptive.glsl"
#include "aperture/aperture.glsl"

struct TracePush {
    Camera camera;
    Lattice lattice;
    uint seed;
    uint limits; // see core/limits.glsl
    uint first_sample;
    uint sample_count; // at least one
};

// These must be copied at the start of main(), for the same reason as the scene: see keep_scene.
layout(push_constant, std430) uniform TraceConstants { TracePush push_constants; };

layout(set = 0, binding = BINDING_COUNTERS, std430) buffer Counters {
    uint rays;
    uint rejected_samples;
    uint listed_samples; // samples traced for the list of active pixels, whose length the host does not know
} counters;

// The mean of the samples first_sample .. first_sample + sample_count of the pixel, and in w how many of them were
// finite. moment is the second moment of their luminance, if the film has moments.
vec4 trace_batch(const TracePush push, const uvec2 pixel, out float moment) {
    vec4 batch = vec4(0.0);
    moment = 0.0;
    uint rays = 0u;
    uint rejected = 0u;
    uvec4 keys = sample_keys(push.seed, pixel, BLOCK_FILM_AND_LENS);
    uvec4 time_keys = uvec4(0u);
    if (SCENE_MOVES == 1u) {
        time_keys = sample_keys(push.seed, pixel, BLOCK_TIME);
    }
    uint i = 0u;
    do {
        vec4 xi = sample_values(keys, push.first_sample + i);
        vec2 offset = film_offset(xi.xy, push.camera.jitter);
        vec2 q = view_plane_point(push.camera, push.lattice.extent, pixel, offset);
        vec3 lens_point = aperture_point(q, xi.zw);
        if (SCENE_MOVES == 1u) {
            ray_time = (time_value(time_keys, push.first_sample + i) - 0.5) * aperture.shutter;
        }
        PathSampler path = PathSampler(push.seed, pixel, push.first_sample + i);
        vec3 color = vec3(0.0);
        bool given_up = false;
        uint channel = RED;
        // If the lens has colour errors, a sample has a ray for each colour, through the same points of film and lens.
        do {
            Ray ray = primary_ray(push.camera, q, lens_point.xy, channel);
            bool lost;
            vec3 seen = radiance(ray, path, push.limits, rays, lost);
            if (HAS_DISPERSION == 1u) {
                given_up = given_up || lost;
                color[channel] = seen[channel];
            } else {
                given_up = lost;
                color = seen;
            }
        } while (HAS_DISPERSION == 1u && ++channel <= BLUE);
        color *= lens_point.z;
        if (!given_up && is_finite(color)) {
            vec4 one = vec4(color, 1.0);
            if (HAS_MOMENTS == 1u) {
                moment = merge_moments(batch, moment, one, 0.0);
            }
            batch = merge(batch, one);
        } else {
            ++rejected;
        }
    } while (++i < push.sample_count);
    atomicAdd(counters.rays, rays);
    if (rejected > 0u) {
        atomicAdd(counters.rejected_samples, rejected);
    }
    if (HAS_MOMENTS == 1u && push.lattice.stride == 0u) {
        atomicAdd(counters.listed_samples, push.sample_count);
    }
    return batch;
}

#endif
