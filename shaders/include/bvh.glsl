// The nearest shape along a ray, by a tree of boxes with four children a node, compressed after H. Ylitie
// et al., "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017.
//
// Nodes and shapes are records of one size in one buffer, and the children of a node follow one another. So
// a step of the search fetches one record, whichever it is: where branches are only masked, fetches would
// be made for both.
//
// Where branches are only masked, a node also goes through the arithmetic of a shape. Its packed bytes would be
// denormal floats there, and Intel's processors take about a hundred times as long for an operation on one. So
// what is no float lies where a shape has no float either, or is cleared before it is taken for one.

#ifndef BVH_GLSL
#define BVH_GLSL

// The inverses of a shape's distance and of a box's are rounded each in its own way.
const float BOX_SLACK = 1.0 + 1e-6;

// Nodes on the longest way from the root to a leaf; at each, some children can be left behind.
layout(constant_id = ID_TREE_DEPTH) const uint TREE_DEPTH = 0u; // 0: no tree
layout(constant_id = ID_TREE_KINDS) const uint TREE_KINDS = 0u; // the kinds of shapes in it, a bit each
// A ray that needs more steps is given up: Mesa's software device would end it silently later on.
layout(constant_id = ID_MOST_TREE_STEPS) const uint MOST_TREE_STEPS = 1024u;

layout(set = 0, binding = BINDING_TREE_RECORDS) uniform usamplerBuffer tree_records; // three texels each: TreeNode or TreeShape
layout(set = 0, binding = BINDING_TREE_NORMALS) uniform usamplerBuffer tree_normals; // three texels each
layout(set = 0, binding = BINDING_TREE_VELOCITIES) uniform usamplerBuffer tree_velocities; // of its shapes, a second

// Boxes around the children, whose planes stand on a grid of the node's own.
struct TreeNode {
    vec3 origin;
    uint about; // bytes: the exponents of the grid's steps, and the number of children
    uvec2 planes_x; // a byte for each child: the lower ones, then the upper
    uvec2 planes_y;
    uvec2 planes_z;
    uint first; // the first child's record
};

struct TreeShape {
    vec3 position; // centre, lower corner, or first vertex
    uint material;
    vec3 a; // radius in x, upper corner, or first edge
    uint kind;
    vec3 b; // second edge
    uint index; // of its normals
};

bool has_tree() {
    uint depth = TREE_DEPTH; // the reflection library cannot compare constants
    return depth > 0u;
}

bool in_tree(uint kind) {
    return (TREE_KINDS >> kind & 1u) != 0u;
}

void fetch_record(uint index, out uvec4 record[3]) {
    int at = int(3u * index);
    record[0] = texelFetch(tree_records, at);
    record[1] = texelFetch(tree_records, at + 1);
    record[2] = texelFetch(tree_records, at + 2);
}

// The number of a node's children. A shape has the index of its material there, which is smaller.
uint child_count(uint about) {
    return about >> 24u;
}

bool is_node(uvec4 record[3]) {
    return child_count(record[0].w) > 0u;
}

TreeNode to_node(uvec4 record[3]) {
    return TreeNode(uintBitsToFloat(record[0].xyz), record[0].w, record[1].xy, record[1].zw, record[2].xy, record[2].w);
}

// Of a node, a shape of size zero.
TreeShape to_shape(uvec4 record[3]) {
    // All ones for a shape, zero for a node. Written without a comparison, for a compiler that finds the branch's
    // own condition here takes it for true and leaves the mask out.
    uint if_shape = uint(int(child_count(record[0].w)) - 1 >> 31);
    return TreeShape(
        uintBitsToFloat(record[0].xyz), record[0].w, uintBitsToFloat(record[1].xyz & if_shape), record[1].w,
        uintBitsToFloat(record[2].xyz & if_shape), record[2].w
    );
}

// The shape where it is by now.
TreeShape shape_now(uvec4 record[3], out vec3 way) {
    TreeShape shape = to_shape(record);
    way = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        way = ray_time * uintBitsToFloat(texelFetch(tree_velocities, int(shape.index)).xyz);
        shape.position += way;
        shape.a += shape.kind == SHAPE_BOX ? way : vec3(0.0);
    }
    return shape;
}

Triangle to_triangle(TreeShape shape) {
    vec3 longest = max(abs(shape.a), abs(shape.b));
    float size = larger(longest.x, larger(longest.y, longest.z));
    float offset = dot(cross(shape.a, shape.b), shape.position);
    return Triangle(shape.position, offset, shape.a, size, shape.b);
}

float intersect_tree_shape(Ray ray, vec3 inverse_direction, TreeShape shape) {
    float distance = MISS;
    if (in_tree(SHAPE_TRIANGLE)) {
        vec2 barycentric;
        distance = intersect_triangle(ray, to_triangle(shape), barycentric);
    }
    if (in_tree(SHAPE_SPHERE)) {
        float at_sphere = intersect_sphere(ray, Sphere(shape.position, shape.a.x));
        distance = shape.kind == SHAPE_SPHERE ? at_sphere : distance;
    }
    if (in_tree(SHAPE_BOX)) {
        vec3 normal;
        float offset;
        float at_box = intersect_box(ray, inverse_direction, Box(shape.position, shape.a), normal, offset);
        distance = shape.kind == SHAPE_BOX ? at_box : distance;
    }
    return distance;
}

const uint FAR_KEY = 0xffffffffu;

// A child's distance, which is not negative, and its number, in one unsigned number to sort by.
// No slack is small enough for the box of a child that is not there: exists says so.
uint child_key(vec3 enter, vec3 leave, float limit, uint child, bool exists) {
    float near = larger(larger(enter.x, enter.y), larger(enter.z, 0.0));
    float far = smaller(smaller(leave.x, leave.y), smaller(leave.z, limit));
    return exists && near <= far * BOX_SLACK ? floatBitsToUint(near) & ~3u | child : FAR_KEY;
}

#define SORT(a, b) { uint smaller_key = min(a, b); b = max(a, b); a = smaller_key; }

// The children of a node whose boxes the ray meets before limit, two bits each, and above them all a one. Sorted,
// the nearest is in the lowest bits.
const uint NO_CHILDREN = 1u;

uint meet_children(Ray ray, vec3 inverse_direction, float limit, bool sorted, TreeNode node) {
    vec3 step = uintBitsToFloat(uvec3(node.about << 23u, node.about << 15u, node.about << 7u) & 0x7f800000u) * inverse_direction;
    vec3 origin = (node.origin - ray.origin) * inverse_direction;
    bvec3 backwards = lessThan(inverse_direction, vec3(0.0));
    uvec2 x = backwards.x ? node.planes_x.yx : node.planes_x;
    uvec2 y = backwards.y ? node.planes_y.yx : node.planes_y;
    uvec2 z = backwards.z ? node.planes_z.yx : node.planes_z;
    uint keys[4];
    [[unroll]] for (uint child = 0u; child < 4u; ++child) {
        uint by = 8u * child;
        vec3 enter = vec3(x.x >> by & 0xffu, y.x >> by & 0xffu, z.x >> by & 0xffu) * step + origin;
        vec3 leave = vec3(x.y >> by & 0xffu, y.y >> by & 0xffu, z.y >> by & 0xffu) * step + origin;
        keys[child] = child_key(enter, leave, limit, child, child < child_count(node.about));
    }
    if (sorted) {
        SORT(keys[0], keys[1])
        SORT(keys[2], keys[3])
        SORT(keys[0], keys[2])
        SORT(keys[1], keys[3])
        SORT(keys[1], keys[2])
    }
    uint met = NO_CHILDREN;
    met = keys[3] != FAR_KEY ? met << 2u | keys[3] & 3u : met;
    met = keys[2] != FAR_KEY ? met << 2u | keys[2] & 3u : met;
    met = keys[1] != FAR_KEY ? met << 2u | keys[1] & 3u : met;
    return keys[0] != FAR_KEY ? met << 2u | keys[0] & 3u : met;
}

// What was left behind of nodes' children, the last first: the first child's record, and in the lowest bits those
// still to be visited, as meet_children() gives them. A stack that shifts needs no index that differs from
// invocation to invocation, and is spelled out, for Mesa's software device unrolls no loop inside another one.
uint stack[TREE_DEPTH + 1u];
const uint STACK_CHILD_BITS = 32u - STACK_INDEX_BITS;
const uint STACK_CHILDREN = (1u << STACK_CHILD_BITS) - 1u;

#define SHIFT(i) \
    if (depth >= i) { \
        uint here = stack[i - 1u]; \
        stack[i - 1u] = pushes ? above : pops ? stack[i] : here; \
        above = here; \
    }

// Pushes or pops one entry, or neither; gives what was on top.
uint shift_stack(bool pushes, bool pops, uint above) {
    uint depth = TREE_DEPTH;
    uint top = stack[0];
    SHIFT(1u) SHIFT(2u) SHIFT(3u) SHIFT(4u) SHIFT(5u) SHIFT(6u) SHIFT(7u) SHIFT(8u) SHIFT(9u) SHIFT(10u)
    SHIFT(11u) SHIFT(12u) SHIFT(13u) SHIFT(14u) SHIFT(15u) SHIFT(16u) SHIFT(17u) SHIFT(18u) SHIFT(19u) SHIFT(20u)
    for (uint i = SPELLED_OUT_STACK + 1u; i <= depth; ++i) {
        SHIFT(i)
    }
    return top;
}

// The distance to the nearest shape nearer than limit, and its record; MISS if there is none. With
// any_will_do the first one found ends the search. given_up: the search took too long.
float search_tree(Ray ray, vec3 inverse_direction, float limit, bool any_will_do, out uint nearest, inout bool given_up) {
    uint first = 0u; // the root
    uint children = NO_CHILDREN << 2u;
    float distance = MISS;
    nearest = 0u;
    uint steps = 0u;
    stack[TREE_DEPTH] = NO_CHILDREN;
    [[unroll]] for (uint i = 0u; i < TREE_DEPTH; ++i) {
        stack[i] = NO_CHILDREN;
    }
    bool searching;
    do {
        uint index = first + (children & 3u);
        children >>= 2u;
        uint left_behind = first << STACK_CHILD_BITS | children;
        uvec4 record[3];
        fetch_record(index, record);
        bool descends = false;
        if (is_node(record)) {
            TreeNode node = to_node(record);
            float nearer_than = distance < limit ? distance : limit;
            uint met = meet_children(ray, inverse_direction, nearer_than, !any_will_do, node);
            descends = met != NO_CHILDREN;
            first = descends ? node.first : first;
            children = descends ? met : children;
        } else {
            vec3 way;
            float at = intersect_tree_shape(ray, inverse_direction, shape_now(record, way));
            bool closer = at < distance;
            nearest = closer ? index : nearest;
            distance = closer ? at : distance;
        }
        bool pushes = descends && (left_behind & STACK_CHILDREN) != NO_CHILDREN;
        bool pops = children == NO_CHILDREN;
        uint top = shift_stack(pushes, pops, left_behind);
        if (pops) {
            first = top >> STACK_CHILD_BITS;
            children = top & STACK_CHILDREN;
        }
        searching = children != NO_CHILDREN && !(any_will_do && distance < limit);
        ++steps;
    } while (searching && steps < MOST_TREE_STEPS);
    given_up = given_up || searching;
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
    uvec4 record[3];
    fetch_record(index, record);
    vec3 way;
    TreeShape shape = shape_now(record, way);
    Hit hit = Hit(distance, shape.material, -shape.position, 1.0, shape.a.x, 0.0, vec3(0.0), way);
    if (in_tree(SHAPE_BOX) && shape.kind == SHAPE_BOX) {
        intersect_box(ray, inverse_direction, Box(shape.position, shape.a), hit.normal, hit.offset);
        hit.curvature = 0.0;
    }
    if (in_tree(SHAPE_TRIANGLE) && shape.kind == SHAPE_TRIANGLE) {
        Triangle triangle = to_triangle(shape);
        hit.normal = cross(triangle.edge1, triangle.edge2);
        hit.curvature = 0.0;
        hit.offset = triangle.offset;
        hit.size = triangle.size;
        if (in_tree(SHAPE_SMOOTH)) {
            vec2 barycentric;
            intersect_triangle(ray, triangle, barycentric);
            hit.shading_normal = interpolated_normal(shape.index, barycentric, hit.normal);
        }
    }
    return hit;
}

#endif
