//! Solves o + t d = corner + u a + v b for t, u and v, with the inverse of a matrix.

use super::{Crossing, Ray};
use crate::scene::Rectangle;
use glam::{DMat3, DVec2, DVec3};

pub(super) fn crossing(rectangle: &Rectangle, ray: Ray, least: f64) -> Option<Crossing> {
    let [a, b] = rectangle.edges;
    let matrix = DMat3::from_cols(a, b, -ray.direction);
    if matrix.determinant() == 0.0 {
        return None;
    }
    let [u, v, distance] = (matrix.inverse() * (ray.origin - rectangle.corner)).to_array();
    let inside = [u, v].iter().all(|share| (0.0..=1.0).contains(share));
    (inside && distance > least).then(|| Crossing::flat(distance, a.cross(b).normalize(), DVec2::new(u, v)))
}

/// A value for each edge.
pub(super) fn point(of: &Rectangle, [u, v]: [f64; 2]) -> (DVec3, DVec3) {
    let [a, b] = of.edges;
    (of.corner + u * a + v * b, a.cross(b).normalize())
}
