//! Light along parallel lines.

use super::{Light, LightKind, LightTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{NonNegative, Rgb, Vector, nonzero, white, yes};
use glam::Vec3;
use serde::Deserialize;
use toml::Spanned;

/// Light along parallel lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionalLight {
    /// The direction towards the light, of any length but zero.
    pub direction: Vec3,
}

/// The table `[[directional]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct DirectionalTable {
    direction: Spanned<Vector>,
    #[serde(default = "white")]
    color: Rgb,
    radiance: NonNegative,
    #[serde(default = "yes")]
    shadows: bool,
}

impl LightTable for DirectionalTable {
    fn light(&self) -> Result<Light, ParseError> {
        Ok(Light {
            kind: LightKind::Directional(DirectionalLight { direction: nonzero(&self.direction)? }),
            radiance: self.color.0 * self.radiance.0,
            shadows: self.shadows,
        })
    }
}
