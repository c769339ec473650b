//! The thin-lens camera: K. Suffern, *Ray Tracing from the Ground Up*, chapter 10, here by the equation of the thin lens
//! along the axis of the lens, which may be tilted. Also the camera that has a hole instead of a lens.

use super::Ray;
use crate::scene::{CameraModel, Hole};
use crate::settings::Estimator;
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

/// The camera's map from a film position and a lens point to a ray.
pub(super) struct Projection {
    eye: DVec3,
    u: DVec3,
    v: DVec3,
    w: DVec3,
    /// Width and height of the film in pixels.
    size: [f64; 2],
    /// The length of a pixel on the film, in scene units.
    pixel: f64,
    film_distance: f64,
    /// How far the middle of the film is shifted against the lens, to the right and upwards in the picture.
    shift: [f64; 2],
    optics: Optics,
}

/// What light passes on its way to the film.
enum Optics {
    Lens {
        radius: f64,
        focal_length: f64,
        /// The axis of the lens, forwards.
        axis: DVec3,
        /// By how much larger `1 / f` is for each of the three colours.
        more: [f64; 3],
    },
    Pinhole,
    /// A hole with the film behind it.
    Hole {
        radius: f64,
        upright: bool,
    },
}

impl Projection {
    pub(super) fn new(estimator: &Estimator) -> Self {
        let camera = &estimator.camera;
        let [mm, degrees] = [1000.0 * camera.metres_per_unit, 180.0 / PI];
        let w = (camera.eye - camera.look_at).normalize();
        let u = camera.up.cross(w).normalize();
        let v = w.cross(u);
        let half_film = camera.sensor.height_mm / 2.0 / mm;
        let at_infinity = half_film / (camera.vfov_radians / 2.0).tan();
        let lens = &estimator.lens;
        let (film_distance, optics) = match estimator.model {
            CameraModel::ThinLens => {
                // First about the horizontal axis, then in the direction of the tilt.
                let [tilt, direction] =
                    [lens.tilt_degrees, lens.tilt_direction_degrees].map(|angle| f64::from(angle) / degrees);
                let tilted = DQuat::from_axis_angle(w, direction) * DQuat::from_axis_angle(u, -tilt);
                let axis = tilted * -w;
                // Along the axis of the lens, 1 / f = 1 / v + 1 / F.
                let slant = axis.dot(-w);
                let focused = f64::from(lens.focal_distance) * slant;
                let (film_distance, focal_length) = if camera.focus_breathing {
                    ((1.0 / at_infinity - 1.0 / focused).recip() / slant, at_infinity)
                } else {
                    (at_infinity, (1.0 / (at_infinity * slant) + 1.0 / focused).recip())
                };
                (
                    film_distance,
                    Optics::Lens {
                        radius: f64::from(lens.diameter) / 2.0,
                        focal_length,
                        axis,
                        more: colors(lens.abbe_number),
                    },
                )
            }
            CameraModel::Pinhole => (at_infinity, Optics::Pinhole),
            CameraModel::Hole => {
                let Hole { diameter, upright } = estimator.hole;
                (at_infinity, Optics::Hole { radius: f64::from(diameter) / 2.0, upright })
            }
        };
        Self {
            eye: camera.eye,
            u,
            v,
            w,
            size: estimator.size.map(f64::from),
            pixel: 2.0 * half_film / f64::from(estimator.size[1]),
            film_distance,
            shift: camera.lens_shift_mm.map(|shift| f64::from(shift) / mm),
            optics,
        }
    }

    /// A film position relative to the point where the axis of the lens meets the film, y up, in units of the distance from
    /// the picture's middle to a corner.
    pub(super) fn normalized_film_position(&self, pixel: [u32; 2], offset: [f64; 2]) -> [f64; 2] {
        let half_diagonal = self.pixel * self.size[0].hypot(self.size[1]) / 2.0;
        let axis = match self.optics {
            Optics::Lens { axis, .. } => self.film_distance / axis.dot(-self.w) * axis,
            Optics::Pinhole | Optics::Hole { .. } => DVec3::ZERO,
        };
        let [x, y] = self.on_film(pixel, offset);
        [(x - axis.dot(self.u)) / half_diagonal, (y - axis.dot(self.v)) / half_diagonal]
    }

    /// How far a film position is from the point behind the centre of the lens, to the right and upwards in a picture that
    /// stands upright, in scene units.
    fn on_film(&self, pixel: [u32; 2], offset: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.size;
        let [x, y] = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + offset[axis]);
        // The picture of a hole that is not turned upright shows each film point on the opposite side of the centre.
        let side = if matches!(self.optics, Optics::Hole { upright: false, .. }) { -1.0 } else { 1.0 };
        let [right, up] = [x - width / 2.0, height / 2.0 - y].map(|pixels| side * pixels * self.pixel);
        [right + self.shift[0], up + self.shift[1]]
    }

    /// The ray from the lens point `disk` (of the unit disk) through the point that the film position is an image of.
    /// Without a lens, the ray goes from the film position through the point `disk` of the hole, and starts there.
    ///
    /// `color` is the number of the colour of the light: red, green or blue.
    pub(super) fn primary_ray(
        &self,
        pixel: [u32; 2],
        offset: [f64; 2],
        disk: [f64; 2],
        time: f64,
        color: usize,
    ) -> Ray {
        let [right, up] = self.on_film(pixel, offset);
        // From the film position to the centre of the lens. The image is upside down.
        let through_centre = right * self.u + up * self.v - self.film_distance * self.w;
        let (from_centre, direction) = match self.optics {
            Optics::Pinhole => (DVec3::ZERO, through_centre),
            Optics::Lens { radius, focal_length, axis, more } => {
                let turn = DQuat::from_rotation_arc(-self.w, axis);
                let lens_point = radius * (disk[0] * (turn * self.u) + disk[1] * (turn * self.v));
                // 1 / f = 1 / v + 1 / F, with distances along the axis. The point in focus lies on the line through the
                // centre, as far as 1 / F says, which is negative if the lens makes the light from the film diverge.
                let on_film = axis.dot(through_centre).recip();
                let in_focus = (1.0 + more[color]) / focal_length - on_film;
                (lens_point, on_film * through_centre - in_focus * lens_point)
            }
            Optics::Hole { radius, .. } => {
                let point = radius * (disk[0] * self.u + disk[1] * self.v);
                (point, point + through_centre)
            }
        };
        Ray { origin: self.eye + from_centre, direction: direction.normalize(), time }
    }
}

/// By how much larger `1 / f` is for red, green and blue light than for green light. `1 / f` is proportional to `n - 1` of
/// the glass, and by Cauchy's formula `n` is linear in one over the squared wavelength. Between the lines F and C of hydrogen,
/// it changes by one over the Abbe number.
fn colors(abbe_number: u32) -> [f64; 3] {
    if abbe_number == 0 {
        return [0.0; 3];
    }
    let index = |nanometres: f64| nanometres.powi(-2);
    let of_abbe_number = index(486.1) - index(656.3);
    let change = |nanometres: f64| (index(nanometres) - index(550.0)) / of_abbe_number;
    [610.0, 550.0, 465.0].map(|nanometres| change(nanometres) / f64::from(abbe_number))
}
