//! The oracle: the renderer a second time, in f64, on the CPU, one sample at a time, written from the mathematics. It
//! shares the scene and the settings with the GPU's renderer and nothing else: no shader struct, no device, no derived
//! constant. So it cannot inherit a mistake from any of these.
//!
//! The sample values are the same as on the GPU, bit for bit. The arithmetic is f64 instead of f32, and the formulas
//! are those of textbooks instead of rearranged ones. So the oracle may disagree with the GPU next to edges, where
//! rounding decides what a ray hits.

pub mod aperture;
mod camera;
pub mod film;
pub mod integrator;
pub mod intersect;
mod light;
mod material;
pub mod sampler;
pub mod shape;
mod surface;
mod texture;
pub mod tone;

use crate::scene::CameraModel;
use crate::settings::Estimator;
use camera::Projection;
use film::Film;
use glam::DVec3;
use integrator::Limits;

/// The colour for which a lens is in focus, by its number.
const GREEN: usize = 1;

/// A half-line from a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The point where the ray starts.
    pub origin: DVec3,
    /// The direction, of unit length.
    pub direction: DVec3,
    /// The time at which light travels along the ray, in seconds from the middle of the exposure.
    pub time: f64,
}

/// One sample of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The primary ray.
    pub ray: Ray,
    /// The film position relative to the start pixel's centre, in pixels, x right and y down.
    pub offset: [f64; 2],
    /// The radiance along the primary ray.
    pub radiance: DVec3,
}

/// The oracle for one estimator.
pub struct Reference<'a> {
    estimator: &'a Estimator,
    projection: Projection,
}

impl<'a> Reference<'a> {
    /// The oracle for a picture with these settings.
    pub fn new(estimator: &'a Estimator) -> Self {
        Self { estimator, projection: Projection::new(estimator) }
    }

    /// The sample of this start pixel and sample index.
    pub fn sample(&self, pixel: [u32; 2], index: u32) -> Sample {
        let xi = sampler::sample_values(self.estimator.sampler, self.estimator.seed, pixel, index, 0);
        let jitter = f64::from(self.estimator.jitter);
        let offset = [(xi[0] - 0.5) * jitter, (xi[1] - 0.5) * jitter];
        let estimator = self.estimator;
        let lens = [xi[2], xi[3]];
        let film = self.projection.normalized_film_position(pixel, offset);
        let (point, share) = aperture::point(&estimator.aperture, estimator.model, film, lens);
        let time = if estimator.scene.moves() {
            let open = sampler::time_value(estimator.sampler, estimator.seed, pixel, index);
            (open - 0.5) * f64::from(estimator.shutter)
        } else {
            0.0
        };
        let Estimator { scene, sampler, seed, .. } = estimator;
        let values = |bounce, of| sampler::path_values(*sampler, *seed, pixel, index, bounce, of);
        let limits = Limits::of(estimator);
        let ray = |color: usize| self.projection.primary_ray(pixel, offset, point, time, color);
        let radiance = |ray: Ray| integrator::radiance(scene, ray, &limits, &values);
        let has_colors = estimator.model == CameraModel::ThinLens && estimator.lens.abbe_number > 0;
        let seen = if has_colors {
            // Each colour goes its own way.
            let of = |color: usize| radiance(ray(color))[color];
            DVec3::new(of(0), of(1), of(2))
        } else {
            radiance(ray(GREEN))
        };
        Sample { ray: ray(GREEN), offset, radiance: share * seen }
    }

    /// The primary ray through the film position at `offset` pixels from this pixel's centre and through the point `disk`
    /// of the lens, whose radius is one. `time` is in seconds from the middle of the exposure.
    pub fn primary_ray(&self, pixel: [u32; 2], offset: [f64; 2], disk: [f64; 2], time: f64) -> Ray {
        self.projection.primary_ray(pixel, offset, disk, time, GREEN)
    }

    /// The film after samples `0 .. count` of every pixel: mean r, g, b and count, row by row from
    /// the top left.
    pub fn render(&self, count: u32) -> Vec<[f64; 4]> {
        let mut film = Film::new(self.estimator.size);
        (0..count).for_each(|index| self.add_sample(&mut film, index));
        film.texels().to_vec()
    }

    /// Adds the sample `index` of every pixel to a film.
    pub fn add_sample(&self, film: &mut Film, index: u32) {
        let [width, height] = self.estimator.size;
        for pixel in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
            let sample = self.sample(pixel, index);
            film.add(pixel, sample.offset, sample.radiance);
        }
    }
}
