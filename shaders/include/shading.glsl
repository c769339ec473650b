// Materials, lights, and the radiance along a ray: Suffern, chapters 14 to 16 and 24.

#ifndef SHADING_GLSL
#define SHADING_GLSL

#include "intersect.glsl"

const float INVERSE_PI = 0.318309886;

// A surface point moves off its surface by this share of its coordinates or of the ray's length,
// whichever is larger: some hundred times the rounding error of the hit, and far below a pixel.
const float SURFACE_OFFSET = 3e-5;

// Suffern's 3D checker: the first colour where the cells' coordinates sum to an even number. The
// small shift keeps faces that lie on cell boundaries out of the rounding error.
vec3 surface_color(Material material, vec3 position) {
    if (material.inverse_checker_size == 0.0) {
        return material.color;
    }
    ivec3 cell = ivec3(floor((position - 1.87e-4) * material.inverse_checker_size));
    bool odd = ((cell.x + cell.y + cell.z) & 1) != 0;
    return odd ? material.odd_color : material.color;
}

vec3 background(vec3 direction) {
    float height = clamp(direction.y, 0.0, 1.0);
    // Not mix(): of two equal colours this makes exactly that colour.
    Environment sky = get_environment();
    return sky.horizon + (sky.zenith - sky.horizon) * (height * (2.0 - height));
}

// Emission, ambient, and direct light with hard shadows, towards -ray.direction.
vec3 shade(Material material, Ray ray, vec3 position, vec3 normal, float offset, inout uint rays) {
    vec3 color = surface_color(material, position);
    vec3 sum = material.emission + material.ka * color * get_environment().ambient;
    if (material.kd == 0.0 && material.ks == 0.0) {
        return sum;
    }
    [[unroll]] for (uint i = 0u; i < LIGHT_COUNT; ++i) {
        Light light = get_light(i);
        vec3 to_light = light.position_or_direction;
        float limit = MISS;
        if (light.is_directional == 0u) {
            to_light -= position;
            limit = length(to_light);
            to_light /= limit;
        }
        float cosine = dot(normal, to_light);
        if (cosine > 0.0) {
            bool shadowed = false;
            if (i < SHADOW_LIGHT_COUNT) {
                ++rays;
                shadowed = occluded(Ray(position + offset * normal, to_light), limit);
            }
            if (!shadowed) {
                vec3 reflected = 2.0 * cosine * normal - to_light;
                float highlight = larger(dot(reflected, -ray.direction), 0.0);
                // pow(0, 0) is undefined.
                float gloss = highlight > 0.0 ? material.ks * pow(highlight, material.exponent) : 0.0;
                sum += (material.kd * INVERSE_PI * color + gloss) * light.radiance * cosine;
            }
        }
    }
    return sum;
}

// The radiance that arrives along the ray: what the surface shows, plus its mirror image, followed
// for at most max_bounces reflections. rays counts every ray traced, shadow rays among them.
vec3 radiance(Ray ray, uint max_bounces, inout uint rays) {
    vec3 sum = vec3(0.0);
    vec3 throughput = vec3(1.0);
    for (uint bounce = 0u; bounce <= max_bounces; ++bounce) {
        ++rays;
        Hit hit = intersect_scene(ray);
        if (hit.distance >= MISS) {
            sum += throughput * background(ray.direction);
            break;
        }
        vec3 position = ray.origin + hit.distance * ray.direction;
        vec3 normal = surface_normal(hit, position);
        normal = dot(normal, ray.direction) > 0.0 ? -normal : normal;
        vec3 magnitude = abs(position);
        float offset = SURFACE_OFFSET * larger(hit.distance, larger(magnitude.x, larger(magnitude.y, magnitude.z)));

        Material material = get_material(hit.material);
        sum += throughput * shade(material, ray, position, normal, offset, rays);
        throughput *= material.reflectance;
        if (throughput == vec3(0.0)) {
            break;
        }
        ray = Ray(position + offset * normal, reflect(ray.direction, normal));
    }
    return sum;
}

#endif
