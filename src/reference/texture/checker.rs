//! Suffern's 3D checker. A point on the boundary of two cells belongs to the lower cell, even if a rounding error of
//! f64 puts the point above the boundary.

use crate::reference::surface::Surface;
use crate::scene::Checker;
use glam::DVec3;

/// An upper bound for the rounding error of a point on a flat surface, relative to the point's coordinates.
const ROUNDING: f64 = 1e-12;

pub(super) fn value(of: &Checker, at: &Surface) -> DVec3 {
    let cells = ((at.rest_position - ROUNDING * at.magnitude) / of.size).floor();
    let odd = (cells.x + cells.y + cells.z).rem_euclid(2.0) == 1.0;
    if odd { of.odd } else { of.even }.as_dvec3()
}
