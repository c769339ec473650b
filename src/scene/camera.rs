//! The camera, its thin lens, and its hole.

use super::{MAX_LENGTH, MIN_LENGTH, Sensor};
use glam::{DMat3, DVec3};
use std::fmt::Display;

/// The vertical field of view, in degrees.
pub const VFOV_DEGREES: [f64; 2] = [0.01, 175.0];
/// The length of a scene unit, in metres.
pub const METRES_PER_UNIT: [f64; 2] = [1e-15, 1e15];
/// The focal length, in millimetres.
pub const FOCAL_LENGTHS_MM: [f64; 2] = [0.01, 1e5];
/// How far a lens is shifted beside the film, in millimetres.
pub const SHIFTS_MM: [f32; 2] = [-1000.0, 1000.0];

/// The position, the direction and the field of view of the camera. Lengths are in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The centre of the lens.
    pub eye: DVec3,
    /// A point on the optical axis.
    pub look_at: DVec3,
    /// A direction that is roughly up. It must not be parallel to the optical axis.
    pub up: DVec3,
    /// The vertical field of view: the angle between the lower and the upper edge of the picture.
    pub vfov_radians: f64,
    /// The length in metres of one scene unit.
    pub metres_per_unit: f64,
    /// The size of the film.
    pub sensor: Sensor,
    /// Whether the lens moves to focus, which narrows the field of view. Then the field of view above is that of focus at
    /// infinity. Otherwise the film stays where it is.
    pub focus_breathing: bool,
    /// How far the lens is shifted beside the film, to the right and upwards, in millimetres. The picture then shows more of
    /// what is at the right, or above. The lens stays at `eye`, so it is the film that moves.
    pub lens_shift_mm: [f32; 2],
}

/// The model of the camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CameraModel {
    /// A thin lens: [`Lens`].
    #[default]
    ThinLens,
    /// An ideal pinhole: everything is sharp.
    Pinhole,
    /// A hole in a box and no lens: [`Hole`].
    Hole,
}

impl CameraModel {
    /// Every model, by its name.
    pub const NAMES: [(&'static str, Self); 3] =
        [("thin-lens", Self::ThinLens), ("pinhole", Self::Pinhole), ("hole", Self::Hole)];
}

/// The diameter of a lens or a hole, in scene units.
pub const DIAMETERS: [f32; 2] = [0.0, MAX_LENGTH];
/// The f-number.
pub const F_NUMBERS: [f64; 2] = [0.01, 1e6];
/// The focal distance, in scene units.
pub const FOCAL_DISTANCES: [f32; 2] = [MIN_LENGTH, MAX_LENGTH];
/// The angle by which a lens is tilted, in degrees.
pub const TILTS: [f32; 2] = [-45.0, 45.0];
/// The angle by which an iris or the direction of a tilt is turned, in degrees.
pub const ROTATIONS: [f32; 2] = [-360.0, 360.0];
/// The Abbe number of a lens.
pub const ABBE_NUMBERS: [u32; 2] = [1, 100];

/// A thin lens: Suffern, chapter 10. Lengths are in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// The diameter. 0 is a pinhole.
    pub diameter: f32,
    /// The distance of the focal plane along the optical axis of the camera, which is perpendicular to the film.
    pub focal_distance: f32,
    /// The angle by which the axis of the lens is turned away from that of the camera.
    pub tilt_degrees: f32,
    /// The direction to which the axis is turned, anticlockwise as seen from behind the camera. At 0 it is turned down, at
    /// 90 to the right.
    pub tilt_direction_degrees: f32,
    /// The Abbe number of the glass: the lens bends blue light (F, 486.1 nm) more strongly than red light (C, 656.3 nm), by
    /// one over this number of its power. 0 is a lens without colour errors.
    pub abbe_number: u32,
}

impl Lens {
    /// A lens that is not tilted.
    pub const fn new(diameter: f32, focal_distance: f32) -> Self {
        Self { diameter, focal_distance, tilt_degrees: 0.0, tilt_direction_degrees: 0.0, abbe_number: 0 }
    }
}

/// The hole of a physical pinhole camera. The film stands [`Camera::film_distance`] behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// The diameter in scene units.
    pub diameter: f32,
    /// Whether the picture is turned upright. On the film it is upside down.
    pub upright: bool,
}

/// The right-handed orthonormal frame of the camera: u points right, v up, and the camera looks along -w.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The columns are u, v and w in world coordinates.
    pub world_from_camera: DMat3,
}

impl Camera {
    /// The frame of the camera.
    pub fn frame(&self) -> Frame {
        let w = (self.eye - self.look_at).normalize();
        let u = self.up.cross(w).normalize();
        Frame { world_from_camera: DMat3::from_cols(u, w.cross(u), w) }
    }

    /// The same camera with its coordinates rounded to a millionth of the distance to what it looks at. More digits
    /// make no difference that can be seen, and would only be long to read.
    #[must_use]
    pub fn with_few_digits(&self) -> Self {
        let decimals = 6 - self.eye.distance(self.look_at).log10().floor() as i32;
        // A power of ten with a positive exponent is exact, and so the quotient is the nearest number to its decimals.
        let power = 10_f64.powi(decimals.abs());
        let rounded = |point: DVec3| {
            if decimals < 0 { (point / power).round() * power } else { (point * power).round() / power }
        };
        Self { eye: rounded(self.eye), look_at: rounded(self.look_at), ..*self }
    }

    /// The field of view in degrees. Radians that were made from degrees come back bit for bit when the result is
    /// converted again.
    pub fn vfov_degrees(&self) -> f64 {
        let degrees = self.vfov_radians.to_degrees();
        let near = [degrees, degrees.next_up(), degrees.next_down()];
        near.into_iter().find(|degrees| degrees.to_radians() == self.vfov_radians).unwrap_or(degrees)
    }

    /// `k`: the distance of the view plane in pixels, for a picture of this height.
    pub fn view_distance_pixels(&self, height: u32) -> f64 {
        0.5 * f64::from(height) / (0.5 * self.vfov_radians).tan()
    }

    /// Whether the camera has a frame.
    pub fn has_frame(&self) -> bool {
        self.validate(|| [""; 3]).is_ok()
    }

    /// Checks that these values give a frame. `names` gives what the user calls the two points and the direction.
    ///
    /// # Errors
    /// The reason why they give none.
    pub fn validate<N: Display>(&self, names: impl FnOnce() -> [N; 3]) -> Result<(), String> {
        let axis = self.eye - self.look_at;
        if axis.length_squared() == 0.0 {
            let [eye, look_at, _] = names();
            return Err(format!("{eye} and {look_at} are the same point"));
        }
        let across = self.up.cross(axis.normalize()).length();
        if across <= 1e-9 * self.up.length() || self.up == DVec3::ZERO {
            let [_, _, up] = names();
            return Err(format!("{up} points along the line of sight; choose another direction for it"));
        }
        Ok(())
    }
}

impl Frame {
    /// The distance of a point from the eye, measured along the optical axis.
    pub fn axial_depth(&self, eye: DVec3, point: DVec3) -> f64 {
        -self.w().dot(point - eye)
    }

    /// The unit vector to the right.
    pub fn u(&self) -> DVec3 {
        self.world_from_camera.x_axis
    }

    /// The unit vector upwards.
    pub fn v(&self) -> DVec3 {
        self.world_from_camera.y_axis
    }

    /// The unit vector backwards.
    pub fn w(&self) -> DVec3 {
        self.world_from_camera.z_axis
    }
}
