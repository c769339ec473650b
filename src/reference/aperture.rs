//! The opening that light comes in through, in f64.

use super::sampler::concentric_disk;
use crate::scene::{Aperture, Mask};
use std::f64::consts::{PI, TAU};

/// A point of the opening, of radius one, for sample values in the unit square; and the share of light that
/// is let in on the way to `film`, which is where the film point lies from the picture's middle as a share of
/// the way to a corner, y up.
pub fn point(aperture: &Aperture, film: [f64; 2], xi: [f64; 2]) -> ([f64; 2], f64) {
    let [half_width, half_height] = aperture.stretch();
    let (point, share) = if let Some(image) = &aperture.image {
        (imaged(image, xi), 1.0)
    } else if aperture.blades > 0 {
        (bladed(aperture, xi), 1.0)
    } else if aperture.cats_eye > 0.0 {
        let off = 2.0 * f64::from(aperture.cats_eye);
        let way = film[0].hypot(film[1]);
        let shorter = if way > 1.0 { way.recip() } else { 1.0 };
        overlap(film.map(|share| -off * share * shorter), xi)
    } else {
        (concentric_disk(xi), 1.0)
    };
    ([half_width * point[0], half_height * point[1]], share)
}

fn polar(radius: f64, angle: f64) -> [f64; 2] {
    [radius * angle.cos(), radius * angle.sin()]
}

/// An iris: from the middle of a blade's edge to its corner, the squared distance is a mixture of that of a
/// straight edge and of a circle.
fn bladed(aperture: &Aperture, xi: [f64; 2]) -> [f64; 2] {
    let (half, round) = (PI / f64::from(aperture.blades), f64::from(aperture.roundness));
    let place = xi[0] * f64::from(aperture.blades);
    let (blade, along) = (place.floor(), 2.0 * place.fract() - 1.0);
    // Areas of both parts between middle and corner, twice over.
    let straight = (1.0 - round) * half.cos().powi(2) * half.tan();
    let share = straight / (straight + round * half);
    let angle = if along.abs() <= share {
        (along.abs() / share * half.tan()).atan()
    } else {
        (along.abs() - share) / (1.0 - share) * half
    };
    let edge = ((1.0 - round) * (half.cos() / angle.cos()).powi(2) + round).sqrt();
    let middle = f64::from(aperture.rotation_degrees).to_radians() + TAU * blade / f64::from(aperture.blades);
    polar(edge * xi[1].sqrt(), middle + angle.copysign(along))
}

/// The overlap of two unit discs, the second one off by so much, and its share of a disc: two caps back to
/// back, each cut into slices of equal area.
fn overlap(off: [f64; 2], xi: [f64; 2]) -> ([f64; 2], f64) {
    let distance = off[0].hypot(off[1]);
    let axis = if distance > 0.0 { off.map(|part| part / distance) } else { [1.0, 0.0] };
    // The area of a unit disc beyond a cut at cos(angle).
    let beyond = |angle: f64| angle - angle.sin() * angle.cos();
    let rims_meet = (distance / 2.0).min(1.0).acos();
    let side = 2.0 * xi[0] - 1.0;
    let wanted = (1.0 - side.abs()) * beyond(rims_meet);
    let (mut low, mut high) = (0.0, rims_meet);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if beyond(middle) < wanted { low = middle } else { high = middle }
    }
    let angle = 0.5 * (low + high);
    let along = if side < 0.0 { distance - angle.cos() } else { angle.cos() };
    let across = (2.0 * xi[1] - 1.0) * angle.sin();
    let point = [along * axis[0] - across * axis[1], along * axis[1] + across * axis[0]];
    (point, 2.0 * beyond(rims_meet) / PI)
}

/// A point of an image, more often where it is brighter: first the row, then the column. The longer side
/// goes from -1 to 1.
fn imaged(mask: &Mask, xi: [f64; 2]) -> [f64; 2] {
    let [columns, rows] = mask.size.map(|cells| cells as usize);
    let row_light = (0..rows)
        .map(|row| mask.cells[row * columns..][..columns].iter().copied().map(f64::from).sum::<f64>());
    let down = place(&row_light.collect::<Vec<_>>(), xi[1]);
    let row = (down as usize).min(rows - 1);
    let light: Vec<f64> = mask.cells[row * columns..][..columns].iter().copied().map(f64::from).collect();
    let across = place(&light, xi[0]);
    let longer = columns.max(rows) as f64;
    [(2.0 * across - columns as f64) / longer, (rows as f64 - 2.0 * down) / longer]
}

/// How many cells lie before the point up to which this share of the light is, with a fraction.
fn place(light: &[f64], share: f64) -> f64 {
    let mut left = share * light.iter().sum::<f64>();
    for (cell, light) in light.iter().enumerate() {
        if left < *light {
            return cell as f64 + left / light;
        }
        left -= light;
    }
    light.len() as f64
}
