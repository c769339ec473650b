//! Ranges that numbers have to lie in.

use std::fmt::{Display, LowerExp};

/// Holds a number against a range. NaN is in no range.
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

/// A number without a row of zeros.
fn short(number: impl Display + LowerExp) -> String {
    let (plain, power) = (number.to_string(), format!("{number:e}"));
    if plain.len() > 6 && power.len() < plain.len() { power } else { plain }
}
