//! Optical vignetting.

use super::Kind;

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
}
