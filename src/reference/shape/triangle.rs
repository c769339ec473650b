//! Solves o + t d = a + b1 (b - a) + b2 (c - a) for t, b1 and b2, with the inverse of a matrix.

use super::{Crossing, Ray};
use crate::scene::Triangle;
use glam::{DMat3, DVec2, DVec3};

pub(super) fn crossing(triangle: &Triangle, ray: Ray, least: f64) -> Option<Crossing> {
    // The surface coordinates u and v start at this corner.
    let triangle = triangle.from_widest_corner();
    let [a, b, c] = triangle.vertices;
    let (edge1, edge2) = (b - a, c - a);
    let matrix = DMat3::from_cols(edge1, edge2, -ray.direction);
    if matrix.determinant() == 0.0 {
        return None;
    }
    let [b1, b2, distance] = (matrix.inverse() * (ray.origin - a)).to_array();
    let inside = b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    (inside && distance > least).then(|| {
        let normal = edge1.cross(edge2).normalize();
        let shading_normal = shading_normal(&triangle, b1, b2, normal);
        Crossing { distance, normal, shading_normal, uv: DVec2::new(b1, b2) }
    })
}

fn shading_normal(triangle: &Triangle, b1: f64, b2: f64, normal: DVec3) -> DVec3 {
    let Some(corners) = triangle.normals else {
        return normal;
    };
    let [n0, n1, n2] = corners.map(|corner| corner.as_dvec3());
    let mean = ((1.0 - b1 - b2) * n0 + b1 * n1 + b2 * n2).try_normalize().unwrap_or(normal);
    if mean.dot(normal) < 0.0 { -mean } else { mean }
}

/// The first value decides how far the point is from the first corner: the area of the smaller triangle grows with the
/// square of that.
pub(super) fn point(of: &Triangle, [from_corner, across]: [f64; 2]) -> (DVec3, DVec3) {
    let [a, b, c] = of.from_widest_corner().vertices;
    let opposite = b + across * (c - b);
    (a + from_corner.sqrt() * (opposite - a), (b - a).cross(c - a).normalize())
}
