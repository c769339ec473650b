//! The background, which is seen where a ray hits nothing.

use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::Rgb;
use glam::Vec3;
use serde::Deserialize;
use toml::Spanned;

/// The radiance of the background: `horizon` at the horizon and below, `zenith` straight up. In between, the two are
/// mixed by the weight `y (2 - y)`, where `y` is the height of the unit direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Background {
    /// The radiance at and below the horizon.
    pub horizon: Vec3,
    /// The radiance straight up.
    pub zenith: Vec3,
}

impl Background {
    /// A black background.
    pub const BLACK: Self = Self { horizon: Vec3::ZERO, zenith: Vec3::ZERO };
}

/// The table `[background]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct BackgroundTable {
    color: Option<Rgb>,
    horizon: Option<Rgb>,
    zenith: Option<Rgb>,
}

/// The background that the table describes. It is black without a table.
pub(in crate::scene) fn background(
    table: Option<&Spanned<BackgroundTable>>,
) -> Result<Background, ParseError> {
    let Some(span) = table else {
        return Ok(Background::BLACK);
    };
    let table = span.get_ref();
    match (&table.color, &table.horizon, &table.zenith) {
        (Some(color), None, None) => Ok(Background { horizon: color.0, zenith: color.0 }),
        (None, Some(horizon), Some(zenith)) => Ok(Background { horizon: horizon.0, zenith: zenith.0 }),
        _ => Err(ParseError::at(span, "the background needs either color, or horizon and zenith")),
    }
}
