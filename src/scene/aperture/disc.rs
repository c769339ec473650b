//! A disc.

use super::Kind;

/// A disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc;

impl Kind for Disc {
    fn relative_area(&self) -> f64 {
        1.0
    }
}
