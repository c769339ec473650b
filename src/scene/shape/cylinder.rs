//! The side of a cylinder.

use super::{Corners, Kind, Shape, ShapeTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Positive, Vector, zero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use std::f64::consts::TAU;
use toml::Spanned;

/// The side of a cylinder, open at both ends and visible from both sides: K. Suffern, chapter 19.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// The start of the axis.
    pub start: DVec3,
    /// The end of the axis.
    pub end: DVec3,
    /// The radius, greater than zero.
    pub radius: f32,
}

impl Cylinder {
    /// The unit direction of the axis, from the start to the end.
    pub fn axis(&self) -> DVec3 {
        (self.end - self.start).normalize()
    }
}

impl Kind for Cylinder {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { start: self.start - origin, end: self.end - origin, ..self }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        // How far a circle around this axis extends along each axis of the world.
        let squared = self.axis() * self.axis();
        let around = f64::from(self.radius) * (1.0 - squared).max(DVec3::ZERO).map(f64::sqrt);
        Some([self.start.min(self.end) - around, self.start.max(self.end) + around])
    }

    fn reach(&self) -> f64 {
        self.start.length().max(self.end.length()) + f64::from(self.radius)
    }

    fn area(&self) -> Option<f64> {
        Some(TAU * f64::from(self.radius) * self.start.distance(self.end))
    }

    fn corners(&self, _axes: DMat3) -> Corners {
        let (across, other) = self.axis().any_orthonormal_pair();
        let radius = f64::from(self.radius);
        let half = DMat3::from_cols(0.5 * (self.end - self.start), radius * across, radius * other);
        Corners::of_box(0.5 * (self.start + self.end), half)
    }

    fn place(&self) -> [Vec3; 3] {
        [self.start.as_vec3(), self.end.as_vec3(), Vec3::splat(self.radius)]
    }
}

/// The table `[[cylinder]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct CylinderTable {
    start: Vector,
    end: Spanned<Vector>,
    radius: Positive,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

impl ShapeTable for CylinderTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        let shape = Cylinder { start: self.start.0, end: self.end.get_ref().0, radius: self.radius.f32() };
        let length = shape.start.distance(shape.end);
        if length < 1e-6 * shape.start.abs().max(shape.end.abs()).max_element().max(1e-20) {
            return Err(ParseError::at(
                &self.end,
                "end must be another point than start, and not too near it",
            ));
        }
        Ok(shape.into())
    }

    fn material(&self) -> &Spanned<String> {
        &self.material
    }

    fn velocity(&self) -> Vec3 {
        self.velocity.f32()
    }
}
