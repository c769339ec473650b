//! The background, which is seen where a ray hits nothing.

use super::Panorama;
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{NonNegative, Rgb};
use crate::scene::{Image, PLACES, in_range};
use glam::{DVec3, Vec3};
use serde::Deserialize;
use std::f64::consts::PI;
use std::path::Path;
use toml::Spanned;

/// What is seen where a ray hits nothing.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// A sky without an image.
    Gradient(Gradient),
    /// An image of all directions.
    Panorama(Panorama),
}

/// A radiance that is `horizon` at the horizon and below, and `zenith` straight up. In between, the two are
/// mixed by the weight `y (2 - y)`, where `y` is the height of the unit direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gradient {
    /// The radiance at and below the horizon.
    pub horizon: Vec3,
    /// The radiance straight up.
    pub zenith: Vec3,
}

impl Gradient {
    /// Black everywhere.
    pub const BLACK: Self = Self { horizon: Vec3::ZERO, zenith: Vec3::ZERO };
}

impl Background {
    /// A black background.
    pub const BLACK: Self = Self::Gradient(Gradient::BLACK);

    /// The colours of a sky without an image. They are black for an image.
    pub fn gradient(&self) -> Gradient {
        match self {
            Self::Gradient(gradient) => *gradient,
            Self::Panorama(_) => Gradient::BLACK,
        }
    }

    /// The image of the sky, if it has one.
    pub fn panorama(&self) -> Option<&Panorama> {
        match self {
            Self::Gradient(_) => None,
            Self::Panorama(panorama) => Some(panorama),
        }
    }

    /// As bright as it is in any direction, in each channel.
    pub fn brightest(&self) -> Vec3 {
        match self {
            Self::Gradient(Gradient { horizon, zenith }) => horizon.max(*zenith),
            Self::Panorama(panorama) => panorama.radiance * panorama.image.brightest,
        }
    }

    /// At least as much as the irradiance of any surface that faces the sky.
    pub fn most_irradiance(&self) -> DVec3 {
        let of_brightest = PI * self.brightest().as_dvec3();
        self.panorama().map_or(of_brightest, |sky| of_brightest.min(4.0 * PI * sky.mean))
    }
}

impl From<Gradient> for Background {
    fn from(gradient: Gradient) -> Self {
        Self::Gradient(gradient)
    }
}

/// The table `[background]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct BackgroundTable {
    color: Option<Rgb>,
    horizon: Option<Rgb>,
    zenith: Option<Rgb>,
    image: Option<Spanned<String>>,
    radiance: Option<NonNegative>,
    turn_degrees: Option<Spanned<f64>>,
}

/// The background that the table describes. It is black without a table. The image's path is relative to `folder`.
pub(in crate::scene) fn background(
    table: Option<&Spanned<BackgroundTable>>,
    folder: &Path,
) -> Result<Background, ParseError> {
    let Some(span) = table else {
        return Ok(Background::BLACK);
    };
    let table = span.get_ref();
    match (&table.image, &table.color, &table.horizon, &table.zenith) {
        (Some(file), None, None, None) => {
            let turn = table.turn_degrees.as_ref();
            turn.map_or(Ok(()), |turn| {
                in_range(*turn.get_ref(), PLACES)
                    .map_err(|wrong| ParseError::at(turn, &format!("turn_degrees {wrong}")))
            })?;
            let image = Image::read(&folder.join(file.get_ref()));
            let image = image.map_err(|error| ParseError::at(file, &error.to_string()))?;
            let radiance = table.radiance.as_ref().map_or(1.0, |radiance| radiance.0);
            // A whole turn leaves the sky as it is.
            let turn = turn.map_or(0.0, |turn| turn.get_ref().rem_euclid(360.0));
            Ok(Background::Panorama(Panorama::new(image, radiance, turn as f32)))
        }
        _ if table.radiance.is_some() || table.turn_degrees.is_some() => Err(ParseError::at(
            span,
            "radiance and turn_degrees belong to an image of the background, which has no color, horizon and zenith",
        )),
        (None, Some(color), None, None) => Ok(Gradient { horizon: color.0, zenith: color.0 }.into()),
        (None, None, Some(horizon), Some(zenith)) => {
            Ok(Gradient { horizon: horizon.0, zenith: zenith.0 }.into())
        }
        _ => Err(ParseError::at(span, "the background needs either color, or horizon and zenith, or image")),
    }
}
