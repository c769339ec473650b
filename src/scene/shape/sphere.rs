//! A sphere.

use super::{Corners, Kind, Shape, ShapeTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Positive, Vector, zero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use std::f64::consts::TAU;
use toml::Spanned;

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub center: DVec3,
    /// The radius, greater than zero.
    pub radius: f32,
}

impl Kind for Sphere {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { center: self.center - origin, ..self }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some([self.center - f64::from(self.radius), self.center + f64::from(self.radius)])
    }

    fn reach(&self) -> f64 {
        self.center.length() + f64::from(self.radius)
    }

    fn area(&self) -> Option<f64> {
        Some(2.0 * TAU * f64::from(self.radius).powi(2))
    }

    fn corners(&self, axes: DMat3) -> Corners {
        Corners::of_box(self.center, f64::from(self.radius) * axes)
    }

    fn place(&self) -> [Vec3; 3] {
        [self.center.as_vec3(), Vec3::splat(self.radius), Vec3::ZERO]
    }
}

/// The table `[[sphere]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct SphereTable {
    center: Vector,
    radius: Positive,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

impl ShapeTable for SphereTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        Ok(Sphere { center: self.center.0, radius: self.radius.f32() }.into())
    }

    fn material(&self) -> &Spanned<String> {
        &self.material
    }

    fn velocity(&self) -> Vec3 {
        self.velocity.f32()
    }
}
