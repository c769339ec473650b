//! Tests the six faces of a box one by one.

use super::{Crossing, Ray};
use crate::scene::Box;
use glam::{DVec2, DVec3};

pub(super) fn crossing(of: &Box, ray: Ray, least: f64) -> Option<Crossing> {
    let (lower, upper) = (of.lower.to_array(), of.upper.to_array());
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let mut nearest: Option<Crossing> = None;
    for axis in 0..3 {
        for (face, sign) in [(lower[axis], -1.0), (upper[axis], 1.0)] {
            let distance = (face - origin[axis]) / direction[axis];
            let place = [1, 2].map(|next| {
                let other = (axis + next) % 3;
                (origin[other] + distance * direction[other] - lower[other]) / (upper[other] - lower[other])
            });
            let inside = place.iter().all(|share| (0.0..=1.0).contains(share));
            let nearer = nearest.is_none_or(|nearest| distance < nearest.distance);
            if distance.is_finite() && distance > least && inside && nearer {
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                nearest = Some(Crossing::flat(distance, DVec3::from_array(normal), DVec2::from_array(place)));
            }
        }
    }
    nearest
}
