//! A tree of boxes around the bounded shapes of a scene: a bounding volume hierarchy of four children a
//! node, compressed after H. Ylitie et al., "Efficient Incoherent Ray Traversal on GPUs Through Compressed
//! Wide BVHs", HPG 2017.

use super::clusters::{along_curve, shallow_tree, tree};
use super::{Shaded, Shape};
use glam::{DVec3, Vec3, Vec3A};
use obvhs::aabb::Aabb as Bounds;
use obvhs::bvh2::Bvh2;
use std::collections::HashSet;

/// The most children that a node has.
const WIDTH: usize = 4;

/// The last plane of a node's grid; the first is 0.
const LAST_PLANE: u8 = u8::MAX;

/// Trees of a million shapes are some 15 nodes deep. One that is deeper than this needs a stack that slows
/// every step, and loses to the shallowest tree.
const DEEPEST: u32 = 24;

/// The tree.
#[derive(Debug)]
pub struct Bvh {
    /// Nodes and leaves. The first is the root; the children of a node follow one another, behind it.
    pub records: Vec<Record>,
    /// The scene's bounded shapes, where they are in the middle of the exposure. A copy of another shape has no leaf.
    pub shapes: Vec<Shaded>,
    /// The number of nodes on the longest path from the root to a leaf.
    pub depth: u32,
}

/// A node or a leaf.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Record {
    /// Boxes around up to four records.
    Node(Node),
    /// The index of a shape.
    Leaf(u32),
}

/// The boxes of a node's children, on a grid whose planes stand powers of two apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// The corner of the grid where the first planes of all three axes meet.
    pub origin: Vec3,
    /// For each axis: the planes are `2^exponent` apart, which is at least the smallest normal f32.
    pub exponents: [i32; 3],
    /// For each axis and child: the planes below and above the child.
    pub planes: [[[u8; WIDTH]; 2]; 3],
    /// The index of the first child's record.
    pub first: u32,
    /// How many children there are. The planes beyond them mean nothing.
    pub children: u32,
}

impl Bvh {
    /// The tree of shapes that have bounds. Its boxes hold each shape wherever it is while the shutter is open, for so many
    /// seconds. None where there are no shapes.
    pub fn new(shapes: Vec<Shaded>, shutter: f32) -> Option<Self> {
        if shapes.is_empty() {
            return None;
        }
        let bounds: Vec<Bounds> = shapes.iter().map(|of| bounds(of, shutter)).collect();
        let order = without_copies(&along_curve(&bounds), &shapes);
        let (mut records, mut depth) = widen(&tree(&bounds, &order));
        if depth > DEEPEST {
            (records, depth) = widen(&shallow_tree(&bounds, &order));
        }
        Some(Self { records, shapes, depth })
    }
}

/// The box around a shape wherever it is during the exposure, wider by what f32 may lose of a point on it.
fn bounds(of: &Shaded, shutter: f32) -> Bounds {
    let [lower, upper] = of.shape.bounds().expect("only bounded shapes are in a tree");
    let reach = 0.5 * shutter * of.velocity.abs();
    let (lower, upper) = (lower.as_vec3() - reach, upper.as_vec3() + reach);
    let margin = Vec3::splat(1e-6 * lower.abs().max(upper.abs()).max_element());
    Bounds::new(Vec3A::from(lower - margin), Vec3A::from(upper + margin))
}

/// The indices of shapes in the order of the curve. Of shapes that cover one another exactly, only the first is listed: a
/// ray sees no other, but would have to try all of them.
fn without_copies(along_curve: &[(u128, u32)], shapes: &[Shaded]) -> Vec<u32> {
    let mut indices = Vec::with_capacity(along_curve.len());
    for run in along_curve.chunk_by(|a, b| a.0 == b.0) {
        let mut known = HashSet::new();
        let is_new = |index: &u32| run.len() == 1 || known.insert(place(&shapes[*index as usize]));
        indices.extend(run.iter().map(|(_, index)| *index).filter(is_new));
    }
    indices
}

/// What shapes that always cover one another have in common: their kind, and the bits of numbers.
fn place(of: &Shaded) -> (std::mem::Discriminant<Shape>, [[u32; 3]; 4]) {
    // -0 and 0 are the same place.
    let bits = |vector: Vec3| (vector + Vec3::ZERO).to_array().map(f32::to_bits);
    let [a, b, c] = of.shape.place();
    (std::mem::discriminant(&of.shape), [a, b, c, of.velocity].map(bits))
}

/// The records of a binary tree, and their depth.
fn widen(binary: &Bvh2) -> (Vec<Record>, u32) {
    let mut records = vec![Record::Leaf(0)];
    // Nodes of the binary tree that are still to be visited: each with its record, and how many nodes are above it.
    let mut left = vec![(0, 0, 0)];
    let mut deepest = 0;
    while let Some((index, record, above)) = left.pop() {
        let node = &binary.nodes[index];
        if node.prim_count > 0 {
            records[record] = Record::Leaf(binary.primitive_indices[node.first_index as usize]);
            continue;
        }
        let children = children(binary, index);
        let boxes: Vec<Bounds> = children.iter().map(|child| binary.nodes[*child].aabb).collect();
        let first = records.len();
        records[record] = Record::Node(Node::new(&boxes, first));
        records.resize(first + children.len(), Record::Leaf(0));
        left.extend(children.iter().enumerate().map(|(child, index)| (*index, first + child, above + 1)));
        deepest = deepest.max(above + 1);
    }
    (records, deepest)
}

/// The nodes of the binary tree that are children of this one in the wide tree: the largest is replaced by
/// its two children, while there is room.
fn children(binary: &Bvh2, index: usize) -> Vec<usize> {
    let pair = |index: usize| {
        let first = binary.nodes[index].first_index as usize;
        [first, first + 1]
    };
    let mut children = pair(index).to_vec();
    while children.len() < WIDTH {
        let area = |child: usize| binary.nodes[children[child]].aabb.half_area();
        let inner = (0..children.len()).filter(|child| binary.nodes[children[*child]].prim_count == 0);
        let Some(largest) = inner.max_by(|a, b| area(*a).total_cmp(&area(*b))) else {
            break;
        };
        let [one, other] = pair(children[largest]);
        children[largest] = one;
        children.push(other);
    }
    children
}

impl Node {
    /// A node around one to four boxes, whose records begin at `first`.
    fn new(boxes: &[Bounds], first: usize) -> Self {
        let whole = boxes.iter().skip(1).fold(boxes[0], |whole, aabb| whole.union(aabb));
        let origin = Vec3::from(whole.min);
        let extent = Vec3::from(whole.max).as_dvec3() - origin.as_dvec3();
        // The smallest steps whose planes reach from one side to the other.
        let steps = (extent / f64::from(LAST_PLANE)).max(DVec3::splat(f32::MIN_POSITIVE.into()));
        let exponents = steps.to_array().map(|step| step.log2().ceil() as i32);
        let mut planes = [[[0; WIDTH]; 2]; 3];
        for (child, aabb) in boxes.iter().enumerate() {
            for axis in 0..3 {
                let place =
                    |at: f32| (f64::from(at) - f64::from(origin[axis])) / f64::from(exponents[axis]).exp2();
                planes[axis][0][child] = place(aabb.min[axis]).floor() as u8;
                planes[axis][1][child] = place(aabb.max[axis]).ceil() as u8;
            }
        }
        Self { origin, exponents, planes, first: first as u32, children: boxes.len() as u32 }
    }
}
