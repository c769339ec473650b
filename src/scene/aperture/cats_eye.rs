//! Optical vignetting.

use super::Kind;

/// The overlap of the lens's disc and its front rim, as far as it is off the disc's middle in the corner of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CatsEye {
    /// In diameters. Halfway to the corner it is half as much.
    pub in_corner: f32,
}

impl Kind for CatsEye {
    fn open_share(&self) -> f64 {
        1.0
    }
}
