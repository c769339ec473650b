//! Gives off light, but lights nothing else.

use super::Kind;
use crate::scene::toml::number::LightColor;
use glam::{DVec3, Vec3};

/// Radiance = `radiance`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Emissive {
    /// What it gives off into every direction.
    pub radiance: Vec3,
}

impl Kind for Emissive {
    fn brightest(&self, _lights: DVec3, _ambient: DVec3) -> DVec3 {
        self.radiance.as_dvec3()
    }
}

/// `[emissive.NAME]`.
pub(in crate::scene) type EmissiveTable = LightColor;

impl From<EmissiveTable> for Emissive {
    fn from(table: EmissiveTable) -> Self {
        Self { radiance: table.radiance() }
    }
}
