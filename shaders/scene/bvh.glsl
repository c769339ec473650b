// The nearest shape along a ray, by a tree of boxes with four children a node, compressed after H. Ylitie
// et al., "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017.
//
// Nodes and shapes are records of one size in one buffer, and the children of a node follow one another. So
// a step of the search fetches one record, whichever it is: where branches are only masked, fetches would
// be made for both.

#ifndef BVH_GLSL
#define BVH_GLSL

// The distances to a shape and to its bounding box are rounded differently. This slack keeps a ray that hits the shape
// from missing the box.
const float BOX_SLACK = 1.0 + 1e-6;

// The number of nodes on the longest path from the root to a leaf. The search can leave children behind at each.
layout(constant_id = ID_TREE_DEPTH) const uint TREE_DEPTH = 0u; // 0: no tree
// A ray that needs more steps than this is given up: Mesa's software device would end its loop silently later on.
layout(constant_id = ID_MAX_TREE_STEPS) const uint MAX_TREE_STEPS = 1024u;
uint max_tree_steps() { if (SCENE_IS_KEPT == 1u) { return MAX_TREE_STEPS; } return counts.max_tree_steps; }

// A node: the bounding boxes of its children. Their planes lie on a grid that each node has for itself.
struct TreeNode {
    vec3 origin;
    uint exponents_and_child_count; // bytes: the exponents of the grid's steps along x, y and z; the number of children
    uvec2 planes_x; // a byte for each child: the lower planes, then the upper planes
    uvec2 planes_y;
    uvec2 planes_z;
    uint first; // the first child's record
};

bool has_tree() {
    uint depth = TREE_DEPTH; // the reflection library cannot compare constants
    return depth > 0u;
}

bool is_node(const uvec4 record[3]) {
    return child_count(record[0].w) > 0u;
}

TreeNode to_node(const uvec4 record[3]) {
    return TreeNode(uintBitsToFloat(record[0].xyz), record[0].w, record[1].xy, record[1].zw, record[2].xy, record[2].w);
}

float tree_shape_distance(const Ray ray, const vec3 inverse_direction, const ShapeRecord record) {
    float distance = MISS;
    vec3 displacement = vec3(0.0);
    if (SCENE_MOVES == 1u) {
        displacement = ray_time * fetch_velocity(record.index);
    }
#define TREE_DISTANCE(KIND, kind_) \
    if (HAS_KIND(SHAPE_KINDS, SHAPE_##KIND)) { \
        ShapeRecord shape = record; \
        if (SCENE_MOVES == 1u) { \
            move_##kind_(shape, displacement); \
        } \
        float at = kind_##_distance(ray, inverse_direction, shape); \
        distance = IS_OF_KIND(SHAPE_KINDS & BOUNDED_KINDS, shape.kind, SHAPE_##KIND) ? at : distance; \
    }
    FOR_EACH_BOUNDED_KIND(TREE_DISTANCE)
    return distance;
}

const uint FAR_KEY = 0xffffffffu;

// A key to sort children by: the bits of the distance, which is not negative, with the child's number in the lowest
// two. exists is false for a child that the node does not have. With the slack, a ray could meet even an empty box.
uint child_key(const vec3 enter, const vec3 leave, const float limit, const uint child, const bool exists) {
    float near = larger(larger(enter.x, enter.y), larger(enter.z, 0.0));
    float far = smaller(smaller(leave.x, leave.y), smaller(leave.z, limit));
    return exists && near <= far * BOX_SLACK ? floatBitsToUint(near) & ~3u | child : FAR_KEY;
}

#define SORT(a, b) { uint smaller_key = min(a, b); b = max(a, b); a = smaller_key; }

// The numbers of the children whose boxes the ray meets before limit, two bits each, and a one above them all. If the
// children are sorted, the nearest one is in the lowest bits.
const uint NO_CHILDREN = 1u;

uint meet_children(
    const Ray ray, const vec3 inverse_direction, const float limit, const bool sorted, const TreeNode node
) {
    uvec3 exponents = uvec3(node.exponents_and_child_count) << uvec3(23u, 15u, 7u) & 0x7f800000u;
    vec3 step = uintBitsToFloat(exponents) * inverse_direction;
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
        keys[child] = child_key(enter, leave, limit, child, child < child_count(node.exponents_and_child_count));
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

// The children that the search has left behind, an entry for each node, the latest node first. An entry is the record
// of the node's first child, and in the lowest bits the children still to visit, as meet_children() returns them. A
// stack that shifts needs no index that differs from invocation to invocation. The shifts are spelled out, because
// Mesa's software device unrolls no loop inside another one.
uint stack[TREE_DEPTH + 1u];
const uint STACK_CHILD_BITS = 32u - STACK_INDEX_BITS;
const uint STACK_CHILDREN = (1u << STACK_CHILD_BITS) - 1u;

#define SHIFT(i) \
    if (depth >= i) { \
        uint here = stack[i - 1u]; \
        uint below = stack[i]; \
        uint popped = pops ? below : here; \
        stack[i - 1u] = pushes ? above : popped; \
        above = here; \
    }

// Pushes one entry, pops one, or does neither. Returns the entry that was on top.
uint shift_stack(const bool pushes, const bool pops, uint above) {
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
float search_tree(
    const Ray ray, const vec3 inverse_direction, const float limit, const bool any_will_do, out uint nearest,
    inout bool given_up
) {
    uint first = 0u; // the root
    uint children = NO_CHILDREN << 2u;
    float distance = MISS;
    nearest = 0u;
    uint steps = 0u;
    uint max_steps = max_tree_steps();
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
            float at = tree_shape_distance(ray, inverse_direction, to_shape(record));
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
    } while (searching && steps < max_steps);
    given_up = given_up || searching;
    return distance < limit ? distance : MISS;
}

#endif
