//! The sky as a source of light. The light of an image is sampled: Pharr, Jakob and Humphreys, "Physically Based Rendering",
//! 4th edition, section 12.5.

use super::background;
use crate::scene::{Background, Panorama};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The radiance along a ray that has this direction and meets no surface.
pub(in crate::reference) fn radiance(sky: &Background, direction: DVec3) -> DVec3 {
    match sky {
        Background::Gradient(gradient) => background::radiance(gradient, direction),
        Background::Panorama(panorama) => of_panorama(panorama, direction),
    }
}

/// The place of a direction in the image, in texels from the top left corner.
fn place(of: &Panorama, direction: DVec3) -> DVec2 {
    let turned = f64::from(of.turn_degrees) / 360.0;
    let longitude = 0.5 + direction.x.atan2(-direction.z) / TAU + turned;
    let latitude = direction.y.clamp(-1.0, 1.0).acos() / PI;
    let [width, height] = of.image.size.map(f64::from);
    DVec2::new(longitude.rem_euclid(1.0) * width, latitude * height)
}

/// Linear between the centres of the texels.
fn of_panorama(of: &Panorama, direction: DVec3) -> DVec3 {
    let [width, height] = of.image.size.map(i64::from);
    let place = place(of, direction) - 0.5;
    let corner = place.floor();
    let share = place - corner;
    let color = |right: i64, down: i64| {
        let x = (corner.x as i64 + right).rem_euclid(width);
        let y = (corner.y as i64 + down).clamp(0, height - 1);
        of.image.color([x as u32, y as u32])
    };
    let upper = color(0, 0).lerp(color(1, 0), share.x);
    let lower = color(0, 1).lerp(color(1, 1), share.x);
    f64::from(of.radiance) * upper.lerp(lower, share.y)
}

/// The first of some cumulative probabilities that is above `xi`, the one before it, and itself.
fn find(chances: &[f32], xi: f64) -> (usize, f64, f64) {
    let found = chances.iter().position(|chance| xi < f64::from(*chance)).unwrap_or(chances.len() - 1);
    (found, before(chances, found), chances[found].into())
}

fn before(chances: &[f32], place: usize) -> f64 {
    if place == 0 { 0.0 } else { chances[place - 1].into() }
}

/// The cosines of the angles of a row's edges from straight up.
fn edges(of: &Panorama, row: usize) -> [f64; 2] {
    [row, row + 1].map(|edge| (PI * edge as f64 / f64::from(of.image.size[1])).cos())
}

fn columns(of: &Panorama, row: usize) -> &[f32] {
    let width = of.image.size[0] as usize;
    &of.chances.columns[row * width..][..width]
}

/// The density of sampled directions in a texel, per solid angle.
fn density_in(of: &Panorama, row: usize, column: usize) -> f64 {
    let [upper, lower] = edges(of, row);
    let solid_angle = (upper - lower) * TAU / f64::from(of.image.size[0]);
    let columns = columns(of, row);
    let of_row = f64::from(of.chances.rows[row]) - before(&of.chances.rows, row);
    let of_column = f64::from(columns[column]) - before(columns, column);
    of_row * of_column / solid_angle
}

/// The density with which [`sample`] chooses this direction.
pub(in crate::reference) fn density(of: &Panorama, direction: DVec3) -> f64 {
    let at = place(of, direction);
    let [width, height] = of.image.size.map(|length| length as usize);
    density_in(of, (at.y as usize).min(height - 1), (at.x as usize).min(width - 1))
}

/// A direction for two values in [0, 1), and its density per solid angle.
pub(in crate::reference) fn sample(of: &Panorama, xi: [f64; 2]) -> (DVec3, f64) {
    let (row, from, to) = find(&of.chances.rows, xi[0]);
    let [upper, lower] = edges(of, row);
    let height = upper + (xi[0] - from) / (to - from) * (lower - upper);
    let (column, from, to) = find(columns(of, row), xi[1]);
    let longitude = (column as f64 + (xi[1] - from) / (to - from)) / f64::from(of.image.size[0]);
    let (sine, cosine) = (TAU * (longitude - 0.5 - f64::from(of.turn_degrees) / 360.0)).sin_cos();
    let radius = (1.0 - height * height).max(0.0).sqrt();
    (DVec3::new(radius * sine, height, -radius * cosine), density_in(of, row, column))
}
