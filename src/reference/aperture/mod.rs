//! The aperture, through which light comes in. Each kind is a file with the name of its shader in `shaders/aperture`.

mod blades;
mod cats_eye;
mod disc;
mod ellipse;
mod image;

use crate::scene::{Aperture, ApertureKind, CameraModel};

/// Maps sample values in the unit square to a point of the aperture, whose radius is one. Also returns the share of the
/// light through this point that reaches the film point `film`, which is given relative to the picture's centre, y up,
/// in units of the distance to a corner.
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
