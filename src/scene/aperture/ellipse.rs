//! An ellipse.

use super::Kind;

/// An ellipse: a disc that [`super::Aperture::stretch`] makes narrower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipse;

impl Kind for Ellipse {
    fn relative_area(&self) -> f64 {
        1.0
    }
}
