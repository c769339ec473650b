//! A clear coat over a matte base.

use super::{Kind, refusal_of_color};
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::{Fraction, RefractiveIndex};
use crate::scene::{Integrator, Texture};
use glam::DVec3;
use serde::Deserialize;

/// A clear coat, which reflects a small part of the light, over a base that scatters evenly what gets through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plastic {
    /// The fraction of light that the base reflects.
    pub color: Texture,
    /// The refractive index of the coat.
    pub index: f32,
    /// That of the coat, from 0, a mirror, to 1.
    pub roughness: f32,
}

impl Kind for Plastic {
    fn brightest(&self, lights: DVec3, _ambient: DVec3) -> DVec3 {
        lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        refusal_of_color(&self.color, integrator)
    }
}

/// The table `[plastic.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct PlasticTable {
    color: TextureTable,
    #[serde(default)]
    index: RefractiveIndex,
    #[serde(default)]
    roughness: Fraction,
}

impl From<PlasticTable> for Plastic {
    fn from(table: PlasticTable) -> Self {
        Self { color: table.color.into(), index: table.index.0, roughness: table.roughness.0 }
    }
}
