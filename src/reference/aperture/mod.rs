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
    let p = if model == CameraModel::ThinLens { f64::from(aperture.profile) } else { 0.0 };
    let (point, share) = match aperture.kind(model) {
        ApertureKind::Disc(_) => disc::point(p, xi),
        ApertureKind::Ellipse(_) => ellipse::point(p, xi),
        ApertureKind::Blades(of) => blades::point(&of, p, xi),
        ApertureKind::CatsEye(of) => {
            let (point, share) = cats_eye::point(of, film, xi);
            (point, share * (1.0 + p * (1.0 - 2.0 * (point[0].powi(2) + point[1].powi(2)))))
        }
        ApertureKind::Image(of) => image::point(&of, xi),
    };
    ([half_width * point[0], half_height * point[1]], share)
}

/// The squared distance from the centre, as a share of that of the rim, within which there is this share of the light. At the
/// squared distance `t`, the light is `1 + p (1 - 2 t)` times the mean, so within it there is `t + p t (1 - t)` of it.
fn squared_distance(p: f64, share: f64) -> f64 {
    if p == 0.0 {
        return share;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle + p * middle * (1.0 - middle) < share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
