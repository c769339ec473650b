//! The shape of the opening that light comes in through.

use super::ApertureImage;
use std::f64::consts::PI;

/// How many blades an iris can have.
pub const BLADES: std::ops::RangeInclusive<u32> = 3..=16;

/// The shape of an opening of a given diameter. Light comes in evenly all over it.
#[derive(Debug, Clone, PartialEq)]
pub struct Aperture {
    /// Blades of the iris, whose corners lie on the rim of the opening; 0 is a disc.
    pub blades: u32,
    /// How far the iris is turned, anticlockwise as seen from behind the camera. At 0 a blade's edge
    /// is at its right.
    pub rotation_degrees: f32,
    /// How far the blades' edges are bent out: 0 is a polygon, 1 a disc. In between the square of the
    /// distance from the centre is.
    pub roundness: f32,
    /// How often its width goes into its height; the longer of the two is the diameter.
    pub anamorphic: f32,
    /// Optical vignetting, of a disc: how far the lens's front rim is off its centre, seen from a corner of
    /// the picture, in diameters. What passes both is the overlap of two discs.
    pub cats_eye: f32,
    /// An image, in whose bright parts light comes in, instead of all that.
    pub image: Option<ApertureImage>,
}

impl Default for Aperture {
    fn default() -> Self {
        Self { blades: 0, rotation_degrees: 0.0, roundness: 0.0, anamorphic: 1.0, cats_eye: 0.0, image: None }
    }
}

impl Aperture {
    /// Why it is none, if so.
    pub fn fault(&self) -> Option<String> {
        let range = |name: &str, value: f32, low: f32, high: f32| {
            (!(low..=high).contains(&value))
                .then(|| format!("{name} is {value}, but must be from {low} to {high}"))
        };
        if self.blades != 0 && !BLADES.contains(&self.blades) {
            let (low, high) = (BLADES.start(), BLADES.end());
            return Some(format!(
                "blades is {}, but must be from {low} to {high}, or 0 for a disc",
                self.blades
            ));
        }
        let shapes = [self.blades != 0, self.cats_eye != 0.0, self.image.is_some()];
        if shapes.into_iter().filter(|chosen| *chosen).count() > 1 {
            return Some("blades, cats-eye and aperture-image are shapes of their own; choose one".into());
        }
        range("blade-rotation", self.rotation_degrees, -360.0, 360.0)
            .or_else(|| range("roundness", self.roundness, 0.0, 1.0))
            .or_else(|| range("anamorphic", self.anamorphic, 0.1, 10.0))
            .or_else(|| range("cats-eye", self.cats_eye, 0.0, 1.0))
    }

    /// Half the width and half the height of an opening of diameter 2.
    pub fn stretch(&self) -> [f64; 2] {
        let ratio = f64::from(self.anamorphic);
        [ratio.recip().min(1.0), ratio.min(1.0)]
    }

    /// The share that is open of a disc of the same diameter, seen from the middle of the picture. The corners of
    /// blades lie on the disc's rim, so three let in 41% of its light, five 76%, six 83% and eight 90%.
    pub fn open_share(&self) -> f64 {
        let [half_width, half_height] = self.stretch();
        let of_disc = match &self.image {
            Some(image) => {
                let longer = f64::from(image.size[0].max(image.size[1]));
                let light: f64 = image.cells.iter().copied().map(f64::from).sum();
                light * (2.0 / longer).powi(2) / PI
            }
            None if self.blades > 0 => {
                let (half, round) = (self.half_blade(), f64::from(self.roundness));
                // Twice the area of half a blade's part: of a triangle, and of a sector of the disc.
                ((1.0 - round) * half.sin() * half.cos() + round * half) / half
            }
            None => 1.0,
        };
        half_width * half_height * of_disc
    }

    /// Half the angle that a blade takes.
    pub fn half_blade(&self) -> f64 {
        PI / f64::from(self.blades)
    }
}
