//! Solves |o + t d - c|^2 = r^2 for t.

use super::{Crossing, Ray};
use crate::reference::sampler::in_cone;
use crate::scene::Sphere;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

pub(super) fn crossing(sphere: &Sphere, ray: Ray, least: f64) -> Option<Crossing> {
    let radius = f64::from(sphere.radius);
    let from_center = ray.origin - sphere.center;
    let half_b = from_center.dot(ray.direction);
    let discriminant = half_b * half_b - (from_center.length_squared() - radius * radius);
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let distance = [-half_b - root, -half_b + root].into_iter().find(|distance| *distance > least)?;
    let normal = (ray.origin + distance * ray.direction - sphere.center) / radius;
    // Longitude and latitude.
    let uv = DVec2::new(0.5 + normal.z.atan2(normal.x) / TAU, 0.5 + normal.y.clamp(-1.0, 1.0).asin() / PI);
    Some(Crossing::flat(distance, normal, uv))
}

/// In every direction from the centre alike. The device has z upwards here.
pub(super) fn point(of: &Sphere, xi: [f64; 2]) -> (DVec3, DVec3) {
    let DVec3 { x, y, z } = in_cone(xi, -1.0);
    let normal = DVec3::new(x, z, y);
    (of.center + f64::from(of.radius) * normal, normal)
}
