//! The tables of materials, and the colours of lights, which share their form.

use super::fault::{Fault, fault};
use super::number::{NonNegative, Positive, Rgb};
use crate::scene::{Checker, Material};
use glam::Vec3;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// The tables `[KIND.NAME]` of one kind, by name.
pub(super) type Named<T> = BTreeMap<Spanned<String>, T>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MatteTable {
    color: Color,
    ka: NonNegative,
    kd: NonNegative,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PhongTable {
    color: Color,
    ka: NonNegative,
    kd: NonNegative,
    ks: NonNegative,
    exponent: NonNegative,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MirrorTable {
    color: Rgb,
    kr: NonNegative,
    #[serde(default)]
    ks: NonNegative,
    #[serde(default)]
    exponent: NonNegative,
}

/// What gives off light: `[ambient]` and `[emissive.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightColor {
    #[serde(default = "white")]
    color: Rgb,
    radiance: NonNegative,
}

/// One colour, `[r, g, b]`, or a checker of two, `{ even, odd, size }`.
#[derive(Deserialize)]
#[serde(from = "ColorInput")]
struct Color(Vec3, Option<Checker>);

#[derive(Deserialize)]
#[serde(untagged, expecting = "a color is [r, g, b] or { even = [r, g, b], odd = [r, g, b], size = EDGE }")]
enum ColorInput {
    Plain(Rgb),
    Checker(CheckerTable),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CheckerTable {
    even: Rgb,
    odd: Rgb,
    size: Positive,
}

pub(super) fn white() -> Rgb {
    Rgb(Vec3::ONE)
}

impl From<ColorInput> for Color {
    fn from(input: ColorInput) -> Self {
        match input {
            ColorInput::Plain(color) => Self(color.0, None),
            ColorInput::Checker(checker) => {
                Self(checker.even.0, Some(Checker { size: checker.size.f64(), odd_color: checker.odd.0 }))
            }
        }
    }
}

impl From<MatteTable> for Material {
    fn from(MatteTable { color: Color(color, checker), ka, kd }: MatteTable) -> Self {
        Self { color, checker, ka: ka.0, kd: kd.0, ..Self::default() }
    }
}

impl From<PhongTable> for Material {
    fn from(PhongTable { color, ka, kd, ks, exponent }: PhongTable) -> Self {
        Self { ks: ks.0, exponent: exponent.0, ..MatteTable { color, ka, kd }.into() }
    }
}

impl From<MirrorTable> for Material {
    fn from(MirrorTable { color, kr, ks, exponent }: MirrorTable) -> Self {
        Self { reflectance: color.0 * kr.0, ks: ks.0, exponent: exponent.0, ..Self::default() }
    }
}

impl From<LightColor> for Material {
    fn from(light: LightColor) -> Self {
        Self { emission: light.radiance(), ..Self::default() }
    }
}

impl LightColor {
    pub(super) fn radiance(&self) -> Vec3 {
        self.color.0 * self.radiance.0
    }
}

/// The materials, and the index of each by its name.
#[derive(Default)]
pub(super) struct MaterialList {
    pub(super) materials: Vec<Material>,
    pub(super) names: Vec<String>,
    index: BTreeMap<String, u32>,
}

impl MaterialList {
    /// Adds every material of one kind. A name stands for one material, whatever its kind.
    pub(super) fn add<T: Into<Material>>(&mut self, tables: Named<T>) -> Result<(), Fault> {
        for (name, table) in tables {
            let number = u32::try_from(self.materials.len()).unwrap_or(u32::MAX);
            if self.index.insert(name.get_ref().clone(), number).is_some() {
                let message = format!("there is another material called '{}'", name.get_ref());
                return Err(fault(&name, &message));
            }
            self.materials.push(table.into());
            self.names.push(name.get_ref().clone());
        }
        Ok(())
    }

    pub(super) fn find(&self, name: &Spanned<String>) -> Result<u32, Fault> {
        self.index.get(name.get_ref()).copied().ok_or_else(|| {
            let known: Vec<&str> = self.index.keys().map(String::as_str).collect();
            let message = format!("no material '{}'; there are: {}", name.get_ref(), known.join(", "));
            fault(name, &message)
        })
    }
}
