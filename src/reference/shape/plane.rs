//! Solves n . (o + t d - p) = 0 for t.

use super::{Crossing, Ray, tangent_coordinates};
use crate::scene::Plane;

pub(super) fn crossing(plane: &Plane, ray: Ray, least: f64) -> Option<Crossing> {
    let normal = plane.normal.as_dvec3().normalize();
    let distance = normal.dot(plane.point - ray.origin) / normal.dot(ray.direction);
    (distance.is_finite() && distance > least).then(|| {
        Crossing::flat(distance, normal, tangent_coordinates(normal, ray.origin + distance * ray.direction))
    })
}
