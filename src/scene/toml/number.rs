//! Numbers of the scene file, checked as they are read, so that an error names their line.

use super::fault::{Fault, fault};
use crate::scene::{MAX_BOUNCES, MAX_EXTENT, MAX_LENGTH, MIN_LENGTH};
use glam::{DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(try_from = "f64")]
pub(in crate::scene) struct Positive(pub(in crate::scene) f64);

#[derive(Deserialize, Default)]
#[serde(try_from = "f64")]
pub(in crate::scene) struct NonNegative(pub(in crate::scene) f32);

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

/// Where a vector may be left out.
pub(in crate::scene) fn zero() -> Vector {
    Vector(DVec3::ZERO)
}

/// A vector that must have a direction.
pub(in crate::scene) fn nonzero(vector: &Spanned<Vector>) -> Result<Vec3, Fault> {
    match vector.get_ref().f32() {
        Vec3::ZERO => Err(fault(vector, "this vector must not be zero")),
        other => Ok(other),
    }
}

const LARGEST: f64 = MAX_LENGTH as f64;

impl TryFrom<f64> for Positive {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        if (f64::from(MIN_LENGTH)..=LARGEST).contains(&value) {
            Ok(Self(value))
        } else {
            Err(format!("{value} must be from {MIN_LENGTH:e} to {LARGEST:e}"))
        }
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
        if (0.0..=LARGEST).contains(&value) {
            Ok(Self(value as f32))
        } else {
            Err(format!("{value} must be from 0 to {LARGEST:e}"))
        }
    }
}

impl TryFrom<[f64; 3]> for Vector {
    type Error = String;

    fn try_from(value: [f64; 3]) -> Result<Self, String> {
        match value.iter().find(|value| !(-LARGEST..=LARGEST).contains(*value)) {
            None => Ok(Self(DVec3::from_array(value))),
            Some(value) => Err(format!("{value} must be from -{LARGEST:e} to {LARGEST:e}")),
        }
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
        match u32::try_from(value) {
            Ok(value @ 1..=MAX_EXTENT) => Ok(Self(value)),
            _ => Err(format!("{value} pixels must be from 1 to {MAX_EXTENT}")),
        }
    }
}

impl TryFrom<i64> for Count {
    type Error = String;

    fn try_from(value: i64) -> Result<Self, String> {
        match u32::try_from(value) {
            Ok(value @ 0..=MAX_BOUNCES) => Ok(Self(value)),
            _ => Err(format!("{value} bounces must be from 0 to {MAX_BOUNCES}")),
        }
    }
}
