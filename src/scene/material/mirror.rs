//! A mirror, which can have highlights.

use super::{ADDS_LIGHT, HAS_HIGHLIGHT, Kind};
use crate::scene::Integrator;
use crate::scene::toml::number::{NonNegative, Rgb};
use glam::{DVec3, Vec3};
use serde::Deserialize;

/// The radiance of the surface is `reflectance * mirror image + sum over lights of ks (r . view)^exponent * radiance
/// cos`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mirror {
    /// The fraction of light that is reflected as in a mirror.
    pub reflectance: Vec3,
    /// The coefficient of specular reflection of lights.
    pub ks: f32,
    /// The exponent of the highlights: a larger one makes them smaller.
    pub exponent: f32,
}

impl Kind for Mirror {
    fn brightest(&self, lights: DVec3, _ambient: DVec3) -> DVec3 {
        f64::from(self.ks) * lights
    }

    fn reflectance(&self) -> Vec3 {
        self.reflectance
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        if integrator == Integrator::Whitted {
            return None;
        }
        let adds_light = (self.reflectance.max_element() > 1.0).then_some(ADDS_LIGHT);
        (self.ks != 0.0).then_some(HAS_HIGHLIGHT).or(adds_light)
    }
}

/// The table `[mirror.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct MirrorTable {
    color: Rgb,
    kr: NonNegative,
    #[serde(default)]
    ks: NonNegative,
    #[serde(default)]
    exponent: NonNegative,
}

impl From<MirrorTable> for Mirror {
    fn from(MirrorTable { color, kr, ks, exponent }: MirrorTable) -> Self {
        Self { reflectance: color.0 * kr.0, ks: ks.0, exponent: exponent.0 }
    }
}
