//! The opening that light comes in through: a file a kind, with the name of its shader in `shaders/aperture`.

mod blades;
mod cats_eye;
mod disc;
mod ellipse;
mod image;

use crate::scene::{Aperture, ApertureKind, CameraModel};

/// A point of the opening, of radius one, for sample values in the unit square; and the share of light that
/// is let in on the way to `film`, which is where the film point lies from the picture's middle as a share of
/// the way to a corner, y up.
pub fn point(aperture: &Aperture, model: CameraModel, film: [f64; 2], xi: [f64; 2]) -> ([f64; 2], f64) {
    let [half_width, half_height] = aperture.stretch();
    let (point, share) = match aperture.kind(model) {
        ApertureKind::Disc(_) => disc::point(xi),
        ApertureKind::Ellipse(_) => ellipse::point(xi),
        ApertureKind::Blades(of) => blades::point(&of, xi),
        ApertureKind::CatsEye(of) => cats_eye::point(of, film, xi),
        ApertureKind::Image(of) => image::point(&of, xi),
    };
    ([half_width * point[0], half_height * point[1]], share)
}
