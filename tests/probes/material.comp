#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

// What a material scatters, at a point of a surface whose normals are the z axis. Glass is seen from outside.

layout(local_size_x = 64) in;

#include "interface.glsl"
#include "material/material.glsl"

struct In {
    vec3 to_viewer;
    uint material;
    vec3 to_light;
    vec3 xi;
};

struct Out {
    vec3 sampled; // a random direction, which xi chooses
    float density;
    vec3 weight;
    float scattered_density; // of the sampled direction, by the other function
    vec3 scattered; // from the sampled direction
    float density_of_light;
    vec3 of_light; // scattered from the light
};

layout(set = 0, binding = BINDING_PROBE_INPUTS, std430) readonly buffer Inputs { In inputs[]; };
layout(set = 0, binding = BINDING_PROBE_OUTPUTS, std430) writeonly buffer Outputs { Out outputs[]; };

void main() {
    keep_scene();
    uint i = gl_GlobalInvocationID.x;
    if (i < inputs.length()) {
        In given = inputs[i];
        vec3 up = vec3(0.0, 0.0, 1.0);
        Material material = get_material(given.material);
        SurfacePoint at = SurfacePoint(vec3(0.0), up, up, 0.0, vec3(0.0), vec3(0.0), false, material.index);
        vec3 color = texture_value(material.color, at);
        Scatter chosen = material_sample(material, color, at, given.to_viewer, given.xi);
        Scattered again = material_scattered(material, color, at, chosen.direction, given.to_viewer);
        Scattered light = material_scattered(material, color, at, given.to_light, given.to_viewer);
        outputs[i] = Out(
            chosen.direction, chosen.density, chosen.weight, again.density, again.share, light.density, light.share
        );
    }
}
