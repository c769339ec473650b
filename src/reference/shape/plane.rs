//! n . (o + t d - p) = 0.

use super::{Crossing, Ray};
use crate::scene::Plane;
use glam::{DQuat, DVec2, DVec3};

pub(super) fn crossing(plane: &Plane, ray: Ray, least: f64) -> Option<Crossing> {
    let normal = plane.normal.as_dvec3().normalize();
    let distance = normal.dot(plane.point - ray.origin) / normal.dot(ray.direction);
    (distance.is_finite() && distance > least).then(|| {
        // The world's axes x and z, turned with the normal from the vertical that it is nearer to.
        let vertical = if normal.y < 0.0 { DVec3::NEG_Y } else { DVec3::Y };
        let from_level =
            DQuat::from_rotation_arc(vertical, normal).inverse() * (ray.origin + distance * ray.direction);
        Crossing::flat(distance, normal, DVec2::new(from_level.x, from_level.z))
    })
}
