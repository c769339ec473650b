// Materials, lights, and the radiance along a ray: Suffern, chapters 14 to 16 and 24.

#ifndef SHADING_GLSL
#define SHADING_GLSL

#include "scene/intersect.glsl"

const float INVERSE_PI = 0.318309886;

// Suffern's 3D checker: the first colour where the cells' coordinates sum to an even number. A face that lies on
// the boundary of two layers of cells belongs to the lower one: the position is taken so much lower as it may
// be off, and as the phase, of up to two cells, is rounded.
vec3 surface_color(Material material, vec3 position, float error) {
    if (material.inverse_checker_size == 0.0) {
        return material.color;
    }
    position -= error + 2.0 * ROUNDING / material.inverse_checker_size;
    if (SCENE_IS_SHIFTED == 1u) {
        position += material.checker_phase;
    }
    ivec3 cell = ivec3(floor(position * material.inverse_checker_size));
    bool odd = ((cell.x + cell.y + cell.z) & 1) != 0;
    return odd ? material.odd_color : material.color;
}

vec3 background(vec3 direction) {
    float height = clamp(direction.y, 0.0, 1.0);
    // Not mix(): of two equal colours this makes exactly that colour.
    Environment sky = get_environment();
    return sky.horizon + (sky.zenith - sky.horizon) * (height * (2.0 - height));
}

// A point of a surface. Both normals are of unit length, and on the side that the ray comes from.
struct SurfacePoint {
    vec3 position;
    vec3 normal;
    vec3 shading_normal;
    float error; // how far off the surface the position may be
    vec3 lifted; // the position, moved off the surface by this much
    vec3 on_shape; // the position where the shape was in the middle of the exposure
};

// What a light adds at a point towards -ray.direction.
vec3 reflected_light(Material material, vec3 color, Light light, bool casts_shadows, Ray ray, SurfacePoint at, inout uint rays, inout bool given_up) {
    vec3 to_light = light.position_or_direction;
    float limit = MISS;
    if (light.is_directional == 0u) {
        to_light -= at.position;
        limit = length(to_light);
        to_light /= limit;
    }
    float cosine = dot(at.shading_normal, to_light);
    if (cosine <= 0.0 || dot(at.normal, to_light) <= 0.0) {
        return vec3(0.0);
    }
    if (casts_shadows) {
        ++rays;
        if (occluded(Ray(at.lifted, to_light), limit, given_up)) {
            return vec3(0.0);
        }
    }
    vec3 reflected = 2.0 * cosine * at.shading_normal - to_light;
    float highlight = larger(dot(reflected, -ray.direction), 0.0);
    // pow(0, 0) is undefined.
    float gloss = highlight > 0.0 ? material.ks * pow(highlight, material.exponent) : 0.0;
    return (material.kd * INVERSE_PI * color + gloss) * light.radiance * cosine;
}

// Emission, ambient, and direct light with hard shadows, towards -ray.direction.
vec3 shade(Material material, Ray ray, SurfacePoint at, inout uint rays, inout bool given_up) {
    vec3 color = surface_color(material, at.on_shape, at.error);
    vec3 sum = material.emission + material.ka * color * get_environment().ambient;
    if (material.kd == 0.0 && material.ks == 0.0) {
        return sum;
    }
    // Loops end at their foot. At their head, Mesa's software device would go through them once more than
    // needed: it looks whether any invocation goes on at the foot alone.
    uint lights = SHADOW_LIGHT_COUNT;
    if (lights > 0u) {
        uint i = 0u;
        do {
            sum += reflected_light(material, color, get_light(i), true, ray, at, rays, given_up);
        } while (++i < lights);
    }
    for (uint i = SHADOW_LIGHT_COUNT; i < LIGHT_COUNT; ++i) {
        sum += reflected_light(material, color, get_light(i), false, ray, at, rays, given_up);
    }
    return sum;
}

// The radiance that arrives along the ray: what the surface shows, plus its mirror image, followed
// for at most max_bounces reflections. rays counts every ray traced, shadow rays among them. given_up: a search
// took too long, and the radiance is of no use.
vec3 radiance(Ray ray, uint max_bounces, inout uint rays, out bool given_up) {
    vec3 sum = vec3(0.0);
    vec3 throughput = vec3(1.0);
    given_up = false;
    uint bounce = 0u;
    do {
        ++rays;
        Hit hit = intersect_scene(ray, given_up);
        if (hit.distance >= MISS) {
            sum += throughput * background(ray.direction);
            break;
        }
        SurfacePoint at;
        at.position = ray.origin + hit.distance * ray.direction;
        at.normal = settle(hit.surface, at.position, at.error);
        at.on_shape = at.position;
        if (SCENE_MOVES == 1u) {
            at.on_shape -= hit.displacement;
        }
        at.shading_normal = hit.surface.shading_normal == vec3(0.0) ? at.normal : hit.surface.shading_normal;
        bool from_behind = dot(at.normal, ray.direction) > 0.0;
        at.normal = from_behind ? -at.normal : at.normal;
        at.shading_normal = from_behind ? -at.shading_normal : at.shading_normal;
        at.lifted = at.position + at.error * at.normal;

        Material material = get_material(hit.material);
        sum += throughput * shade(material, ray, at, rays, given_up);
        throughput *= material.reflectance;
        if (throughput == vec3(0.0)) {
            break;
        }
        vec3 mirrored = reflect(ray.direction, at.shading_normal);
        // What would enter the surface is mirrored out of it again.
        mirrored -= 2.0 * smaller(dot(mirrored, at.normal), 0.0) * at.normal;
        ray = Ray(at.lifted, mirrored);
    } while (++bounce <= max_bounces);
    return sum;
}

#endif
