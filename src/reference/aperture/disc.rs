//! A disc.

use super::squared_distance;
use crate::reference::sampler::concentric_disk;

pub(super) fn point(p: f64, xi: [f64; 2]) -> ([f64; 2], f64) {
    let even = concentric_disk(xi);
    let squared = even[0].powi(2) + even[1].powi(2);
    let outwards = if squared > 0.0 { (squared_distance(p, squared) / squared).sqrt() } else { 1.0 };
    (even.map(|part| outwards * part), 1.0)
}
