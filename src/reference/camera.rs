//! The thin-lens camera: K. Suffern, *Ray Tracing from the Ground Up*, chapter 10.

use super::Ray;
use crate::settings::Estimator;
use glam::DVec3;

/// What the camera makes of a film position.
pub(super) struct Projection {
    eye: DVec3,
    u: DVec3,
    v: DVec3,
    w: DVec3,
    /// Width and height of the film in pixels.
    size: [f64; 2],
    /// Half the film's height at distance one.
    half_height: f64,
    lens_radius: f64,
    focal_distance: f64,
}

impl Projection {
    pub(super) fn new(estimator: &Estimator) -> Self {
        let camera = &estimator.camera;
        let w = (camera.eye.as_dvec3() - camera.look_at.as_dvec3()).normalize();
        let u = camera.up.as_dvec3().cross(w).normalize();
        Self {
            eye: camera.eye.as_dvec3(),
            u,
            v: w.cross(u),
            w,
            size: estimator.size.map(f64::from),
            half_height: (camera.vfov_radians / 2.0).tan(),
            lens_radius: f64::from(estimator.lens.diameter) / 2.0,
            focal_distance: f64::from(estimator.lens.focal_distance),
        }
    }

    /// The ray from the lens point `disk` (of the unit disk) through the point where the centre ray
    /// of the film position meets the focal plane.
    pub(super) fn primary_ray(&self, pixel: [u32; 2], offset: [f64; 2], disk: [f64; 2]) -> Ray {
        let [width, height] = self.size;
        let x = f64::from(pixel[0]) + 0.5 + offset[0];
        let y = f64::from(pixel[1]) + 0.5 + offset[1];
        // The view plane at distance one: y from +half_height at the top to -half_height.
        let pixel_size = 2.0 * self.half_height / height;
        let centre_ray =
            (x - width / 2.0) * pixel_size * self.u - (y - height / 2.0) * pixel_size * self.v - self.w;
        let focus = self.eye + self.focal_distance * centre_ray;
        let origin = self.eye + self.lens_radius * (disk[0] * self.u + disk[1] * self.v);
        Ray { origin, direction: (focus - origin).normalize() }
    }
}
