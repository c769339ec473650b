//! A material that glows, but does not illuminate other surfaces.

use super::Kind;
use crate::scene::toml::number::LightColor;
use glam::{DVec3, Vec3};

/// The radiance of the surface is `radiance`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Emissive {
    /// The radiance in every direction.
    pub radiance: Vec3,
}

impl Kind for Emissive {
    fn brightest(&self, _lights: DVec3, _ambient: DVec3) -> DVec3 {
        self.radiance.as_dvec3()
    }
}

/// The table `[emissive.NAME]`.
pub(in crate::scene) type EmissiveTable = LightColor;

impl From<EmissiveTable> for Emissive {
    fn from(table: EmissiveTable) -> Self {
        Self { radiance: table.radiance() }
    }
}
