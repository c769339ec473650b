//! The thin-lens camera: K. Suffern, *Ray Tracing from the Ground Up*, chapter 10. Also the camera that has a hole
//! instead of a lens.

use super::Ray;
use crate::scene::CameraModel;
use crate::settings::Estimator;
use glam::DVec3;

/// The camera's map from a film position and a lens point to a ray.
pub(super) struct Projection {
    eye: DVec3,
    u: DVec3,
    v: DVec3,
    w: DVec3,
    /// Width and height of the film in pixels.
    size: [f64; 2],
    /// Half the film's height at distance one.
    half_height: f64,
    optics: Optics,
}

/// What light passes on its way to the film.
enum Optics {
    Lens {
        radius: f64,
        focal_distance: f64,
    },
    /// A hole with the film behind it.
    Hole {
        radius: f64,
        film_distance: f64,
        upright: bool,
    },
}

impl Projection {
    pub(super) fn new(estimator: &Estimator) -> Self {
        let camera = &estimator.camera;
        // On film at the distance v a lens of the focal length f is in focus at F if 1 / f = 1 / v + 1 / F.
        let half_film = camera.sensor.height_mm / 2000.0 / camera.metres_per_unit;
        let focal_length = half_film / (camera.vfov_radians / 2.0).tan();
        let breathes = camera.focus_breathing && estimator.model == CameraModel::ThinLens;
        let film_distance = if breathes {
            1.0 / (1.0 / focal_length - 1.0 / f64::from(estimator.lens.focal_distance))
        } else {
            focal_length
        };
        let w = (camera.eye - camera.look_at).normalize();
        let u = camera.up.cross(w).normalize();
        Self {
            eye: camera.eye,
            u,
            v: w.cross(u),
            w,
            size: estimator.size.map(f64::from),
            half_height: half_film / film_distance,
            optics: match estimator.model {
                CameraModel::ThinLens => Optics::Lens {
                    radius: f64::from(estimator.lens.diameter) / 2.0,
                    focal_distance: f64::from(estimator.lens.focal_distance),
                },
                CameraModel::Pinhole => Optics::Lens { radius: 0.0, focal_distance: 1.0 },
                CameraModel::Hole => Optics::Hole {
                    radius: f64::from(estimator.hole.diameter) / 2.0,
                    film_distance,
                    upright: estimator.hole.upright,
                },
            },
        }
    }

    /// A film position relative to the picture's centre, y up, in units of the distance to a corner.
    pub(super) fn normalized_film_position(&self, pixel: [u32; 2], offset: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.size;
        let half_diagonal = width.hypot(height) / 2.0;
        let [x, y] = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + offset[axis]);
        [(x - width / 2.0) / half_diagonal, (height / 2.0 - y) / half_diagonal]
    }

    /// The ray from the lens point `disk` (of the unit disk) through the point where the centre ray
    /// of the film position meets the focal plane. Without a lens, the ray goes from the film position
    /// through the point `disk` of the hole, and starts there.
    pub(super) fn primary_ray(&self, pixel: [u32; 2], offset: [f64; 2], disk: [f64; 2], time: f64) -> Ray {
        let [width, height] = self.size;
        let x = f64::from(pixel[0]) + 0.5 + offset[0];
        let y = f64::from(pixel[1]) + 0.5 + offset[1];
        // The view plane at distance one: y from +half_height at the top to -half_height.
        let pixel_size = 2.0 * self.half_height / height;
        let across = (x - width / 2.0) * pixel_size * self.u - (y - height / 2.0) * pixel_size * self.v;
        let on_disk = disk[0] * self.u + disk[1] * self.v;
        match self.optics {
            Optics::Lens { radius, focal_distance } => {
                let focus = self.eye + focal_distance * (across - self.w);
                let origin = self.eye + radius * on_disk;
                Ray { origin, direction: (focus - origin).normalize(), time }
            }
            Optics::Hole { radius, film_distance, upright } => {
                // The hole projects the scene upside down. An upright picture shows each film point on the opposite
                // side of the centre.
                let across = if upright { -across } else { across };
                let film_point = self.eye + film_distance * (across + self.w);
                let origin = self.eye + radius * on_disk;
                Ray { origin, direction: (origin - film_point).normalize(), time }
            }
        }
    }
}
