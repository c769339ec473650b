//! An iris of blades. The squared distance of a blade's edge from the centre is a mixture of the squared distances of a
//! straight edge and of a circle.

use super::squared_distance;
use crate::scene::Blades;
use std::f64::consts::{PI, TAU};

pub(super) fn point(of: &Blades, p: f64, xi: [f64; 2]) -> ([f64; 2], f64) {
    let (half, round) = (PI / f64::from(of.count), f64::from(of.roundness));
    let place = xi[0] * f64::from(of.count);
    let (blade, along) = (place.floor(), 2.0 * place.fract() - 1.0);
    // Twice the areas between the middle of an edge and a corner: `straight` is the area of the straight part, and
    // `round * half` that of the round part.
    let straight = (1.0 - round) * half.cos().powi(2) * half.tan();
    let share = straight / (straight + round * half);
    let angle = if along.abs() <= share {
        (along.abs() / share * half.tan()).atan()
    } else {
        (along.abs() - share) / (1.0 - share) * half
    };
    let edge = ((1.0 - round) * (half.cos() / angle.cos()).powi(2) + round).sqrt();
    let middle = f64::from(of.rotation_degrees).to_radians() + TAU * blade / f64::from(of.count);
    let (radius, angle) = (edge * squared_distance(p, xi[1]).sqrt(), middle + angle.copysign(along));
    ([radius * angle.cos(), radius * angle.sin()], 1.0)
}
