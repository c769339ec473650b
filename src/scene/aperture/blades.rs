//! An iris of blades.

use super::{CORNERS, Kind, Opening};
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

    fn openings(&self, _film: [f64; 2]) -> Vec<Opening> {
        let (half, round) = (self.half_angle(), f64::from(self.roundness));
        let turned = f64::from(self.rotation_degrees).to_radians();
        // The polygon has whole steps from corner to corner of the iris, so that it shows these as they are.
        let steps = (CORNERS / self.count).max(1) * 2;
        let corner = |number: u32| {
            let step = f64::from(number) * 2.0 * half / f64::from(steps);
            let from_middle = step % (2.0 * half) - half;
            let radius = ((1.0 - round) * (half.cos() / from_middle.cos()).powi(2) + round).sqrt();
            let angle = turned - half + step;
            [radius * angle.cos(), radius * angle.sin()]
        };
        vec![Opening { corners: (0..steps * self.count).map(corner).collect(), light: 1.0 }]
    }
}
