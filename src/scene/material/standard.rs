//! The material of models, after glTF 2.0.

use super::{Kind, refusal_of_color};
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::Fraction;
use crate::scene::{Integrator, Texture};
use glam::DVec3;
use serde::Deserialize;

/// A mixture of a metal, and of a matte base under a clear coat: the material that glTF calls metallic-roughness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standard {
    /// The fraction of light that the metal reflects at a right angle, and the base in all.
    pub color: Texture,
    /// The share of metal, from 0 to 1.
    pub metallic: f32,
    /// From 0, a mirror, to 1.
    pub roughness: f32,
}

impl Kind for Standard {
    fn brightest(&self, lights: DVec3, _ambient: DVec3) -> DVec3 {
        lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        refusal_of_color(&self.color, integrator)
    }
}

/// The table `[standard.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct StandardTable {
    color: TextureTable,
    #[serde(default)]
    metallic: Fraction,
    #[serde(default)]
    roughness: Fraction,
}

impl From<StandardTable> for Standard {
    fn from(table: StandardTable) -> Self {
        Self { color: table.color.into(), metallic: table.metallic.0, roughness: table.roughness.0 }
    }
}
