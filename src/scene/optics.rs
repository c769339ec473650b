//! A lens in a photographer's units, and the size of its blur.
//!
//! The frame is 24 mm high and at the distance `v = 12 mm / tan(vfov / 2)` behind the lens. It stays there whatever is
//! in focus. [`Camera::metres_per_unit`] relates millimetres to the lengths of the scene. Circles of confusion follow
//! from similar triangles: K. Suffern, *Ray Tracing from the Ground Up*, section 10.1.

use super::{Camera, Lens, Tolerance};

/// Half the height of the frame in millimetres. A frame of 35 mm film is 36 mm wide and 24 mm high.
const HALF_FRAME_MM: f64 = 12.0;
/// The height of the frame in millimetres.
pub const FRAME_HEIGHT_MM: f64 = 2.0 * HALF_FRAME_MM;

/// The vertical field of view, in radians, of a lens of this focal length that is focused at infinity.
pub fn vfov_of_focal_length(millimetres: f64) -> f64 {
    // Converted to degrees and back, so that `vfov_degrees` finds degrees that give exactly these radians.
    (2.0 * (HALF_FRAME_MM / millimetres).atan()).to_degrees().to_radians()
}

impl Camera {
    /// The distance of the film behind the lens, in millimetres. It is the focal length that gives this field of view
    /// on a frame that is 24 mm high.
    pub fn focal_length_mm(&self) -> f64 {
        HALF_FRAME_MM / (0.5 * self.vfov_radians).tan()
    }

    /// The distance of the film behind the lens, in scene units.
    pub fn film_distance(&self) -> f64 {
        self.units_of_mm(self.focal_length_mm())
    }

    /// A length in scene units that is this long in millimetres.
    pub fn units_of_mm(&self, millimetres: f64) -> f64 {
        millimetres / 1000.0 / self.metres_per_unit
    }

    /// The length in millimetres of one scene unit.
    pub fn mm_per_unit(&self) -> f64 {
        1000.0 * self.metres_per_unit
    }

    /// A tolerance in pixels of a picture of this height.
    pub fn tolerance_pixels(&self, tolerance: Tolerance, height: u32) -> f64 {
        match tolerance {
            Tolerance::Film(mm) => f64::from(mm) / FRAME_HEIGHT_MM * f64::from(height),
            Tolerance::Pixels(pixels) => pixels.into(),
        }
    }

    /// The f-number of a lens with this diameter in scene units. Infinite for a pinhole.
    pub fn f_number(&self, diameter: f32) -> f64 {
        self.film_distance() / f64::from(diameter)
    }

    /// The diameter in scene units of a lens with this f-number.
    pub fn diameter_of_f_number(&self, f_number: f64) -> f64 {
        self.film_distance() / f_number
    }

    /// The diameter of a hole that blurs a far point to about 1/80 of the height of the picture.
    pub fn default_hole_diameter(&self) -> f32 {
        self.units_of_mm(0.3) as f32
    }

    /// The diameter of the circle of confusion of a point at this axial depth, in pixels of a picture of this height.
    /// It is positive behind the focal plane and negative in front of it.
    pub fn circle_of_confusion(&self, lens: &Lens, depth: f64, height: u32) -> f64 {
        let focal_distance = f64::from(lens.focal_distance);
        f64::from(lens.diameter) * (depth - focal_distance) / (depth * focal_distance)
            * self.view_distance_pixels(height)
    }

    /// The depth of field: the axial depths between which circles of confusion are at most `tolerance` pixels wide. The
    /// far limit is infinite if the lens is focused at the hyperfocal distance or beyond.
    pub fn depth_of_field(&self, lens: &Lens, tolerance: f64, height: u32) -> [f64; 2] {
        let focused = f64::from(lens.focal_distance).recip();
        let margin = self.hyperfocal_distance(lens, tolerance, height).recip();
        let far = (focused - margin).recip();
        [(focused + margin).recip(), if far > 0.0 { far } else { f64::INFINITY }]
    }

    /// The hyperfocal distance. A lens that is focused there or beyond blurs nothing behind its focal plane by more than
    /// `tolerance` pixels.
    pub fn hyperfocal_distance(&self, lens: &Lens, tolerance: f64, height: u32) -> f64 {
        f64::from(lens.diameter) * self.view_distance_pixels(height) / tolerance
    }
}
