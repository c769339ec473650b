//! The ranges of numbers in scene files, options and sliders: the lowest and the highest value of each.

use super::{MAX_LENGTH, MIN_LENGTH};
use std::fmt::{Display, LowerExp};

/// The coordinates of a position.
pub const PLACES: [f64; 2] = [-(MAX_LENGTH as f64), MAX_LENGTH as f64];
/// The vertical field of view, in degrees.
pub const VFOV_DEGREES: [f64; 2] = [0.01, 175.0];
/// The length of a scene unit, in metres.
pub const METRES_PER_UNIT: [f64; 2] = [1e-15, 1e15];
/// The width and the height of the film, in millimetres.
pub const SENSOR_SIDES_MM: [f64; 2] = [0.1, 1000.0];
/// The focal length, in millimetres.
pub const FOCAL_LENGTHS_MM: [f64; 2] = [0.01, 1e5];
/// The diameter of a lens or a hole, in scene units.
pub const DIAMETERS: [f32; 2] = [0.0, MAX_LENGTH];
/// The f-number.
pub const F_NUMBERS: [f64; 2] = [0.01, 1e6];
/// The focal distance, in scene units.
pub const FOCAL_DISTANCES: [f32; 2] = [MIN_LENGTH, MAX_LENGTH];
/// How far a lens is shifted beside the film, in millimetres.
pub const SHIFTS_MM: [f32; 2] = [-1000.0, 1000.0];
/// The angle by which a lens is tilted, in degrees.
pub const TILTS: [f32; 2] = [-45.0, 45.0];
/// The Abbe number of a lens.
pub const ABBE_NUMBERS: [u32; 2] = [1, 100];
/// The number of blades of an iris.
pub const BLADES: [u32; 2] = [3, 16];
/// The angle by which an iris or the direction of a tilt is turned, in degrees.
pub const ROTATIONS: [f32; 2] = [-360.0, 360.0];
/// The curvature of the blades' edges.
pub const ROUNDNESSES: [f32; 2] = [0.0, 1.0];
/// The height of an aperture divided by its width.
pub const ANAMORPHICS: [f32; 2] = [0.1, 10.0];
/// The displacement of the front rim of the lens, in diameters.
pub const CATS_EYES: [f32; 2] = [0.0, 1.0];
/// How light is spread over an aperture.
pub const PROFILES: [f32; 2] = [-1.0, 1.0];
/// The time that the shutter is open, in seconds.
pub const SHUTTERS: [f32; 2] = [1e-6, 1e4];
/// The speed of the film.
pub const ISOS: [f32; 2] = [0.1, 1e7];
/// The exposure, in stops.
pub const EXPOSURES: [f32; 2] = [-20.0, 20.0];
/// The largest circle of confusion that counts as sharp, in millimetres on a film of 36 x 24 mm.
pub const TOLERANCES_MM: [f32; 2] = [1e-4, 10.0];
/// The same in pixels.
pub const TOLERANCES_PIXELS: [f32; 2] = [0.1, 1000.0];

/// Checks that a number is in a range. NaN is in no range.
///
/// # Errors
/// What is wrong, as the end of a sentence that begins with what the user calls the number.
pub fn in_range<T>(value: T, [low, high]: [T; 2]) -> Result<(), String>
where
    T: PartialOrd + Display + LowerExp,
{
    if value >= low && value <= high {
        return Ok(());
    }
    let [value, low, high] = [value, low, high].map(short);
    Err(format!("is {value}, but must be from {low} to {high}"))
}

/// Checks a number as [`in_range`] does, but allows 0, which stands for something else.
///
/// # Errors
/// As [`in_range`].
pub fn in_range_or_zero(value: u32, range: [u32; 2], zero: &str) -> Result<(), String> {
    if value == 0 {
        return Ok(());
    }
    in_range(value, range).map_err(|wrong| format!("{wrong}, or 0 for {zero}"))
}

/// A number as text, without a row of zeros.
fn short(number: impl Display + LowerExp) -> String {
    let (plain, power) = (number.to_string(), format!("{number:e}"));
    if plain.len() > 6 && power.len() < plain.len() { power } else { plain }
}
