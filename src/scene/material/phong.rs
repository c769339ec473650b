//! A matte material with a highlight.

use super::{HAS_HIGHLIGHT, Kind, Matte};
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::NonNegative;
use crate::scene::{Integrator, Texture};
use glam::DVec3;
use serde::Deserialize;

/// The radiance of the surface is that of [`Matte`] plus `sum over lights of ks (r . view)^exponent * radiance cos`.
/// Here `r` is the direction of the reflected light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phong {
    /// The colour. The highlight has the colour of the light.
    pub color: Texture,
    /// The coefficient of ambient reflection.
    pub ka: f32,
    /// The coefficient of diffuse reflection.
    pub kd: f32,
    /// The coefficient of specular reflection.
    pub ks: f32,
    /// The exponent of the highlight: a larger one makes it smaller.
    pub exponent: f32,
}

impl Phong {
    /// The same material without the highlight.
    pub fn matte(&self) -> Matte {
        Matte { color: self.color, ka: self.ka, kd: self.kd }
    }
}

impl Kind for Phong {
    fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3 {
        self.matte().brightest(lights, ambient) + f64::from(self.ks) * lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        (integrator == Integrator::Path).then_some(HAS_HIGHLIGHT)
    }
}

/// The table `[phong.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct PhongTable {
    color: TextureTable,
    ka: NonNegative,
    kd: NonNegative,
    ks: NonNegative,
    exponent: NonNegative,
}

impl From<PhongTable> for Phong {
    fn from(PhongTable { color, ka, kd, ks, exponent }: PhongTable) -> Self {
        Self { color: color.into(), ka: ka.0, kd: kd.0, ks: ks.0, exponent: exponent.0 }
    }
}
