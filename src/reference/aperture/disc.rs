//! A disc.

use crate::reference::sampler::concentric_disk;

pub(super) fn point(xi: [f64; 2]) -> ([f64; 2], f64) {
    (concentric_disk(xi), 1.0)
}
