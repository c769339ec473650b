//! An ellipse.

use super::{Kind, Opening};

/// An ellipse: a disc that [`super::Aperture::stretch`] makes narrower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipse;

impl Kind for Ellipse {
    fn relative_area(&self) -> f64 {
        1.0
    }

    fn openings(&self, _film: [f64; 2]) -> Vec<Opening> {
        Opening::around([0.0; 2], 0.0, |_| 1.0)
    }
}
