//! Solves |o + t d - c|^2 = r^2 for t, with the components of the vectors that are perpendicular to the axis.

use super::{Crossing, Ray, around, tangent_coordinates};
use crate::scene::Cylinder;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

pub(super) fn crossing(cylinder: &Cylinder, ray: Ray, least: f64) -> Option<Crossing> {
    let axis = cylinder.axis();
    let length = cylinder.start.distance(cylinder.end);
    let radius = f64::from(cylinder.radius);
    let from_start = ray.origin - cylinder.start;
    // The cross product with the axis turns the perpendicular component by a right angle, and keeps its length.
    let (origin, direction) = (from_start.cross(axis), ray.direction.cross(axis));
    let (a, half_b) = (direction.length_squared(), origin.dot(direction));
    let discriminant = half_b * half_b - a * (origin.length_squared() - radius * radius);
    if a == 0.0 || discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let height = |distance: f64| (from_start + distance * ray.direction).dot(axis);
    let met = |distance: &f64| *distance > least && (0.0..=length).contains(&height(*distance));
    let distance = [(-half_b - root) / a, (-half_b + root) / a].into_iter().find(met)?;
    let at = from_start + distance * ray.direction;
    let normal = (at - height(distance) * axis) / radius;
    let turned = tangent_coordinates(axis, normal);
    let uv = DVec2::new(0.5 + turned.y.atan2(turned.x) / TAU, height(distance) / length);
    Some(Crossing::flat(distance, normal, uv))
}

/// The first value goes around the axis and the second along it.
pub(super) fn point(of: &Cylinder, [turn, height]: [f64; 2]) -> (DVec3, DVec3) {
    let (sine, cosine) = (TAU * turn).sin_cos();
    let normal = around(of.axis(), DVec3::new(cosine, 0.0, sine));
    (of.start + height * (of.end - of.start) + f64::from(of.radius) * normal, normal)
}
