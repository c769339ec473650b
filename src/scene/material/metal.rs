//! A metal, smooth or rough.

use super::{ADDS_LIGHT, Kind, NEEDS_PATH};
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::Fraction;
use crate::scene::{Integrator, Texture};
use glam::DVec3;
use serde::Deserialize;

/// Reflects its colour at a right angle, and everything at a grazing one, from many small facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metal {
    /// The fraction of light that is reflected at a right angle.
    pub color: Texture,
    /// From 0, a mirror, to 1.
    pub roughness: f32,
}

impl Kind for Metal {
    fn brightest(&self, lights: DVec3, _ambient: DVec3) -> DVec3 {
        lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        let adds_light = (self.color.brightest().max_element() > 1.0).then_some(ADDS_LIGHT);
        (integrator == Integrator::Whitted).then_some(NEEDS_PATH).or(adds_light)
    }
}

/// The table `[metal.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct MetalTable {
    color: TextureTable,
    #[serde(default)]
    roughness: Fraction,
}

impl From<MetalTable> for Metal {
    fn from(table: MetalTable) -> Self {
        Self { color: table.color.into(), roughness: table.roughness.0 }
    }
}
