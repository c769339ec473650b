//! Whether a number is in its range. Each range, the lowest and the highest value, stands beside the field that it is for.

use std::fmt::{Display, LowerExp};

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
