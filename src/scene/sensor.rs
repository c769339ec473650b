//! The sizes of film and sensors.

use super::in_range;
use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// The width and the height of the film, in millimetres.
pub const SENSOR_SIDES_MM: [f64; 2] = [0.1, 1000.0];

/// The size of the film or of the sensor in millimetres. A picture has its height. The width of a picture follows from
/// its own shape, and may be another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// The width.
    pub width_mm: f64,
    /// The height.
    pub height_mm: f64,
}

/// A format that has a name.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// The name on the command line and in scene files.
    pub name: &'static str,
    /// The name in the viewer.
    pub label: &'static str,
    /// Which cameras have it.
    pub help: &'static str,
    /// The size.
    pub sensor: Sensor,
}

/// Every format that has a name.
pub static FORMATS: [Format; 7] = [
    format("full-frame", "Full frame", "36 x 24 mm: 35 mm film.", Sensor::FULL_FRAME),
    format("aps-c", "APS-C", "23.5 x 15.6 mm: most cameras with interchangeable lenses.", of(23.5, 15.6)),
    format("micro-four-thirds", "Micro Four Thirds", "17.3 x 13 mm.", of(17.3, 13.0)),
    format("medium-format", "Medium format", "43.8 x 32.9 mm: digital medium format.", of(43.8, 32.9)),
    format(
        "1-inch",
        "1 inch",
        "13.2 x 8.8 mm: compact cameras. The name is that of an old video tube.",
        of(13.2, 8.8),
    ),
    format("phone", "Phone", "9.8 x 7.3 mm: the main camera of a large phone.", of(9.8, 7.3)),
    format("eye", "Eye", "24 x 18 mm: the middle of the retina, as if it were flat.", Sensor::EYE),
];

const fn of(width_mm: f64, height_mm: f64) -> Sensor {
    Sensor { width_mm, height_mm }
}

const fn format(name: &'static str, label: &'static str, help: &'static str, sensor: Sensor) -> Format {
    Format { name, label, help, sensor }
}

impl Sensor {
    /// 35 mm film.
    pub const FULL_FRAME: Self = of(36.0, 24.0);
    /// The middle of the retina.
    pub const EYE: Self = of(24.0, 18.0);

    /// The distance between opposite corners.
    pub fn diagonal_mm(&self) -> f64 {
        self.width_mm.hypot(self.height_mm)
    }

    /// The crop factor: the diagonal of full frame divided by that of this sensor.
    pub fn crop_factor(&self) -> f64 {
        Self::FULL_FRAME.diagonal_mm() / self.diagonal_mm()
    }

    /// The vertical field of view, in radians, of a lens of this focal length that is focused at infinity.
    pub fn vfov_of_focal_length(&self, millimetres: f64) -> f64 {
        // Converted to degrees and back, so that `vfov_degrees` finds degrees that give exactly these radians.
        (2.0 * (0.5 * self.height_mm / millimetres).atan()).to_degrees().to_radians()
    }

    /// The format of this size, if it has a name.
    pub fn format(&self) -> Option<&'static Format> {
        FORMATS.iter().find(|format| format.sensor == *self)
    }

    /// Checks that both sides are in their range.
    ///
    /// # Errors
    /// What is wrong, as the end of a sentence that begins with what the user calls the sensor.
    pub fn check(&self) -> Result<(), String> {
        let sides = [self.width_mm, self.height_mm];
        if sides.into_iter().all(|side| in_range(side, SENSOR_SIDES_MM).is_ok()) {
            return Ok(());
        }
        let [low, high] = SENSOR_SIDES_MM;
        Err(format!("is {self} mm, but each side must be from {low} to {high} mm"))
    }
}

impl Display for Sensor {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        match self.format() {
            Some(format) => out.write_str(format.name),
            None => write!(out, "{}x{}", self.width_mm, self.height_mm),
        }
    }
}

impl FromStr for Sensor {
    type Err = String;

    /// The name of a format, or a width and a height in millimetres: `36x24`.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let named = FORMATS.iter().find(|format| format.name == text).map(|format| format.sensor);
        let sides = || {
            let (width, height) = text.trim_end_matches("mm").split_once(['x', 'X'])?;
            Some(of(width.trim().parse().ok()?, height.trim().parse().ok()?))
        };
        named.or_else(sides).ok_or_else(|| {
            let names = FORMATS.map(|format| format.name).join(", ");
            format!("a sensor is one of {names}, or its width and height in mm, such as 36x24")
        })
    }
}
