//! An infinite plane.

use super::{Corners, Kind, Shape, ShapeTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Vector, nonzero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

/// An infinite plane, visible from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Any point on the plane.
    pub point: DVec3,
    /// The normal, of any length but zero.
    pub normal: Vec3,
}

impl Kind for Plane {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { point: self.point - origin, ..self }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        None
    }

    fn reach(&self) -> f64 {
        f64::INFINITY
    }

    fn area(&self) -> Option<f64> {
        None
    }

    fn corners(&self, _axes: DMat3) -> Corners {
        Corners::new([])
    }

    fn place(&self) -> [Vec3; 3] {
        [self.point.as_vec3(), self.normal, Vec3::ZERO]
    }
}

/// The table `[[plane]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct PlaneTable {
    point: Vector,
    normal: Spanned<Vector>,
    material: Spanned<String>,
}

impl ShapeTable for PlaneTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        Ok(Plane { point: self.point.0, normal: nonzero(&self.normal)? }.into())
    }

    fn material(&self) -> &Spanned<String> {
        &self.material
    }

    fn velocity(&self) -> Vec3 {
        Vec3::ZERO
    }
}
