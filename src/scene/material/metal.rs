//! A metal, smooth or rough.

use super::{Kind, refusal_of_color};
use crate::scene::texture::TextureTable;
use crate::scene::toml::number::Fraction;
use crate::scene::{Integrator, Texture};
use glam::{DVec3, Vec3};
use serde::Deserialize;

/// Reflects its colour at a right angle, and everything at a grazing one, from many small facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metal {
    /// The fraction of light that is reflected at a right angle.
    pub color: Texture,
    /// From 0, a mirror, to 1.
    pub roughness: f32,
}

/// What pure metals reflect at a right angle, linear r, g, b: S. Lagarde, "Feeding a Physically Based Shading Model", 2011,
/// from measured refractive indices; iron from T. Akenine-Möller, E. Haines and N. Hoffman, "Real-Time Rendering".
const MEASURED: [(&str, Vec3); 10] = [
    ("aluminium", Vec3::new(0.913, 0.921, 0.925)),
    ("chromium", Vec3::new(0.550, 0.556, 0.554)),
    ("cobalt", Vec3::new(0.662, 0.655, 0.634)),
    ("copper", Vec3::new(0.955, 0.637, 0.538)),
    ("gold", Vec3::new(1.0, 0.766, 0.336)),
    ("iron", Vec3::new(0.56, 0.57, 0.58)),
    ("nickel", Vec3::new(0.660, 0.609, 0.526)),
    ("platinum", Vec3::new(0.672, 0.637, 0.585)),
    ("silver", Vec3::new(0.972, 0.960, 0.915)),
    ("titanium", Vec3::new(0.542, 0.497, 0.449)),
];

impl Kind for Metal {
    fn brightest(&self, lights: DVec3, _ambient: DVec3) -> DVec3 {
        lights
    }

    fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
        refusal_of_color(&self.color, integrator)
    }
}

/// The table `[metal.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct MetalTable {
    color: MetalColor,
    #[serde(default)]
    roughness: Fraction,
}

#[derive(Deserialize)]
#[serde(try_from = "NameOrTexture")]
struct MetalColor(Texture);

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a metal's color is a name such as \"gold\", [r, g, b] or { even = [r, g, b], odd = [r, g, b], size = EDGE }"
)]
enum NameOrTexture {
    Name(String),
    Texture(TextureTable),
}

impl TryFrom<NameOrTexture> for MetalColor {
    type Error = String;

    fn try_from(value: NameOrTexture) -> Result<Self, String> {
        let name = match value {
            NameOrTexture::Texture(table) => return Ok(Self(table.into())),
            NameOrTexture::Name(name) => name,
        };
        let measured = MEASURED.iter().find(|(known, _)| *known == name);
        measured.map(|(_, color)| Self(Texture::constant(*color))).ok_or_else(|| {
            let known: Vec<&str> = MEASURED.iter().map(|(known, _)| *known).collect();
            format!("is '{name}', which is not known; there are: {}", known.join(", "))
        })
    }
}

impl From<MetalTable> for Metal {
    fn from(table: MetalTable) -> Self {
        Self { color: table.color.0, roughness: table.roughness.0 }
    }
}
