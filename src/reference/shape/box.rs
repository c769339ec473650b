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

/// The first value goes through the faces perpendicular to x, then y, then z, first the lower and then the upper one, as far
/// as each is large.
pub(super) fn point(of: &Box, [chosen, across]: [f64; 2]) -> (DVec3, DVec3) {
    let size = (of.upper - of.lower).to_array();
    let area = |axis: usize| size[(axis + 1) % 3] * size[(axis + 2) % 3];
    let mut left = chosen * 2.0 * (area(0) + area(1) + area(2));
    let mut faces = [0, 0, 1, 1, 2, 2].into_iter().zip([0.0, 1.0].into_iter().cycle());
    let face = faces.find(|(axis, _)| {
        let is_here = left < area(*axis);
        left -= if is_here { 0.0 } else { area(*axis) };
        is_here
    });
    let (axis, side) = face.unwrap_or((2, 1.0));
    let mut share = [0.0; 3];
    share[axis] = side;
    share[(axis + 1) % 3] = left / area(axis);
    share[(axis + 2) % 3] = across;
    (of.lower + DVec3::from_array(share) * DVec3::from_array(size), DVec3::AXES[axis])
}
