//! The oracle: the renderer again, in f64, on the CPU, one sample at a time, written from the
//! mathematics. It shares the scene and the settings with the GPU's renderer and nothing else: no
//! shader struct, no device, no derived constant, so that it cannot inherit a mistake of theirs.
//!
//! Same: the sample values, bit for bit. Different: f64 instead of f32, textbook formulas instead of
//! rearranged ones, and so a different answer next to edges, where rounding decides what a ray hits.

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

use crate::settings::Estimator;
use camera::Projection;
use film::Film;
use glam::DVec3;

/// A half-line from a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit length.
    pub direction: DVec3,
    /// When light goes along it, in seconds from the middle of the exposure.
    pub time: f64,
}

/// One sample of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The primary ray.
    pub ray: Ray,
    /// Where the film position lies from the start pixel's centre, in pixels, x right and y down.
    pub offset: [f64; 2],
    /// Radiance along the primary ray.
    pub radiance: DVec3,
}

/// The oracle for one estimator.
pub struct Reference<'a> {
    estimator: &'a Estimator,
    projection: Projection,
}

impl<'a> Reference<'a> {
    /// For a picture of these settings.
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
        let film = self.projection.way_to_corner(pixel, offset);
        let (point, share) = aperture::point(&estimator.aperture, estimator.model, film, lens);
        let time = if estimator.scene.moves() {
            let open = sampler::time_value(estimator.sampler, estimator.seed, pixel, index);
            (open - 0.5) * f64::from(estimator.shutter)
        } else {
            0.0
        };
        let sample = self.trace(pixel, offset, point, time);
        Sample { radiance: share * sample.radiance, ..sample }
    }

    /// The sample of a film position, `offset` pixels from this pixel's centre, and a point of the
    /// lens, whose radius is one, so many seconds from the middle of the exposure.
    pub fn trace(&self, pixel: [u32; 2], offset: [f64; 2], disk: [f64; 2], time: f64) -> Sample {
        let ray = self.projection.primary_ray(pixel, offset, disk, time);
        let scene = &*self.estimator.scene;
        let radiance = integrator::whitted::radiance(scene, ray, self.estimator.max_bounces);
        Sample { ray, offset, radiance }
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
