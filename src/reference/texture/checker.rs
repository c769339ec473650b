//! Suffern's 3D checker. A point on the boundary of two cells belongs to the lower one, also where it is above by what f64
//! may lose.

use crate::reference::surface::Surface;
use crate::scene::Checker;
use glam::DVec3;

/// What f64 may lose of a point of a flat surface, as a share of the coordinates at hand.
const ROUNDING: f64 = 1e-12;

pub(super) fn value(of: &Checker, at: &Surface) -> DVec3 {
    let cells = ((at.on_shape - ROUNDING * at.magnitude) / of.size).floor();
    let odd = (cells.x + cells.y + cells.z).rem_euclid(2.0) == 1.0;
    if odd { of.odd } else { of.even }.as_dvec3()
}
