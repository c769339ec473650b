// The nearest shape along a ray, by a tree of boxes with eight children a node: H. Ylitie et al.,
// "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017.
//
// The children of a node are visited in the order of the ray's octant. Those still to be visited are a
// group: the index of the first child, and bits: the visit's order in the upper eight, and which of the
// children are inner nodes in the lower eight. The shapes of leaves are a group too, with a bit each.

#ifndef BVH_GLSL
#define BVH_GLSL

// The inverses of a shape's distance and of a box's are rounded each in its own way.
const float BOX_SLACK = 1.0 + 1e-6;

// Nodes on the longest way from the root to a leaf; at each, one group can be left behind.
layout(constant_id = 10) const uint TREE_DEPTH = 0u; // 0: no tree
layout(constant_id = 11) const uint TREE_KINDS = 0u; // the kinds of shapes in it, a bit each
// A ray that needs more steps is given up: Mesa's software device would end it silently later on.
layout(constant_id = 12) const uint MOST_TREE_STEPS = 1024u;

const uint KIND_SPHERE = 0u;
const uint KIND_BOX = 1u;
const uint KIND_TRIANGLE = 2u;
const uint KIND_SMOOTH = 3u; // a bit of TREE_KINDS only: some triangles have normals

layout(set = 0, binding = 10) uniform usamplerBuffer tree_nodes; // five texels each
// Three texels each: position and material, then edges or radius or corner, and the kind.
layout(set = 0, binding = 11) uniform usamplerBuffer tree_shapes;
layout(set = 0, binding = 12) uniform usamplerBuffer tree_normals; // three texels each

struct TreeShape {
    vec3 position; // centre, lower corner, or first vertex
    uint material;
    vec3 a; // radius in x, upper corner, or first edge
    uint kind;
    vec3 b; // second edge
};

bool has_tree() {
    uint depth = TREE_DEPTH; // the reflection library cannot compare constants
    return depth > 0u;
}

bool in_tree(uint kind) {
    return (TREE_KINDS >> kind & 1u) != 0u;
}

TreeShape tree_shape(uint index) {
    uvec4 first = texelFetch(tree_shapes, int(3u * index));
    uvec4 second = texelFetch(tree_shapes, int(3u * index + 1u));
    uvec4 third = texelFetch(tree_shapes, int(3u * index + 2u));
    return TreeShape(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz), second.w, uintBitsToFloat(third.xyz));
}

float intersect_tree_shape(Ray ray, vec3 inverse_direction, TreeShape shape) {
    float distance = MISS;
    if (in_tree(KIND_TRIANGLE)) {
        vec2 barycentric;
        distance = intersect_triangle(ray, Triangle(shape.position, shape.a, shape.b), barycentric);
    }
    if (in_tree(KIND_SPHERE)) {
        float at_sphere = intersect_sphere(ray, Sphere(shape.position, shape.a.x));
        distance = shape.kind == KIND_SPHERE ? at_sphere : distance;
    }
    if (in_tree(KIND_BOX)) {
        vec3 normal;
        float at_box = intersect_box(ray, inverse_direction, Box(shape.position, shape.a), normal);
        distance = shape.kind == KIND_BOX ? at_box : distance;
    }
    return distance;
}

// The bits of a node's children that the ray meets before limit: an inner child at its place in the
// order of visit, a leaf's shapes at theirs.
uint meet_children(Ray ray, vec3 inverse_direction, uint octant, float limit, uint node, out uvec4 header, out uvec2 bases) {
    int at = int(5u * node);
    header = texelFetch(tree_nodes, at);
    uvec4 about = texelFetch(tree_nodes, at + 1);
    uvec4 x = texelFetch(tree_nodes, at + 2); // lower planes of eight children, then upper
    uvec4 y = texelFetch(tree_nodes, at + 3);
    uvec4 z = texelFetch(tree_nodes, at + 4);
    bases = about.xy;

    // The planes stand on a grid of the node's own.
    vec3 step = uintBitsToFloat(uvec3(header.w << 23u, header.w << 15u, header.w << 7u) & 0x7f800000u) * inverse_direction;
    vec3 origin = (uintBitsToFloat(header.xyz) - ray.origin) * inverse_direction;
    bvec3 backwards = lessThan(inverse_direction, vec3(0.0));
    uvec2 near_x = backwards.x ? x.zw : x.xy;
    uvec2 far_x = backwards.x ? x.xy : x.zw;
    uvec2 near_y = backwards.y ? y.zw : y.xy;
    uvec2 far_y = backwards.y ? y.xy : y.zw;
    uvec2 near_z = backwards.z ? z.zw : z.xy;
    uvec2 far_z = backwards.z ? z.xy : z.zw;

    uint met = 0u;
    [[unroll]] for (uint half_of_children = 0u; half_of_children < 2u; ++half_of_children) {
        // Bytes: of an inner child 001 and 24 + slot; of a leaf a bit for each shape, and the first's place.
        uint children = about[2u + half_of_children];
        uint inner = children & children << 1u & 0x10101010u;
        uint places = (children ^ octant * 0x01010101u & (inner >> 4u) * 0xffu) & 0x1f1f1f1fu;
        uint bits = children >> 5u & 0x07070707u;
        [[unroll]] for (uint child = 0u; child < 4u; ++child) {
            uint by = 8u * child;
            vec3 near_planes = vec3(near_x[half_of_children] >> by & 0xffu, near_y[half_of_children] >> by & 0xffu, near_z[half_of_children] >> by & 0xffu);
            vec3 far_planes = vec3(far_x[half_of_children] >> by & 0xffu, far_y[half_of_children] >> by & 0xffu, far_z[half_of_children] >> by & 0xffu);
            vec3 enter = near_planes * step + origin;
            vec3 leave = far_planes * step + origin;
            float near = larger(larger(enter.x, enter.y), larger(enter.z, 0.0));
            float far = smaller(smaller(leave.x, leave.y), smaller(leave.z, limit));
            met |= near <= far * BOX_SLACK ? (bits >> by & 0xffu) << (places >> by & 0xffu) : 0u;
        }
    }
    return met;
}

// Groups left behind, the last first. A stack that shifts needs no index that differs from invocation to
// invocation, and is spelled out, for Mesa's software device unrolls no loop inside another one.
uvec2 stack[TREE_DEPTH + 1u];
const uint SPELLED_OUT = 12u;

#define SHIFT_DOWN(i) if (depth >= i) { stack[i] = stack[i - 1u]; }
#define SHIFT_UP(i) if (depth >= i) { stack[i - 1u] = stack[i]; }

void push_group(uvec2 group) {
    uint depth = TREE_DEPTH;
    for (uint i = depth; i > SPELLED_OUT; --i) {
        stack[i] = stack[i - 1u];
    }
    SHIFT_DOWN(12u) SHIFT_DOWN(11u) SHIFT_DOWN(10u) SHIFT_DOWN(9u) SHIFT_DOWN(8u) SHIFT_DOWN(7u)
    SHIFT_DOWN(6u) SHIFT_DOWN(5u) SHIFT_DOWN(4u) SHIFT_DOWN(3u) SHIFT_DOWN(2u) SHIFT_DOWN(1u)
    stack[0] = group;
}

uvec2 pop_group() {
    uint depth = TREE_DEPTH;
    uvec2 group = stack[0];
    SHIFT_UP(1u) SHIFT_UP(2u) SHIFT_UP(3u) SHIFT_UP(4u) SHIFT_UP(5u) SHIFT_UP(6u)
    SHIFT_UP(7u) SHIFT_UP(8u) SHIFT_UP(9u) SHIFT_UP(10u) SHIFT_UP(11u) SHIFT_UP(12u)
    for (uint i = SPELLED_OUT + 1u; i <= depth; ++i) {
        stack[i - 1u] = stack[i];
    }
    return group;
}

// The distance to the nearest shape nearer than limit, and its index; MISS if there is none. With any_will_do the
// first one found ends the search. given_up: the search took too long.
float search_tree(Ray ray, vec3 inverse_direction, float limit, bool any_will_do, out uint nearest, inout bool given_up) {
    uint octant = (ray.direction.x < 0.0 ? 0u : 4u) | (ray.direction.y < 0.0 ? 0u : 2u) | (ray.direction.z < 0.0 ? 0u : 1u);
    uvec2 nodes = uvec2(0u, 0x80000000u); // the root
    uvec2 shapes = uvec2(0u);
    float distance = MISS;
    uint steps = 0u;
    stack[TREE_DEPTH] = uvec2(0u);
    [[unroll]] for (uint i = 0u; i < TREE_DEPTH; ++i) {
        stack[i] = uvec2(0u);
    }
    while (true) {
        if (shapes.y == 0u) {
            uint place = uint(findMSB(nodes.y));
            uint slot = (place - 24u) ^ octant;
            uint node = nodes.x + uint(bitCount(nodes.y & ~(0xffffffffu << slot)));
            nodes.y &= ~(1u << place);
            uvec4 header;
            uvec2 bases;
            uint met = meet_children(ray, inverse_direction, octant, distance < limit ? distance : limit, node, header, bases);
            if (nodes.y > 0xffffffu && met > 0xffffffu) {
                push_group(nodes);
            }
            nodes = met > 0xffffffu ? uvec2(bases.x, met & 0xff000000u | header.w >> 24u) : nodes;
            shapes = uvec2(bases.y, met & 0xffffffu);
        }
        if (shapes.y != 0u) {
            uint place = uint(findMSB(shapes.y));
            shapes.y &= ~(1u << place);
            uint index = shapes.x + place;
            float at = intersect_tree_shape(ray, inverse_direction, tree_shape(index));
            bool closer = at < distance;
            nearest = closer ? index : nearest;
            distance = closer ? at : distance;
        }
        if (shapes.y == 0u && nodes.y <= 0xffffffu) {
            nodes = pop_group();
        }
        if (any_will_do && distance < limit || shapes.y == 0u && nodes.y <= 0xffffffu) {
            break;
        }
        if (++steps >= MOST_TREE_STEPS) {
            given_up = true;
            break;
        }
    }
    return distance < limit ? distance : MISS;
}

// The unit normal of a triangle with normals at its corners: straight between them, on the side of the
// triangle's own, or that one where they cancel out.
vec3 interpolated_normal(uint index, vec2 barycentric, vec3 own) {
    vec3 sum = vec3(0.0);
    vec3 weights = vec3(1.0 - barycentric.x - barycentric.y, barycentric);
    [[unroll]] for (uint corner = 0u; corner < 3u; ++corner) {
        sum += weights[corner] * uintBitsToFloat(texelFetch(tree_normals, int(3u * index + corner)).xyz);
    }
    sum = sum == vec3(0.0) ? own : sum;
    return normalize(dot(sum, own) < 0.0 ? -sum : sum);
}

// The nearest hit with what is in the tree.
Hit intersect_tree(Ray ray, vec3 inverse_direction, inout bool given_up) {
    uint index = 0u;
    float distance = search_tree(ray, inverse_direction, MISS, false, index, given_up);
    TreeShape shape = tree_shape(index);
    Hit hit = Hit(distance, shape.material, -shape.position, 1.0, vec3(0.0));
    if (in_tree(KIND_BOX) && shape.kind == KIND_BOX) {
        intersect_box(ray, inverse_direction, Box(shape.position, shape.a), hit.normal);
        hit.curvature = 0.0;
    }
    if (in_tree(KIND_TRIANGLE) && shape.kind == KIND_TRIANGLE) {
        hit.normal = cross(shape.a, shape.b);
        hit.curvature = 0.0;
        if (in_tree(KIND_SMOOTH)) {
            vec2 barycentric;
            intersect_triangle(ray, Triangle(shape.position, shape.a, shape.b), barycentric);
            hit.shading_normal = interpolated_normal(index, barycentric, hit.normal);
        }
    }
    return hit;
}

#endif
