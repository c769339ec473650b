//! A clear body, smooth or frosted.

use super::{ADDS_LIGHT, Kind, NEEDS_PATH};
use crate::scene::Integrator;
use crate::scene::toml::number::{Fraction, Positive, RefractiveIndex, Rgb, white};
use glam::{DVec3, Vec3};
use serde::Deserialize;

/// Reflects and refracts light at its surface, and absorbs light inside. The normals of its shapes point out of the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glass {
    /// The refractive index.
    pub index: f32,
    /// From 0, clear, to 1, frosted.
    pub roughness: f32,
    /// The share of light that is left after [`Self::color_distance`].
    pub color: Vec3,
    /// In scene units.
    pub color_distance: f32,
}

impl Glass {
    /// The absorption per scene unit, by Beer's law: after the distance `d`, the share `exp(-absorption d)` is left.
    pub fn absorption(&self) -> Vec3 {
        // Nothing is left of what is this dark, and the logarithm of 0 is infinite.
        let darkest = Vec3::splat(1e-6);
        -self.color.max(darkest).map(f32::ln) / self.color_distance
    }
}

impl Kind for Glass {
    fn brightest(&self, lights: DVec3, _ambient: DVec3) -> DVec3 {
        lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        let adds_light = (self.color.max_element() > 1.0).then_some(ADDS_LIGHT);
        (integrator == Integrator::Whitted).then_some(NEEDS_PATH).or(adds_light)
    }
}

/// The table `[glass.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct GlassTable {
    #[serde(default)]
    index: RefractiveIndex,
    #[serde(default)]
    roughness: Fraction,
    #[serde(default = "white")]
    color: Rgb,
    color_distance: Option<Positive>,
}

impl From<GlassTable> for Glass {
    fn from(table: GlassTable) -> Self {
        Self {
            index: table.index.0,
            roughness: table.roughness.0,
            color: table.color.0,
            color_distance: table.color_distance.map_or(1.0, |distance| distance.f32()),
        }
    }
}
