//! Matte, with a highlight.

use super::{Kind, Matte};
use crate::scene::Texture;
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::NonNegative;
use glam::DVec3;
use serde::Deserialize;

/// Radiance = [`Matte`]'s + `sum over lights of ks (r . view)^exponent * radiance cos`, for the direction `r` of the
/// mirrored light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phong {
    /// Its colour; the highlight has the light's.
    pub color: Texture,
    /// Ambient reflection.
    pub ka: f32,
    /// Diffuse reflection.
    pub kd: f32,
    /// Specular reflection.
    pub ks: f32,
    /// The larger, the smaller is the highlight.
    pub exponent: f32,
}

impl Phong {
    /// What it is without the highlight.
    pub fn matte(&self) -> Matte {
        Matte { color: self.color, ka: self.ka, kd: self.kd }
    }
}

impl Kind for Phong {
    fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3 {
        self.matte().brightest(lights, ambient) + f64::from(self.ks) * lights
    }
}

/// `[phong.NAME]`.
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
