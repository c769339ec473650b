//! Normals for triangles that have none: smooth where faces meet at a small angle, and with a crease at edges.

use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// The crease angle: faces whose normals differ by more meet in a visible edge.
const CREASE_DEGREES: f32 = 40.0;

/// Up to so many triangles around a position are compared one by one.
const FEW: usize = 32;

/// Unit normals for triangles that have none. The normal at a corner is the mean over the triangles that share its
/// position and are within the crease angle, weighted by their areas.
pub(super) fn crease_normals(triangles: &[[DVec3; 3]]) -> Vec<[Vec3; 3]> {
    let normals: Vec<Weighed> = triangles
        .iter()
        .map(|[a, b, c]| {
            let across = (b - a).cross(c - a);
            let area = across.length();
            Weighed { normal: (across / area).as_vec3(), area: area as f32 }
        })
        .collect();
    let vertex_of_corner = merge(triangles.as_flattened());
    let vertex_count = vertex_of_corner.iter().max().map_or(0, |last| *last as usize + 1);
    // The triangles around vertex v are around[start[v] .. start[v + 1]].
    let mut start = vec![0_u32; vertex_count + 1];
    vertex_of_corner.iter().for_each(|vertex| start[*vertex as usize + 1] += 1);
    (0..vertex_count).for_each(|vertex| start[vertex + 1] += start[vertex]);
    let mut next = start.clone();
    let mut around = vec![0_u32; vertex_of_corner.len()];
    for (triangle, corners) in (0_u32..).zip(vertex_of_corner.chunks_exact(3)) {
        for vertex in corners {
            let slot = &mut next[*vertex as usize];
            around[*slot as usize] = triangle;
            *slot += 1;
        }
    }
    let around = |vertex: usize| {
        let range = start[vertex] as usize..start[vertex + 1] as usize;
        around[range].iter().map(|triangle| &normals[*triangle as usize])
    };
    let crowded = (0..vertex_count).filter(|vertex| around(*vertex).len() > FEW);
    let trees: HashMap<usize, Tree> =
        crowded.map(|vertex| (vertex, Tree::new(around(vertex).copied().collect()))).collect();
    let min_cosine = CREASE_DEGREES.to_radians().cos();
    let corner_normal = |own: Vec3, vertex: u32| {
        let vertex = vertex as usize;
        let sum = if around(vertex).len() > FEW {
            trees[&vertex].sum(own, min_cosine)
        } else {
            sum(around(vertex).filter(|near| near.normal.dot(own) >= min_cosine))
        };
        sum.try_normalize().unwrap_or(own)
    };
    let of_triangle = |(own, corners): (&Weighed, &[u32])| {
        [0, 1, 2].map(|corner: usize| corner_normal(own.normal, corners[corner]))
    };
    normals.iter().zip(vertex_of_corner.chunks_exact(3)).map(of_triangle).collect()
}

/// Numbers the positions from 0. Equal positions get the same number, for files repeat them along seams.
fn merge(positions: &[DVec3]) -> Vec<u32> {
    let mut numbers = HashMap::with_capacity(positions.len() / 4);
    let number = |position: &DVec3| {
        // -0 and 0 are the same place.
        let key = (*position + DVec3::ZERO).to_array().map(f64::to_bits);
        let next = u32::try_from(numbers.len()).unwrap_or(u32::MAX);
        *numbers.entry(key).or_insert(next)
    };
    positions.iter().map(number).collect()
}

/// A triangle's unit normal, and twice its area.
#[derive(Clone, Copy)]
struct Weighed {
    normal: Vec3,
    area: f32,
}

/// A sum of normals weighted by area, which points as their mean does.
fn sum<'a>(near: impl Iterator<Item = &'a Weighed>) -> Vec3 {
    near.map(|near| near.area * near.normal).sum()
}

/// Many normals, halved again and again, so that those near a direction can be summed without comparing each.
struct Tree {
    normals: Vec<Weighed>,
    /// The sum and the box of the normals of each range of the halving. A range comes before its halves.
    ranges: Vec<Range>,
}

struct Range {
    lower: Vec3,
    upper: Vec3,
    sum: Vec3,
    /// How many ranges follow that are inside.
    inside: usize,
}

impl Tree {
    fn new(normals: Vec<Weighed>) -> Self {
        let mut tree = Self { normals, ranges: Vec::new() };
        tree.halve(0, tree.normals.len());
        tree
    }

    fn halve(&mut self, start: usize, end: usize) {
        let normals = &mut self.normals[start..end];
        let lower = normals.iter().fold(Vec3::INFINITY, |lower, near| lower.min(near.normal));
        let upper = normals.iter().fold(Vec3::NEG_INFINITY, |upper, near| upper.max(near.normal));
        let sum = sum(normals.iter());
        let index = self.ranges.len();
        self.ranges.push(Range { lower, upper, sum, inside: 0 });
        if end - start > FEW {
            let axis = (upper - lower).max_position();
            let half = (end - start) / 2;
            normals.select_nth_unstable_by(half, |a, b| a.normal[axis].total_cmp(&b.normal[axis]));
            self.halve(start, start + half);
            self.halve(start + half, end);
            self.ranges[index].inside = self.ranges.len() - index - 1;
        }
    }

    /// The sum of the normals whose cosine with a direction is at least so much.
    fn sum(&self, direction: Vec3, min_cosine: f32) -> Vec3 {
        let positive = direction.cmpge(Vec3::ZERO);
        let mut total = Vec3::ZERO;
        // The ranges that are still to be visited: where each starts and ends, and its index.
        let mut left = vec![(0, self.normals.len(), 0)];
        while let Some((start, end, index)) = left.pop() {
            let range = &self.ranges[index];
            // All cosines are rounded alike, so that of a normal in the box lies between those of two of the box's corners.
            let nearest = Vec3::select(positive, range.upper, range.lower).dot(direction);
            let farthest = Vec3::select(positive, range.lower, range.upper).dot(direction);
            if farthest >= min_cosine {
                total += range.sum;
            } else if nearest >= min_cosine {
                if range.inside > 0 {
                    let half = start + (end - start) / 2;
                    left.push((half, end, index + 2 + self.ranges[index + 1].inside));
                    left.push((start, half, index + 1));
                } else {
                    let near = self.normals[start..end].iter();
                    total += sum(near.filter(|near| near.normal.dot(direction) >= min_cosine));
                }
            }
        }
        total
    }
}
