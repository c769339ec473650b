//! An axis-aligned box.

use super::{Corners, Kind, Shape, ShapeTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Vector, zero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

/// An axis-aligned box. `lower < upper` holds on every axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box {
    /// The corner with the smallest coordinates.
    pub lower: DVec3,
    /// The corner with the largest coordinates.
    pub upper: DVec3,
}

impl Kind for Box {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { lower: self.lower - origin, upper: self.upper - origin }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some([self.lower, self.upper])
    }

    fn reach(&self) -> f64 {
        self.lower.abs().max(self.upper.abs()).length()
    }

    fn area(&self) -> Option<f64> {
        let size = self.upper - self.lower;
        Some(2.0 * (size.x * size.y + size.y * size.z + size.z * size.x))
    }

    fn corners(&self, _axes: DMat3) -> Corners {
        let half = 0.5 * (self.upper - self.lower);
        Corners::of_box(self.lower + half, DMat3::from_diagonal(half))
    }

    fn place(&self) -> [Vec3; 3] {
        [self.lower.as_vec3(), self.upper.as_vec3(), Vec3::ZERO]
    }
}

/// The table `[[box]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct BoxTable {
    lower: Vector,
    upper: Spanned<Vector>,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

impl ShapeTable for BoxTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        let shape = Box { lower: self.lower.0, upper: self.upper.get_ref().0 };
        if !shape.lower.cmplt(shape.upper).all() {
            return Err(ParseError::at(&self.upper, "upper must be greater than lower on every axis"));
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
