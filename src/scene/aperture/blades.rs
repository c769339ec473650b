//! An iris of blades.

use super::Kind;
use std::f64::consts::PI;

/// An iris of blades, whose corners lie on the rim of the opening. See [`super::Aperture`] for its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blades {
    /// How many there are.
    pub count: u32,
    /// How far the iris is turned.
    pub rotation_degrees: f32,
    /// How far their edges are bent out.
    pub roundness: f32,
}

impl Blades {
    /// Half the angle that a blade takes.
    pub fn half_angle(&self) -> f64 {
        PI / f64::from(self.count)
    }
}

impl Kind for Blades {
    fn open_share(&self) -> f64 {
        let (half, round) = (self.half_angle(), f64::from(self.roundness));
        // Twice the area of half a blade's part: of a triangle, and of a sector of the disc.
        ((1.0 - round) * half.sin() * half.cos() + round * half) / half
    }
}
