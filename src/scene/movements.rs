//! The movements of a view camera: the lens is shifted beside the film, or tilted.
//!
//! A film point looks along `(q, -1)`, in the camera's frame, through the centre of the lens: this ray is not bent. On it
//! lies the point in focus, at a depth `z`, and on the other side the film point, at the distance `v`. If the axis of the
//! lens is `n`, their distances along it are `c z` and `c v`, where `c = (q, -1) . n`, and the equation of the thin lens
//! gives `1 / z + 1 / v = c / f`. So `1 / z` is linear in `q`, which means that the points in focus lie in a plane.

use super::{Camera, Frame, Lens};
use glam::{DVec2, DVec3};

/// Where a lens is in focus. Lengths are in scene units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FocalPlane {
    /// `1 / F`: one over the depth on the optical axis of the camera, which is perpendicular to the film.
    pub inverse_distance: f64,
    /// By how much `1 / z` grows with `q`. Its length is `1 / J`: the plane meets the plane that goes through the centre of
    /// the lens and is parallel to the film in a line, the hinge line, and `J` is the distance of this line from the lens.
    pub slope: DVec2,
    /// The parts to the right and upwards of the axis of the lens, which is a vector of length 1.
    pub tilt: DVec2,
    /// `1 / f`: one over the focal length of the lens when it is in focus.
    pub inverse_focal_length: f64,
}

impl FocalPlane {
    /// `1 / z`: one over the depth in which the film point `q` is in focus.
    pub fn inverse_depth(&self, q: DVec2) -> f64 {
        self.inverse_distance + self.slope.dot(q)
    }

    /// The axis of the lens in the camera's frame, of length 1.
    pub fn lens_axis(&self) -> DVec3 {
        self.tilt.extend(-(1.0 - self.tilt.length_squared()).sqrt())
    }

    /// The film point that the axis of the lens goes through.
    pub fn axis(&self) -> DVec2 {
        self.tilt / -self.lens_axis().z
    }
}

impl Lens {
    /// The cosine of the angle between the axis of the lens and that of the camera.
    pub fn cos_tilt(&self) -> f64 {
        f64::from(self.tilt_degrees).to_radians().cos()
    }

    /// The parts to the right and upwards of the axis of the lens, which is a vector of length 1.
    pub fn tilt(&self) -> DVec2 {
        let direction = f64::from(self.tilt_direction_degrees).to_radians();
        f64::from(self.tilt_degrees).to_radians().sin() * DVec2::new(direction.sin(), -direction.cos())
    }
}

impl Camera {
    /// How far the film point in the middle of the picture is shifted, as a slope: the shift divided by the distance of
    /// the film. The film stands as for focus at infinity, so this is to be asked of the camera in focus.
    pub fn shift(&self) -> DVec2 {
        DVec2::from_array(self.lens_shift_mm.map(f64::from)) / self.focal_length_mm()
    }

    /// Where this lens is in focus.
    pub fn focal_plane(&self, lens: &Lens) -> FocalPlane {
        let inverse_distance = f64::from(lens.focal_distance).recip();
        let on_film = self.focused(lens).film_distance().recip();
        let (tilt, inverse_focal_length) = (lens.tilt(), (on_film + inverse_distance) / lens.cos_tilt());
        FocalPlane { inverse_distance, slope: tilt * inverse_focal_length, tilt, inverse_focal_length }
    }

    /// The focal distance with which the plane of sharp focus goes through a point. `None` if no focal distance does that,
    /// which happens only with a tilt.
    pub fn focal_distance_through(&self, lens: &Lens, point: DVec3) -> Option<f64> {
        let (q, depth) = self.frame().film_point(self.eye, point);
        self.focal_distance_at(lens, q, depth)
    }

    /// The focal distance with which the film point `q` is in focus in this depth, as [`Self::focal_distance_through`].
    pub fn focal_distance_at(&self, lens: &Lens, q: DVec2, depth: f64) -> Option<f64> {
        let (tilt, f_or_v) = (lens.tilt().dot(q), self.film_distance());
        let distance = if self.focus_breathing {
            // 1 / F = 1 / z - q . tilt / f
            depth / (1.0 - depth * tilt / f_or_v)
        } else {
            // 1 / z = 1 / F + (1 / F + 1 / v) q . tilt / cos
            let slant = tilt / lens.cos_tilt();
            depth * (1.0 + slant) / (1.0 - depth * slant / f_or_v)
        };
        (distance > 0.0 && distance.is_finite()).then_some(distance)
    }

    /// The diameter of the circle of confusion of a point, as [`Self::circle_of_confusion`] gives it on the optical axis. A
    /// tilted lens makes an ellipse, because its disc is seen from the side; this is the length of the ellipse across the
    /// direction of the tilt.
    pub fn circle_of_confusion_at(&self, lens: &Lens, point: DVec3, height: u32) -> f64 {
        let (q, depth) = self.frame().film_point(self.eye, point);
        let in_focus = self.focal_plane(lens).inverse_depth(q);
        f64::from(lens.diameter)
            * (in_focus - depth.recip())
            * self.focused(lens).view_distance_pixels(height)
    }
}

impl Frame {
    /// The film point that a point of the scene lies on the centre ray of, as the slopes to the right and upwards, and the
    /// depth of the point.
    fn film_point(&self, eye: DVec3, point: DVec3) -> (DVec2, f64) {
        let depth = self.axial_depth(eye, point);
        (DVec2::new(self.u().dot(point - eye), self.v().dot(point - eye)) / depth, depth)
    }
}
