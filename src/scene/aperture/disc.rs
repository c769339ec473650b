//! A disc.

use super::{Kind, Opening};

/// A disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApertureDisc;

impl Kind for ApertureDisc {
    fn relative_area(&self) -> f64 {
        1.0
    }

    fn openings(&self, _film: [f64; 2]) -> Vec<Opening> {
        Opening::around([0.0; 2], 0.0, |_| 1.0)
    }
}
