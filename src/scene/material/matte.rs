//! A material that reflects light evenly in all directions.

use super::{ADDS_LIGHT, Kind};
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::NonNegative;
use crate::scene::{Integrator, Texture};
use glam::DVec3;
use serde::Deserialize;
use std::f64::consts::FRAC_1_PI;

/// The radiance of the surface is `ka color ambient + sum over lights of kd color / pi * radiance cos`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matte {
    /// The colour.
    pub color: Texture,
    /// The coefficient of ambient reflection.
    pub ka: f32,
    /// The coefficient of diffuse reflection.
    pub kd: f32,
}

impl Kind for Matte {
    fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3 {
        let color = self.color.brightest().as_dvec3();
        f64::from(self.ka) * color * ambient + f64::from(self.kd) * FRAC_1_PI * color * lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        let adds_light = self.kd * self.color.brightest().max_element() > 1.0;
        (integrator == Integrator::Path && adds_light).then_some(ADDS_LIGHT)
    }
}

/// The table `[matte.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct MatteTable {
    color: TextureTable,
    ka: Option<NonNegative>,
    kd: Option<NonNegative>,
}

impl From<MatteTable> for Matte {
    fn from(table: MatteTable) -> Self {
        let kd = table.kd.map_or(1.0, |kd| kd.0);
        Self { color: table.color.into(), ka: table.ka.map_or(kd, |ka| ka.0), kd }
    }
}
