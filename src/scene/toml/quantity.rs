//! The numbers of the tables `[camera]` and `[view]`. Each is a plain number, or a text as options have it: `"1/250"`,
//! `"f/2.8"`, `"1.2 m"`.

use super::error::ParseError;
use crate::scene::{Typed, Unit, in_range};
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use std::fmt::{Display, Formatter, LowerExp};
use toml::Spanned;

/// What the numbers measure, by their keys.
const UNITS: [(&str, Unit); 21] = [
    ("vfov_degrees", Unit::Degrees),
    ("focal_length", Unit::Millimetres),
    ("lens_shift", Unit::Millimetres),
    ("lens_rise", Unit::Millimetres),
    ("lens_tilt_degrees", Unit::Degrees),
    ("tilt_direction_degrees", Unit::Degrees),
    ("view_distance", Unit::Length),
    ("pixel_size", Unit::Length),
    ("metres_per_unit", Unit::Metres),
    ("lens_diameter", Unit::Length),
    ("f_number", Unit::FNumber),
    ("focal_distance", Unit::Length),
    ("hole_diameter", Unit::Length),
    ("blade_rotation_degrees", Unit::Degrees),
    ("roundness", Unit::Plain),
    ("anamorphic", Unit::Plain),
    ("cats_eye", Unit::Plain),
    ("bokeh_profile", Unit::Plain),
    ("shutter", Unit::Seconds),
    ("iso", Unit::Iso),
    ("exposure", Unit::Stops),
];

/// What the number of a key measures. `None` if the key does not take a text instead of a number.
pub(super) fn unit_of(key: &str) -> Option<Unit> {
    UNITS.iter().find(|(known, _)| *known == key).map(|(_, unit)| *unit)
}

/// A number as the file has it.
pub(super) enum Quantity {
    /// A plain number, in the unit of its key.
    Number(f64),
    /// A text, which may have another unit.
    Text(String),
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
        struct NumberOrText;

        impl Visitor<'_> for NumberOrText {
            type Value = Quantity;

            fn expecting(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
                out.write_str("a number or a text")
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Quantity, E> {
                Ok(Quantity::Number(number as f64))
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Quantity, E> {
                Ok(Quantity::Number(number as f64))
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Quantity, E> {
                Ok(Quantity::Number(number))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Quantity, E> {
                Ok(Quantity::Text(text.to_owned()))
            }
        }

        file.deserialize_any(NumberOrText)
    }
}

/// Reads the numbers of a table.
pub(super) struct Quantities {
    /// The length of a scene unit, for lengths that are given in metres.
    pub(super) metres_per_unit: f64,
}

impl Quantities {
    /// The number of a key, if the table has it, rounded to f32.
    pub(super) fn single(
        &self,
        key: &str,
        quantity: Option<&Spanned<Quantity>>,
        range: [f32; 2],
    ) -> Result<Option<f32>, ParseError> {
        self.read(key, quantity, range, |number| number as f32)
    }

    /// The number of a key, if the table has it.
    pub(super) fn double(
        &self,
        key: &str,
        quantity: Option<&Spanned<Quantity>>,
        range: [f64; 2],
    ) -> Result<Option<f64>, ParseError> {
        self.read(key, quantity, range, |number| number)
    }

    fn read<T: Copy + PartialOrd + Display + LowerExp>(
        &self,
        key: &str,
        quantity: Option<&Spanned<Quantity>>,
        range: [T; 2],
        rounded: fn(f64) -> T,
    ) -> Result<Option<T>, ParseError> {
        let Some(quantity) = quantity else { return Ok(None) };
        let refused = |message: String| ParseError::at(quantity, &format!("{key} {message}"));
        let (number, here) = match quantity.get_ref() {
            Quantity::Number(number) => (*number, String::new()),
            Quantity::Text(text) => {
                let unit = unit_of(key).unwrap_or(Unit::Plain);
                let number = match unit.read(text) {
                    Ok(Typed::Number(number)) => number,
                    Ok(Typed::Metres(metres)) => metres / self.metres_per_unit,
                    Err(right) => return Err(refused(format!("is \"{text}\", but {right}"))),
                };
                (number, format!("; here is the text \"{text}\""))
            }
        };
        let number = rounded(number);
        in_range(number, range).map_err(|wrong| refused(wrong + &here))?;
        Ok(Some(number))
    }
}
