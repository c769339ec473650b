//! A checker in three dimensions: Suffern's.

use super::Kind;
use crate::scene::toml::number::{Positive, Rgb};
use glam::Vec3;
use serde::Deserialize;

/// A checker in three dimensions. A surface on the boundary of two layers of cells belongs to the lower one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checker {
    /// The colour where `floor(x / size) + floor(y / size) + floor(z / size)` is even.
    pub even: Vec3,
    /// The colour where it is odd.
    pub odd: Vec3,
    /// Edge of a cell, in scene units.
    pub size: f64,
}

impl Kind for Checker {
    fn brightest(&self) -> Vec3 {
        self.even.max(self.odd)
    }
}

/// `{ even, odd, size }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct CheckerTable {
    even: Rgb,
    odd: Rgb,
    size: Positive,
}

impl From<CheckerTable> for Checker {
    fn from(table: CheckerTable) -> Self {
        Self { even: table.even.0, odd: table.odd.0, size: table.size.f64() }
    }
}
