//! One colour everywhere.

use super::Kind;
use crate::scene::toml::number::Rgb;
use glam::Vec3;
use serde::Deserialize;

/// One colour everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    /// The colour.
    pub color: Vec3,
}

impl Kind for Constant {
    fn brightest(&self) -> Vec3 {
        self.color
    }
}

/// `[r, g, b]`.
#[derive(Deserialize)]
#[serde(transparent)]
pub(in crate::scene) struct ConstantTable(Rgb);

impl From<ConstantTable> for Constant {
    fn from(ConstantTable(color): ConstantTable) -> Self {
        Self { color: color.0 }
    }
}
