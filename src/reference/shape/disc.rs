//! Turns the ray until the disc lies in the horizontal plane through the origin, where a height and a radius decide.

use super::{Crossing, Ray, around, local};
use crate::reference::sampler::concentric_disk;
use crate::scene::Disc;
use glam::{DVec2, DVec3};

pub(super) fn crossing(disc: &Disc, ray: Ray, least: f64) -> Option<Crossing> {
    let axis = disc.axis();
    let (origin, direction) = (local(axis, ray.origin - disc.center), local(axis, ray.direction));
    if direction.y == 0.0 {
        return None;
    }
    let distance = -origin.y / direction.y;
    let at = DVec2::new(origin.x + distance * direction.x, origin.z + distance * direction.z);
    let radius = f64::from(disc.radius);
    (at.length() <= radius && distance > least)
        .then(|| Crossing::flat(distance, axis, 0.5 + 0.5 * at / radius))
}

/// The map from the square to the disc is the one for points of the lens.
pub(super) fn point(of: &Disc, xi: [f64; 2]) -> (DVec3, DVec3) {
    let [x, z] = concentric_disk(xi).map(|share| f64::from(of.radius) * share);
    (of.center + around(of.axis(), DVec3::new(x, 0.0, z)), of.axis())
}
