//! A disc.

use super::Kind;

/// A disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc;

impl Kind for Disc {
    fn open_share(&self) -> f64 {
        1.0
    }
}
