//! A rectangle.

use super::{Corners, Kind, Shape, ShapeTable, Triangle};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Vector, zero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

/// The largest cosine of the angle between the edges in a file: numbers with three digits give a right angle nearly enough.
const MAX_COSINE: f64 = 2e-3;

/// A rectangle, visible from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// A corner.
    pub corner: DVec3,
    /// The two edges from there, which are perpendicular.
    pub edges: [DVec3; 2],
}

impl Rectangle {
    fn vertices(&self) -> [DVec3; 4] {
        let [a, b] = self.edges;
        [self.corner, self.corner + a, self.corner + a + b, self.corner + b]
    }
}

impl Kind for Rectangle {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { corner: self.corner - origin, ..self }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        let [a, b, c, d] = self.vertices();
        Some([a.min(b).min(c).min(d), a.max(b).max(c).max(d)])
    }

    fn reach(&self) -> f64 {
        self.vertices().iter().map(|vertex| vertex.length()).fold(0.0, f64::max)
    }

    fn area(&self) -> Option<f64> {
        let [a, b] = self.edges;
        Some(a.length() * b.length())
    }

    fn corners(&self, _axes: DMat3) -> Corners {
        Corners::new(self.vertices())
    }

    /// Three corners give the fourth, and the order of all four does not depend on the one that the file begins with.
    fn place(&self) -> [Vec3; 3] {
        let mut corners = self.vertices().map(|vertex| vertex.as_vec3());
        corners.sort_by_key(|corner| corner.to_array().map(|coordinate| (coordinate + 0.0).to_bits()));
        let [a, b, c, _] = corners;
        [a, b, c]
    }
}

/// The table `[[rectangle]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct RectangleTable {
    corner: Vector,
    edges: Spanned<[Vector; 2]>,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

impl ShapeTable for RectangleTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        let corner = self.corner.0;
        let [a, b] = [0, 1].map(|edge| self.edges.get_ref()[edge].0);
        if !(Triangle { vertices: [DVec3::ZERO, a, b], normals: None }).has_area() {
            let message = "the two edges have the same direction, or one of them is too short";
            return Err(ParseError::at(&self.edges, message));
        }
        if a.dot(b).abs() > MAX_COSINE * a.length() * b.length() {
            let message = "the two edges of a rectangle must be perpendicular";
            return Err(ParseError::at(&self.edges, message));
        }
        // What rounding has left of a slant is taken from the second edge.
        Ok(Rectangle { corner, edges: [a, b - b.project_onto(a)] }.into())
    }

    fn material(&self) -> &Spanned<String> {
        &self.material
    }

    fn velocity(&self) -> Vec3 {
        self.velocity.f32()
    }
}
