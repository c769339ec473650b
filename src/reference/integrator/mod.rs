//! The radiance along rays, by each of the integrators. Each is a file with the name of its shader.

mod path;
pub mod whitted;

use super::Ray;
use crate::scene::{Integrator, Scene};
use crate::settings::Estimator;
use glam::DVec3;

/// How the radiance along a ray is found.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// What finds the radiance.
    pub integrator: Integrator,
    /// How often light is scattered.
    pub max_bounces: u32,
    /// How often light is scattered by surfaces that spread it.
    pub diffuse_bounces: u32,
    /// The most luminance of what is found after the first surface; infinite for no limit.
    pub most_indirect: f64,
}

impl Limits {
    /// Those of an estimator.
    pub fn of(estimator: &Estimator) -> Self {
        let Estimator { integrator, max_bounces, diffuse_bounces, clamp, .. } = *estimator;
        let most_indirect = if clamp > 0.0 { half::f16::from_f32(clamp).into() } else { f64::INFINITY };
        Self { integrator, max_bounces, diffuse_bounces, most_indirect }
    }
}

/// The sample values of a path: four values in [0, 1) for a bounce and a use.
pub type PathValues<'a> = &'a dyn Fn(u32, super::sampler::Use) -> [f64; 4];

/// The radiance that arrives along `ray`.
pub fn radiance(scene: &Scene, ray: Ray, limits: &Limits, values: PathValues<'_>) -> DVec3 {
    match limits.integrator {
        Integrator::Whitted => whitted::radiance(scene, ray, limits.max_bounces),
        Integrator::Path => path::radiance(scene, ray, limits, values),
    }
}

/// A further ray ignores hits that are nearer than this, relative to the coordinates of its origin. It is the rounding
/// error of f64 with room to spare.
const MIN_DISTANCE: f64 = 1e-10;
