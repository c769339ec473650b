//! Optical vignetting.

use super::{Kind, Opening};

/// The overlap of the disc of the lens with the disc of its front rim, which appears displaced off the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CatsEye {
    /// The displacement in a corner of the picture, in diameters. It is proportional to the distance from the middle.
    pub in_corner: f32,
}

impl Kind for CatsEye {
    fn relative_area(&self) -> f64 {
        1.0
    }

    fn openings(&self, film: [f64; 2]) -> Vec<Opening> {
        let shift = 2.0 * f64::from(self.in_corner) / film[0].hypot(film[1]).max(1.0);
        let half = film.map(|share| -0.5 * shift * share);
        // From the middle of the overlap, each rim is where a ray leaves its disc, and the overlap ends at the nearer
        // one. The middles of the two discs lie at `half` and at `-half` from here. The corners of the overlap lie across.
        Opening::around(half, half[0].atan2(-half[1]), |angle| {
            let along = (half[0] * angle.cos() + half[1] * angle.sin()).abs();
            let squared = 1.0 - half[0] * half[0] - half[1] * half[1] + along * along;
            squared.max(0.0).sqrt() - along
        })
    }
}
