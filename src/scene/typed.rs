//! Numbers as people type them, such as `1/250 s`, `f/2,8` or `85 mm`. Options, scene files and the fields of the panel
//! read them here, and the panel shows them with their units.

/// What a number measures. It decides what may stand before and after the number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A number without a unit.
    Plain,
    /// An f-number.
    FNumber,
    /// A time in seconds.
    Seconds,
    /// A length in scene units.
    Length,
    /// A length in metres.
    Metres,
    /// A length in millimetres.
    Millimetres,
    /// An angle in degrees.
    Degrees,
    /// A length in pixels.
    Pixels,
    /// A factor in stops, each of which doubles.
    Stops,
    /// The speed of a film.
    Iso,
    /// A fraction of something else, where 0 turns the setting off.
    Fraction,
}

/// A number that was read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Typed {
    /// A number in the unit of the setting.
    Number(f64),
    /// A length in metres, for a setting in scene units.
    Metres(f64),
}

/// The ends of a number for each unit, with their factors. An end that contains another one stands before it.
const SECONDS: &[(&str, f64)] =
    &[("seconds", 1.0), ("second", 1.0), ("sec", 1.0), ("min", 60.0), ("ms", 1e-3), ("s", 1.0)];
const METRES: &[(&str, f64)] =
    &[("mm", 1e-3), ("cm", 1e-2), ("km", 1e3), ("µm", 1e-6), ("um", 1e-6), ("m", 1.0)];
const DEGREES: &[(&str, f64)] = &[("degrees", 1.0), ("degree", 1.0), ("deg", 1.0), ("°", 1.0)];
const PIXELS: &[(&str, f64)] = &[("pixels", 1.0), ("pixel", 1.0), ("px", 1.0)];
const STOPS: &[(&str, f64)] = &[("stops", 1.0), ("stop", 1.0), ("ev", 1.0)];
const PERCENT: &[(&str, f64)] = &[("%", 0.01)];

impl Unit {
    /// Reads a number with or without its unit.
    ///
    /// # Errors
    /// A sentence about how such a number is written.
    pub fn read(self, text: &str) -> Result<Typed, String> {
        let text = text.trim().to_lowercase();
        let (before, after): (&[&str], &[(&str, f64)]) = match self {
            Self::Plain => (&[], &[]),
            Self::FNumber => (&["f/", "f"], &[]),
            Self::Seconds => (&[], SECONDS),
            Self::Length | Self::Metres | Self::Millimetres => (&[], METRES),
            Self::Degrees => (&[], DEGREES),
            Self::Pixels => (&[], PIXELS),
            Self::Stops => (&[], STOPS),
            Self::Iso => (&["iso"], &[]),
            Self::Fraction => (&[], PERCENT),
        };
        let rest = before.iter().find_map(|start| text.strip_prefix(start)).unwrap_or(&text);
        let unit = after.iter().find_map(|(end, factor)| Some((rest.strip_suffix(end)?, *factor)));
        let (digits, factor) = unit.unwrap_or((rest, 1.0));
        // Some write f/4 as 1/4, because the lens is a quarter as wide as its focal length, and others mean 0.25.
        let is_unclear = self == Self::FNumber && digits.contains('/');
        let number = number(digits)?.filter(|_| !is_unclear).ok_or_else(|| self.right().to_owned())?;
        Ok(match (self, unit) {
            (Self::Length, Some(_)) => Typed::Metres(number * factor),
            // Without its unit, the number is in millimetres already.
            (Self::Millimetres, Some(_)) => Typed::Number(number * (factor / 1e-3)),
            _ => Typed::Number(number * factor),
        })
    }

    /// How such a number is written.
    pub fn right(self) -> &'static str {
        match self {
            Self::Plain => "a number is written like 0.5, -2 or 1e-3",
            Self::FNumber => "an f-number is written like 2.8 or f/2.8",
            Self::Seconds => "a time is written like 1/250, 0.004, 4 ms or 2 s",
            Self::Length => "a length is written like 0.5, in scene units, or like 17 mm, 35 cm or 1.2 m",
            Self::Metres => "a length is written like 0.05, in metres, or like 5 cm",
            Self::Millimetres => "a length is written like 85 or 85 mm",
            Self::Degrees => "an angle is written like 30, 30 deg or 30°",
            Self::Pixels => "a number of pixels is written like 1.5 or 1.5 px",
            Self::Stops => "a number of stops is written like 1.5, -1/3 or +2 EV",
            Self::Iso => "a film speed is written like 400 or ISO 400",
            Self::Fraction => "a fraction is written like 0.02 or 2%",
        }
    }

    /// A number with its unit, as the panel shows it. A scene unit is so many metres long.
    pub fn shown(self, number: f64, metres_per_unit: f64) -> String {
        match self {
            Self::Plain => rounded(number, 4),
            Self::FNumber => format!("f/{}", rounded(number, 3)),
            Self::Seconds => {
                let share = number.recip();
                let is_share = number < 0.5 && (share.round() * number - 1.0).abs() < 0.01;
                if is_share { format!("1/{share:.0} s") } else { format!("{} s", rounded(number, 3)) }
            }
            Self::Length => format!("{} = {}", rounded(number, 4), metric(number * metres_per_unit)),
            Self::Metres => metric(number),
            Self::Millimetres => format!("{} mm", rounded(number, 4)),
            Self::Degrees => format!("{number:.1}°"),
            Self::Pixels => format!("{} px", rounded(number, 3)),
            Self::Stops => format!("{number:+.2} stops"),
            Self::Iso => format!("ISO {number:.0}"),
            Self::Fraction if number == 0.0 => "off".into(),
            Self::Fraction => rounded(number, 3),
        }
    }
}

/// Reads a number or a fraction of two numbers. `None` if it is neither.
fn number(text: &str) -> Result<Option<f64>, String> {
    let Some((over, under)) = text.split_once('/') else {
        return decimal(text);
    };
    let parts = decimal(over)?.zip(decimal(under)?);
    Ok(parts.filter(|(_, under)| *under != 0.0).map(|(over, under)| over / under))
}

/// Reads a number with a decimal point or a decimal comma.
fn decimal(text: &str) -> Result<Option<f64>, String> {
    let text = text.trim();
    let Some((whole, part)) = text.split_once(',') else {
        return Ok(text.parse().ok());
    };
    let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let unsigned = whole.trim_start_matches(['+', '-']);
    if !(is_digits(part) && (is_digits(unsigned) || unsigned.is_empty())) {
        return Ok(None);
    }
    // A comma before three digits may also separate thousands.
    if part.len() == 3 && unsigned.len() < 4 && !unsigned.starts_with('0') && !unsigned.is_empty() {
        return Err(format!("{text} could mean two numbers; write {whole}.{part} or {whole}{part}"));
    }
    Ok(format!("{whole}.{part}").parse().ok())
}

/// A length in the metric unit that suits it.
pub fn metric(metres: f64) -> String {
    let (factor, unit) = match metres.abs() {
        length if length < 0.1 => (1e3, "mm"),
        length if length < 1.0 => (1e2, "cm"),
        length if length < 1e4 => (1.0, "m"),
        _ => (1e-3, "km"),
    };
    format!("{} {unit}", rounded(metres * factor, 3))
}

/// A number with so many digits, without zeros at its end.
pub fn rounded(number: f64, digits: i32) -> String {
    if !number.is_finite() || number == 0.0 {
        return number.to_string();
    }
    // Rounding may add a digit before the point: 9.999 becomes 10.
    let after_first = usize::try_from(digits - 1).unwrap_or(0);
    let power = format!("{number:.after_first$e}");
    let exponent = power.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    if !(-5..7).contains(&exponent) {
        return power;
    }
    let places = usize::try_from(digits - 1 - exponent).unwrap_or(0);
    let text = format!("{number:.places$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::Unit::{
        Degrees, FNumber, Fraction, Iso, Length, Metres, Millimetres, Pixels, Plain, Seconds, Stops,
    };
    use super::{Typed, Unit, metric, rounded};

    /// Catches a fraction of which only one half is read, a decimal comma that is dropped, a unit that is ignored or
    /// has another factor, and a prefix that hides the number.
    #[test]
    fn numbers_are_read_as_people_type_them() {
        let read: [(Unit, &str, f64); 44] = [
            (Plain, "0.5", 0.5),
            (Plain, " -2 ", -2.0),
            (Plain, "1e-3", 1e-3),
            (Plain, "2,8", 2.8),
            (Plain, "0,125", 0.125),
            (Plain, "-,5", -0.5),
            (Plain, "1000,5", 1000.5),
            (Seconds, "1/250", 0.004),
            (Seconds, "1/250 s", 0.004),
            (Seconds, "1/250s", 0.004),
            (Seconds, "1 / 250 sec", 0.004),
            (Seconds, "0,5", 0.5),
            (Seconds, "4 ms", 0.004),
            (Seconds, "2 seconds", 2.0),
            (Seconds, "1.5min", 90.0),
            (FNumber, "2.8", 2.8),
            (FNumber, "2,8", 2.8),
            (FNumber, "f/2.8", 2.8),
            (FNumber, "F/2,8", 2.8),
            (FNumber, "f2.8", 2.8),
            (FNumber, "f 4", 4.0),
            (Length, "10.6", 10.6),
            (Length, "1/2", 0.5),
            (Metres, "5 cm", 0.05),
            (Metres, "0.05", 0.05),
            (Millimetres, "85", 85.0),
            (Millimetres, "85mm", 85.0),
            (Millimetres, "8.5 cm", 85.0),
            (Degrees, "30", 30.0),
            (Degrees, "30°", 30.0),
            (Degrees, "30 deg", 30.0),
            (Degrees, "-12,5 degrees", -12.5),
            (Pixels, "1.5 px", 1.5),
            (Pixels, "2pixels", 2.0),
            (Stops, "-1/3", -1.0 / 3.0),
            (Stops, "+2 EV", 2.0),
            (Stops, "1 stop", 1.0),
            (Iso, "ISO 400", 400.0),
            (Iso, "iso400", 400.0),
            (Iso, "400", 400.0),
            (Fraction, "2%", 0.02),
            (Fraction, "2 %", 0.02),
            (Fraction, "0.02", 0.02),
            (Fraction, "0", 0.0),
        ];
        for (unit, text, number) in read {
            match unit.read(text) {
                Ok(Typed::Number(is)) => assert!((is - number).abs() < 1e-12, "{text}: {is}"),
                other => panic!("{unit:?} {text}: {other:?}"),
            }
        }
        for (text, metres) in
            [("85mm", 0.085), ("35 cm", 0.35), ("1.2 m", 1.2), ("1,2m", 1.2), ("3 km", 3e3), ("7 µm", 7e-6)]
        {
            match Length.read(text) {
                Ok(Typed::Metres(is)) => assert!((is / metres - 1.0).abs() < 1e-12, "{text}: {is}"),
                other => panic!("{text}: {other:?}"),
            }
        }
    }

    /// Catches text that is read in part, a unit that the setting does not have, and a number that has two meanings.
    #[test]
    fn what_cannot_be_read_is_refused_with_an_example() {
        for (unit, text, part) in [
            (Plain, "", "like 0.5"),
            (Plain, "1.2.3", "like 0.5"),
            (Plain, "1.000,5", "like 0.5"),
            (Plain, "1,2,3", "like 0.5"),
            (Plain, "3 mm", "like 0.5"),
            (Plain, "1,250", "write 1.250 or 1250"),
            (Seconds, "1/", "1/250"),
            (Seconds, "/250", "1/250"),
            (Seconds, "1/250/2", "1/250"),
            (Seconds, "1/0", "1/250"),
            (Seconds, "fast", "1/250"),
            (Seconds, "85 mm", "1/250"),
            (FNumber, "1/4", "f/2.8"),
            (FNumber, "f/", "f/2.8"),
            (FNumber, "f/2.8 mm", "f/2.8"),
            (Length, "12 inch", "35 cm"),
            (Length, "m", "35 cm"),
            (Degrees, "30 rad", "30 deg"),
            (Pixels, "1 mm", "px"),
            (Iso, "ISO", "ISO 400"),
        ] {
            let error = unit.read(text).expect_err(text);
            assert!(error.contains(part), "{text}: {error}");
        }
    }

    /// Catches lengths in a unit that nobody would choose, digits that say nothing, and a shown number that cannot be
    /// typed.
    #[test]
    fn numbers_are_shown_with_their_units() {
        for (unit, number, text) in [
            (Length, 0.34, "0.34 = 17 mm"),
            (Length, 10.6, "10.6 = 53 cm"),
            (Length, 0.0, "0 = 0 mm"),
            (Seconds, 0.004, "1/250 s"),
            (Seconds, 0.3, "0.3 s"),
            (Seconds, 2.0, "2 s"),
            (FNumber, 2.8284, "f/2.83"),
            (Degrees, 33.98, "34.0°"),
            (Stops, -0.333, "-0.33 stops"),
            (Iso, 400.0, "ISO 400"),
            (Fraction, 0.0, "off"),
        ] {
            assert_eq!(unit.shown(number, 0.05), text);
        }
        for (metres, text) in [(0.0123, "12.3 mm"), (2.5, "2.5 m"), (12345.0, "12.3 km"), (1e-9, "1e-6 mm")] {
            assert_eq!(metric(metres).replace(".00e", "e"), text);
        }
        assert_eq!(
            [9.9996, 123_456.0, 0.1, 1e9].map(|is| rounded(is, 4)),
            ["10", "123456", "0.1", "1.000e9"]
        );
        for (unit, number) in [(Seconds, 0.004), (FNumber, 5.6), (Degrees, 34.0), (Iso, 100.0)] {
            assert_eq!(unit.read(&unit.shown(number, 1.0)), Ok(Typed::Number(number)));
        }
    }
}
