//! Numbers in the scene file. They are checked while the file is read, so that an error has a line.

use super::error::ParseError;
use crate::scene::{MAX_BOUNCES, MAX_EXTENT, MAX_LENGTH, MIN_LENGTH, PLACES, in_range};
use glam::{DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(try_from = "f64")]
pub(in crate::scene) struct Positive(pub(in crate::scene) f64);

#[derive(Deserialize, Default)]
#[serde(try_from = "f64")]
pub(in crate::scene) struct NonNegative(pub(in crate::scene) f32);

#[derive(Deserialize, Default)]
#[serde(try_from = "f64")]
pub(in crate::scene) struct Fraction(pub(in crate::scene) f32);

#[derive(Deserialize)]
#[serde(try_from = "f64")]
pub(in crate::scene) struct RefractiveIndex(pub(in crate::scene) f32);

#[derive(Deserialize)]
#[serde(try_from = "[f64; 3]")]
pub(in crate::scene) struct Vector(pub(in crate::scene) DVec3);

#[derive(Deserialize)]
#[serde(try_from = "[NonNegative; 3]")]
pub(in crate::scene) struct Rgb(pub(in crate::scene) Vec3);

#[derive(Deserialize)]
#[serde(try_from = "i64")]
pub(in crate::scene) struct Extent(pub(in crate::scene) u32);

#[derive(Deserialize)]
#[serde(try_from = "i64")]
pub(in crate::scene) struct Count(pub(in crate::scene) u32);

/// Reads a vector that may be left out.
pub(in crate::scene) fn zero() -> Vector {
    Vector(DVec3::ZERO)
}

/// Checks that a vector is not zero.
pub(in crate::scene) fn nonzero(vector: &Spanned<Vector>) -> Result<Vec3, ParseError> {
    match vector.get_ref().f32() {
        Vec3::ZERO => Err(ParseError::at(vector, "this vector must not be zero")),
        other => Ok(other),
    }
}

impl TryFrom<f64> for Positive {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        in_range(value, [MIN_LENGTH, MAX_LENGTH].map(f64::from)).map(|()| Self(value))
    }
}

impl Positive {
    pub(in crate::scene) fn f32(&self) -> f32 {
        self.0 as f32
    }

    pub(in crate::scene) fn f64(&self) -> f64 {
        self.0
    }
}

impl TryFrom<f64> for NonNegative {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        in_range(value, [0.0, MAX_LENGTH].map(f64::from)).map(|()| Self(value as f32))
    }
}

impl TryFrom<f64> for Fraction {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        in_range(value, [0.0, 1.0]).map(|()| Self(value as f32))
    }
}

impl TryFrom<f64> for RefractiveIndex {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        in_range(value, [1.0, 4.0]).map(|()| Self(value as f32))
    }
}

impl Default for RefractiveIndex {
    /// That of window glass.
    fn default() -> Self {
        Self(1.5)
    }
}

impl TryFrom<[f64; 3]> for Vector {
    type Error = String;

    fn try_from(value: [f64; 3]) -> Result<Self, String> {
        value.into_iter().try_for_each(|part| in_range(part, PLACES))?;
        Ok(Self(DVec3::from_array(value)))
    }
}

impl Vector {
    pub(in crate::scene) fn f32(&self) -> Vec3 {
        self.0.as_vec3()
    }
}

impl From<[NonNegative; 3]> for Rgb {
    fn from(value: [NonNegative; 3]) -> Self {
        Self(Vec3::from_array(value.map(|value| value.0)))
    }
}

impl TryFrom<i64> for Extent {
    type Error = String;

    fn try_from(value: i64) -> Result<Self, String> {
        in_range(value, [1, MAX_EXTENT.into()])?;
        Ok(Self(value as u32))
    }
}

impl TryFrom<i64> for Count {
    type Error = String;

    fn try_from(value: i64) -> Result<Self, String> {
        in_range(value, [0, MAX_BOUNCES.into()])?;
        Ok(Self(value as u32))
    }
}

/// The table of something that emits light: `[ambient]` or `[emissive.NAME]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct LightColor {
    #[serde(default = "white")]
    color: Rgb,
    radiance: NonNegative,
}

impl LightColor {
    pub(in crate::scene) fn radiance(&self) -> Vec3 {
        self.color.0 * self.radiance.0
    }
}

/// Reads a colour that may be left out.
pub(in crate::scene) fn white() -> Rgb {
    Rgb(Vec3::ONE)
}

/// The default of `shadows`.
pub(in crate::scene) fn yes() -> bool {
    true
}
