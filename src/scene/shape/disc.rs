//! A flat disc.

use super::{Corners, Kind, Shape, ShapeTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Positive, Vector, nonzero, zero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use std::f64::consts::PI;
use toml::Spanned;

/// A flat disc, visible from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// The centre.
    pub center: DVec3,
    /// The direction that the disc faces, of any length.
    pub normal: Vec3,
    /// The radius, greater than zero.
    pub radius: f32,
}

impl Disc {
    /// The unit normal.
    pub fn axis(&self) -> DVec3 {
        self.normal.as_dvec3().normalize()
    }
}

impl Kind for Disc {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { center: self.center - origin, ..self }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        // How far the rim extends along each axis of the world.
        let squared = self.axis() * self.axis();
        let around = f64::from(self.radius) * (1.0 - squared).max(DVec3::ZERO).map(f64::sqrt);
        Some([self.center - around, self.center + around])
    }

    fn reach(&self) -> f64 {
        self.center.length() + f64::from(self.radius)
    }

    fn area(&self) -> Option<f64> {
        Some(PI * f64::from(self.radius).powi(2))
    }

    fn corners(&self, _axes: DMat3) -> Corners {
        let (across, other) = self.axis().any_orthonormal_pair();
        let [a, b] = [across + other, across - other].map(|corner| f64::from(self.radius) * corner);
        Corners::new([self.center + a, self.center + b, self.center - a, self.center - b])
    }

    /// Discs that face opposite directions have the same points.
    fn place(&self) -> [Vec3; 3] {
        let axis = self.axis().as_vec3();
        let first = axis.to_array().into_iter().find(|part| *part != 0.0);
        let to_one_side = if first < Some(0.0) { -axis } else { axis };
        [self.center.as_vec3(), to_one_side, Vec3::splat(self.radius)]
    }
}

/// The table `[[disc]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct DiscTable {
    center: Vector,
    normal: Spanned<Vector>,
    radius: Positive,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

impl ShapeTable for DiscTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        let normal = nonzero(&self.normal)?;
        Ok(Disc { center: self.center.0, normal, radius: self.radius.f32() }.into())
    }

    fn material(&self) -> &Spanned<String> {
        &self.material
    }

    fn velocity(&self) -> Vec3 {
        self.velocity.f32()
    }
}
