//! An iris of blades.

use super::Kind;
use std::f64::consts::PI;

/// An iris of blades, whose corners lie on the rim of the aperture. [`super::Aperture`] describes the numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blades {
    /// The number of blades.
    pub count: u32,
    /// The angle by which the iris is turned, in degrees.
    pub rotation_degrees: f32,
    /// The curvature of the blades' edges.
    pub roundness: f32,
}

impl Blades {
    /// Half the angle that a blade spans.
    pub fn half_angle(&self) -> f64 {
        PI / f64::from(self.count)
    }
}

impl Kind for Blades {
    fn relative_area(&self) -> f64 {
        let (half, round) = (self.half_angle(), f64::from(self.roundness));
        // Twice the area of half a blade: of the triangle for a straight edge, and of the sector of the disc.
        ((1.0 - round) * half.sin() * half.cos() + round * half) / half
    }
}
