//! The camera, its thin lens, and its hole.

use glam::{DMat3, DVec3};

/// Where the picture is taken from. Lengths are in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The lens centre.
    pub eye: DVec3,
    /// A point on the optical axis.
    pub look_at: DVec3,
    /// Roughly upwards; not along the axis.
    pub up: DVec3,
    /// The angle from the picture's lower to its upper edge, seen from the eye.
    pub vfov_radians: f64,
    /// The length in metres of one scene unit.
    pub metres_per_unit: f64,
}

/// What forms the picture.
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

/// The thin lens: Suffern, chapter 10. Lengths are in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// Diameter; 0 is a pinhole.
    pub diameter: f32,
    /// Distance of the focal plane along the optical axis.
    pub focal_distance: f32,
}

/// The hole of a physical pinhole camera. The film stands [`Camera::film_distance`] behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// Diameter in scene units.
    pub diameter: f32,
    /// Whether the picture is turned upright; on the film it is upside down.
    pub upright: bool,
}

/// The camera's right-handed orthonormal frame: u right, v up, and the view along -w.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Columns u, v, w in world coordinates.
    pub world_from_camera: DMat3,
}

impl Camera {
    /// The camera's frame.
    pub fn frame(&self) -> Frame {
        let w = (self.eye - self.look_at).normalize();
        let u = self.up.cross(w).normalize();
        Frame { world_from_camera: DMat3::from_cols(u, w.cross(u), w) }
    }

    /// The same camera with its coordinates rounded to a millionth of the distance to what it looks at. More digits make
    /// no difference that can be seen, and would only be long to read.
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

    /// Whether a frame can be made of it.
    pub fn has_frame(&self) -> bool {
        self.validate(["", "", ""]).is_ok()
    }

    /// Checks that these values give a frame. The names are what the user calls the two points and the direction.
    ///
    /// # Errors
    /// The reason why they give none.
    pub fn validate(&self, [eye, look_at, up]: [&str; 3]) -> Result<(), String> {
        let axis = self.eye - self.look_at;
        if axis.length_squared() == 0.0 {
            return Err(format!("{eye} and {look_at} are the same point"));
        }
        let across = self.up.cross(axis.normalize()).length();
        if across <= 1e-9 * self.up.length() || self.up == DVec3::ZERO {
            return Err(format!("{up} points along the line of sight; choose another direction for it"));
        }
        Ok(())
    }
}

impl Frame {
    /// The depth of a point along the optical axis, in front of the eye.
    pub fn axial_depth(&self, eye: DVec3, point: DVec3) -> f64 {
        -self.w().dot(point - eye)
    }

    /// Right.
    pub fn u(&self) -> DVec3 {
        self.world_from_camera.x_axis
    }

    /// Up.
    pub fn v(&self) -> DVec3 {
        self.world_from_camera.y_axis
    }

    /// Backwards.
    pub fn w(&self) -> DVec3 {
        self.world_from_camera.z_axis
    }
}
