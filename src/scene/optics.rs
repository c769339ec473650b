//! A lens in a photographer's units, and the size of its blur.
//!
//! The film is as high as [`Camera::sensor`] says, `h`, and stands at the distance `v = h / 2 / tan(vfov / 2)` behind the
//! lens. It stays there whatever is in focus, unless [`Camera::focus_breathing`] moves it: [`Camera::focused`].
//! [`Camera::metres_per_unit`] relates millimetres to the lengths of the scene. Circles of confusion follow from similar
//! triangles: K. Suffern, *Ray Tracing from the Ground Up*, section 10.1.

use super::{Camera, Lens, Tolerance};

/// A lens that moves to focus cannot focus nearer than this many focal lengths. There a thing is 100 times as large on
/// the film as it is.
const NEAREST_FOCAL_LENGTHS: f64 = 1.01;

impl Camera {
    /// The focal length of a lens with this field of view when it is focused at infinity: the distance of the film
    /// behind the lens, in millimetres.
    pub fn focal_length_mm(&self) -> f64 {
        0.5 * self.sensor.height_mm / (0.5 * self.vfov_radians).tan()
    }

    /// Gives the camera the field of view of this focal length.
    pub fn set_focal_length_mm(&mut self, millimetres: f64) {
        self.vfov_radians = self.sensor.vfov_of_focal_length(millimetres);
    }

    /// The focal length that gives the same view on full frame, by the diagonals of the two formats.
    pub fn focal_length_35mm(&self) -> f64 {
        self.focal_length_mm() * self.sensor.crop_factor()
    }

    /// The distance of the film behind the lens, in scene units.
    pub fn film_distance(&self) -> f64 {
        self.units_of_mm(self.focal_length_mm())
    }

    /// The camera when this lens is in focus. With focus breathing, a lens of the focal length `f` stands
    /// `v = f F / (F - f)` before the film, which narrows the field of view. If the lens is tilted by an angle `a`, `v` is
    /// `f F / (F cos a - f)`. Without focus breathing nothing changes.
    #[must_use]
    pub fn focused(&self, lens: &Lens) -> Self {
        if !self.focus_breathing {
            return *self;
        }
        let (focal_length, focused) = (self.film_distance(), f64::from(lens.focal_distance));
        let narrowed = (0.5 * self.vfov_radians).tan() * (focused * lens.cos_tilt() - focal_length) / focused;
        Self { vfov_radians: 2.0 * narrowed.atan(), focus_breathing: false, ..*self }
    }

    /// Checks that the lens can be focused so near.
    ///
    /// # Errors
    /// What is wrong, as the end of a sentence that begins with what the user calls the focal distance.
    pub fn can_focus(&self, lens: &Lens) -> Result<(), String> {
        let nearest = NEAREST_FOCAL_LENGTHS * self.film_distance() / lens.cos_tilt();
        if !self.focus_breathing || f64::from(lens.focal_distance) >= nearest {
            return Ok(());
        }
        Err(format!(
            "is {}, but with focus breathing a lens of {:.4} mm must be focused at {nearest:.4} scene units or more",
            lens.focal_distance,
            self.focal_length_mm(),
        ))
    }

    /// A length in scene units that is this long in millimetres.
    pub fn units_of_mm(&self, millimetres: f64) -> f64 {
        millimetres / 1000.0 / self.metres_per_unit
    }

    /// The length in millimetres of one scene unit.
    pub fn mm_per_unit(&self) -> f64 {
        1000.0 * self.metres_per_unit
    }

    /// A tolerance as a length on this film. The length that is given for full frame is divided by the crop factor,
    /// because the picture of a smaller film is enlarged more to be looked at.
    pub fn tolerance_mm(&self, tolerance: Tolerance, height: u32) -> f64 {
        match tolerance {
            Tolerance::Film(mm) => f64::from(mm) / self.sensor.crop_factor(),
            Tolerance::Pixels(pixels) => f64::from(pixels) * self.mm_per_pixel(height),
        }
    }

    /// A tolerance in pixels of a picture of this height.
    pub fn tolerance_pixels(&self, tolerance: Tolerance, height: u32) -> f64 {
        match tolerance {
            Tolerance::Film(_) => self.tolerance_mm(tolerance, height) / self.mm_per_pixel(height),
            Tolerance::Pixels(pixels) => pixels.into(),
        }
    }

    /// The length in millimetres on the film of a pixel of a picture of this height.
    pub fn mm_per_pixel(&self, height: u32) -> f64 {
        self.sensor.height_mm / f64::from(height)
    }

    /// The f-number of a lens with this diameter in scene units. Infinite for a pinhole.
    pub fn f_number(&self, diameter: f32) -> f64 {
        self.film_distance() / f64::from(diameter)
    }

    /// The diameter in scene units of a lens with this f-number.
    pub fn diameter_of_f_number(&self, f_number: f64) -> f64 {
        self.film_distance() / f_number
    }

    /// The diameter of a hole that blurs a far point to about 1/80 of the height of a picture on full frame.
    pub fn default_hole_diameter(&self) -> f32 {
        self.units_of_mm(0.3) as f32
    }

    /// The diameter of the circle of confusion of a point at this depth on the optical axis, in pixels of a picture of this
    /// height.
    /// It is positive behind the focal plane and negative in front of it.
    pub fn circle_of_confusion(&self, lens: &Lens, depth: f64, height: u32) -> f64 {
        self.circle_of_confusion_at(lens, self.eye - depth * self.frame().w(), height)
    }

    /// The depth of field: the depths on the optical axis between which circles of confusion are at most `tolerance` pixels
    /// wide. The far limit is infinite if the lens is focused at the hyperfocal distance or beyond.
    pub fn depth_of_field(&self, lens: &Lens, tolerance: f64, height: u32) -> [f64; 2] {
        let focused = f64::from(lens.focal_distance).recip();
        let view_distance = self.focused(lens).view_distance_pixels(height);
        let margin = (f64::from(lens.diameter) * view_distance / tolerance).recip();
        let far = (focused - margin).recip();
        [(focused + margin).recip(), if far > 0.0 { far } else { f64::INFINITY }]
    }

    /// The hyperfocal distance. A lens that is focused there or beyond blurs nothing behind its focal plane by more than
    /// `tolerance` pixels.
    pub fn hyperfocal_distance(&self, lens: &Lens, tolerance: f64, height: u32) -> f64 {
        let without_breathing = f64::from(lens.diameter) * self.view_distance_pixels(height) / tolerance;
        if !self.focus_breathing {
            return without_breathing;
        }
        // With breathing, D v / c = F, where v = f F / (F cos a - f): so F cos a = D f / c + f.
        (without_breathing + self.film_distance()) / lens.cos_tilt()
    }
}
