//! The overlap of two discs, which is two caps back to back. Each cap is cut into slices of equal area.

use crate::scene::CatsEye;
use std::f64::consts::PI;

pub(super) fn point(of: CatsEye, film: [f64; 2], xi: [f64; 2]) -> ([f64; 2], f64) {
    let off = 2.0 * f64::from(of.in_corner);
    let way = film[0].hypot(film[1]);
    let shorter = if way > 1.0 { way.recip() } else { 1.0 };
    overlap(film.map(|share| -off * share * shorter), xi)
}

/// A point of the overlap of two unit discs, the second of which is shifted by `off`, and the area of the overlap as a
/// share of a disc's.
fn overlap(off: [f64; 2], xi: [f64; 2]) -> ([f64; 2], f64) {
    let distance = off[0].hypot(off[1]);
    let axis = if distance > 0.0 { off.map(|part| part / distance) } else { [1.0, 0.0] };
    // The area of a unit disc beyond a cut at cos(angle).
    let beyond = |angle: f64| angle - angle.sin() * angle.cos();
    let rims_meet = (distance / 2.0).min(1.0).acos();
    let side = 2.0 * xi[0] - 1.0;
    let wanted = (1.0 - side.abs()) * beyond(rims_meet);
    let (mut low, mut high) = (0.0, rims_meet);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if beyond(middle) < wanted { low = middle } else { high = middle }
    }
    let angle = 0.5 * (low + high);
    let along = if side < 0.0 { distance - angle.cos() } else { angle.cos() };
    let across = (2.0 * xi[1] - 1.0) * angle.sin();
    let point = [along * axis[0] - across * axis[1], along * axis[1] + across * axis[0]];
    (point, 2.0 * beyond(rims_meet) / PI)
}
