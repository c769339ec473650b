//! Light from a point.

use super::{Light, LightKind, LightTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{NonNegative, Rgb, Vector, white, yes};
use glam::DVec3;
use serde::Deserialize;

/// Light from a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// The position of the light.
    pub position: DVec3,
}

/// The table `[[point]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct PointTable {
    position: Vector,
    #[serde(default = "white")]
    color: Rgb,
    radiance: NonNegative,
    #[serde(default = "yes")]
    shadows: bool,
}

impl LightTable for PointTable {
    fn light(&self) -> Result<Light, ParseError> {
        Ok(Light {
            kind: LightKind::Point(PointLight { position: self.position.0 }),
            radiance: self.color.0 * self.radiance.0,
            shadows: self.shadows,
        })
    }
}
