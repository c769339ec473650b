//! The binary tree that the tree of boxes is made from. Neighbours along a Morton curve merge, each with the
//! one that makes the smallest box with it: D. Meister and J. Bittner, "Parallel Locally-Ordered Clustering
//! for Bounding Volume Hierarchy Construction", TVCG 2018. Then subtrees move to where they cost less:
//! D. Meister and J. Bittner, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", 2018, by the
//! crate `obvhs`. Its own clusters are not used: where boxes are equal or lie in one another, it merges two a
//! round, which takes quadratic time and makes a chain.

use glam::DVec3;
use obvhs::aabb::Aabb as Bounds;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::morton::morton_encode_u128_unorm;

/// How many neighbours on either side a box compares. In the first rounds, when there are many boxes, it compares one.
const REACH: usize = 24;
const SHORT_ROUNDS: usize = 2;

/// If fewer than one box in so many would merge in a round, all boxes are merged with a neighbour instead.
const BOXES_PER_MERGE: usize = 16;

/// The shares of the nodes that are moved, in the first and in the last rounds.
const MOVES: [f32; 2] = [0.2, 0.4];

/// If the middle of a shape lies in more nodes than this, on average, moving nodes gains nothing and takes quadratic
/// time.
const MAX_CROWDING: usize = 500;

/// The binary tree of the boxes with these indices, at least one, in the order that [`along_curve`] gives. The tree's
/// primitives are indices of boxes.
pub(super) fn tree(bounds: &[Bounds], order: &[u32]) -> Bvh2 {
    let mut tree = cluster(bounds, order);
    if crowding(&tree) <= MAX_CROWDING {
        let mut optimizer = ReinsertionOptimizer::default();
        MOVES.iter().for_each(|share| optimizer.run(&mut tree, *share, None));
    }
    tree
}

/// The halves of the boxes along the Morton curve, their halves, and so on: the tree of least depth.
pub(super) fn shallow_tree(bounds: &[Bounds], order: &[u32]) -> Bvh2 {
    merge(bounds, order, |nodes, _| adjacent(nodes.len()))
}

fn cluster(bounds: &[Bounds], order: &[u32]) -> Bvh2 {
    merge(bounds, order, |nodes, round| {
        let partners = partners(nodes, if round < SHORT_ROUNDS { 1 } else { REACH });
        let merges = |(index, partner): (usize, &usize)| *partner > index && partners[*partner] == index;
        let count = partners.iter().enumerate().filter(|pair| merges(*pair)).count();
        if count * BOXES_PER_MERGE < nodes.len() { adjacent(nodes.len()) } else { partners }
    })
}

/// Merges nodes until one is left. Two nodes merge in a round if each is the other's partner.
fn merge(bounds: &[Bounds], order: &[u32], partners: impl Fn(&[Bvh2Node], usize) -> Vec<usize>) -> Bvh2 {
    let mut tree = Bvh2::zeroed(order.len());
    tree.primitive_indices = order.to_vec();
    let leaves = order.iter().zip(0..).map(|(index, place)| Bvh2Node::new(bounds[*index as usize], 1, place));
    let mut nodes: Vec<Bvh2Node> = leaves.collect();
    // The tree is filled from its end, so that children stand behind their parents.
    let mut free = tree.nodes.len();
    let mut round = 0;
    while nodes.len() > 1 {
        let partners = partners(&nodes, round);
        let mut merged = Vec::with_capacity(nodes.len());
        for (index, partner) in partners.iter().copied().enumerate() {
            if partner == index || partners[partner] != index {
                merged.push(nodes[index]);
            } else if partner < index {
                let [one, other] = [nodes[index], nodes[partner]];
                free -= 2;
                tree.nodes[free..free + 2].copy_from_slice(&[one, other]);
                merged.push(Bvh2Node::new(one.aabb().union(other.aabb()), 0, free as u32));
            }
        }
        nodes = merged;
        round += 1;
    }
    tree.nodes[0] = nodes[0];
    tree
}

/// The places of the boxes' middles on a Morton curve, in order, and their indices.
pub(super) fn along_curve(bounds: &[Bounds]) -> Vec<(u128, u32)> {
    let whole = bounds.iter().skip(1).fold(bounds[0], |whole, aabb| whole.union(aabb));
    let (origin, extent) = (whole.min.as_dvec3(), whole.diagonal().as_dvec3());
    let place = |aabb: &Bounds| {
        let share = (aabb.center().as_dvec3() - origin) / extent;
        // Along an axis on which all middles are the same, the share would be 0 / 0.
        morton_encode_u128_unorm(DVec3::select(share.is_nan_mask(), DVec3::ZERO, share))
    };
    let mut order: Vec<(u128, u32)> = bounds.iter().map(place).zip(0..).collect();
    order.sort_unstable();
    order
}

/// For each node its partner: the node, among so many on either side, that makes the smallest box with it. Among
/// equally good ones the other node of its pair is taken, or else the last one. So equal boxes find partners too.
fn partners(nodes: &[Bvh2Node], reach: usize) -> Vec<usize> {
    let mut best: Vec<(f32, usize)> = (0..nodes.len()).map(|index| (f32::INFINITY, index)).collect();
    let consider = |of: &mut (f32, usize), area: f32, index: usize, other: usize| {
        if area < of.0 || (area == of.0 && of.1 != index ^ 1) {
            *of = (area, other);
        }
    };
    for (index, node) in nodes.iter().enumerate() {
        for (other, neighbour) in nodes.iter().enumerate().skip(index + 1).take(reach) {
            let area = node.aabb().union(neighbour.aabb()).half_area();
            consider(&mut best[index], area, index, other);
            consider(&mut best[other], area, other, index);
        }
    }
    best.into_iter().map(|(_, partner)| partner).collect()
}

/// Makes each node the partner of its neighbour. The last node may be left over.
fn adjacent(count: usize) -> Vec<usize> {
    (0..count).map(|index| if index ^ 1 < count { index ^ 1 } else { index }).collect()
}

/// In how many nodes the middle of a shape lies, averaged over a sample of the shapes.
fn crowding(tree: &Bvh2) -> usize {
    const SAMPLES: usize = 256;
    let step = tree.primitive_indices.len() / SAMPLES + 1;
    let mut around = 0;
    let (mut samples, mut left) = (0, Vec::new());
    for leaf in tree.nodes.iter().filter(|node| node.is_leaf()).step_by(step) {
        let middle = leaf.aabb().center();
        samples += 1;
        left.push(0);
        while let Some(index) = left.pop() {
            let node = &tree.nodes[index];
            if node.aabb().contains_point(middle) {
                around += 1;
                if !node.is_leaf() {
                    left.extend([node.first_index as usize, node.first_index as usize + 1]);
                }
            }
        }
    }
    around / samples
}
