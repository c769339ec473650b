//! How a picture is shown.

use super::{Overlay, in_range};
use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// The speed of the film.
pub const ISOS: [f32; 2] = [0.1, 1e7];
/// The exposure, in stops.
pub const EXPOSURES: [f32; 2] = [-20.0, 20.0];
/// The largest circle of confusion that counts as sharp, in millimetres on a film of 36 x 24 mm.
pub const TOLERANCES_MM: [f32; 2] = [1e-4, 10.0];
/// The same in pixels.
pub const TOLERANCES_PIXELS: [f32; 2] = [0.1, 1000.0];

/// The default speed of the film.
const DEFAULT_ISO: f32 = 100.0;

/// The settings that change only how the film is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The exposure in stops: the picture is multiplied by two to this power.
    pub exposure_stops: f32,
    /// The speed of the film: twice the value is twice as bright.
    pub iso: f32,
    /// Whether the brightness stays the same when the aperture changes.
    pub exposure_lock: bool,
    /// The overlay, if one is shown.
    pub overlay: Option<Overlay>,
    /// The largest circle of confusion that counts as sharp.
    pub tolerance: Tolerance,
}

/// The largest circle of confusion that counts as sharp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// In millimetres on a film of 36 x 24 mm. So what is sharp does not depend on the number of pixels.
    Film(f32),
    /// In pixels of the picture.
    Pixels(f32),
}

impl Default for Tolerance {
    /// The tolerance of most tables of the depth of field.
    fn default() -> Self {
        Self::Film(0.03)
    }
}

impl Tolerance {
    /// Checks that the number is in its range.
    ///
    /// # Errors
    /// What is wrong, as the end of a sentence that begins with what the user calls the tolerance.
    pub fn check(self) -> Result<(), String> {
        match self {
            Self::Film(mm) => in_range(mm, TOLERANCES_MM).map_err(|wrong| format!("{wrong} mm")),
            Self::Pixels(pixels) => in_range(pixels, TOLERANCES_PIXELS)
                .map_err(|wrong| format!("{wrong} pixels; a length on the film is written like 0.03mm")),
        }
    }
}

impl Display for Tolerance {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Film(mm) => write!(out, "{mm}mm"),
            Self::Pixels(pixels) => write!(out, "{pixels}px"),
        }
    }
}

impl FromStr for Tolerance {
    type Err = &'static str;

    /// A number with `mm` or `px`. A number alone is in pixels.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        let read = |number: &str, of: fn(f32) -> Self| number.trim_end().parse().ok().map(of);
        match (text.strip_suffix("mm"), text.strip_suffix("px")) {
            (Some(number), _) => read(number, Self::Film),
            (_, Some(number)) => read(number, Self::Pixels),
            _ => read(text, Self::Pixels),
        }
        .ok_or("a tolerance is written like 0.03mm on the film, or 2px in the picture")
    }
}

impl Default for View {
    fn default() -> Self {
        Self {
            exposure_stops: 0.0,
            iso: DEFAULT_ISO,
            exposure_lock: true,
            overlay: None,
            tolerance: Tolerance::default(),
        }
    }
}
