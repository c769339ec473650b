//! A triangle.

use super::{Corners, Kind, Shape, ShapeTable};
use crate::scene::toml::error::ParseError;
use crate::scene::toml::number::{Vector, zero};
use glam::{DMat3, DVec3, Vec3};
use serde::Deserialize;
use toml::Spanned;

/// A triangle, visible from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// The corners.
    pub vertices: [DVec3; 3],
    /// Unit normals at the corners for shading. `None` for a flat triangle. At barycentric coordinates `(b1, b2)`, the
    /// shading normal is `normalize((1 - b1 - b2) n0 + b1 n1 + b2 n2)`, turned to the side of the geometric normal,
    /// which the order of the corners gives. If the sum is zero, it is the geometric normal. If the geometric normal
    /// points away from the origin of the ray, both normals are then reversed.
    pub normals: Option<[Vec3; 3]>,
}

impl Triangle {
    /// Whether the area is more than a rounding error, and whether the normal can be normalized, also in f32.
    pub(in crate::scene) fn has_area(&self) -> bool {
        let [a, b, c] = self.vertices;
        let longest = (b - a).length_squared().max((c - a).length_squared());
        let area = (b - a).cross(c - a).length_squared();
        area > (1e-9 * longest).powi(2) && area >= f64::from(f32::MIN_POSITIVE)
    }

    /// The same triangle with the same winding, starting at the corner opposite the longest edge. The two edges from
    /// that corner span the triangle with the smallest rounding errors.
    pub fn from_widest_corner(self) -> Self {
        let length =
            |corner: usize| self.vertices[(corner + 1) % 3].distance_squared(self.vertices[(corner + 2) % 3]);
        let first = (1..3).fold(0, |best, corner| if length(corner) > length(best) { corner } else { best });
        let order = [0, 1, 2].map(|corner| (first + corner) % 3);
        let normals = self.normals.map(|of| order.map(|corner| of[corner]));
        Self { vertices: order.map(|corner| self.vertices[corner]), normals }
    }
}

impl Kind for Triangle {
    fn seen_from(self, origin: DVec3) -> Self {
        Self { vertices: self.vertices.map(|vertex| vertex - origin), ..self }
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        let [a, b, c] = self.vertices;
        Some([a.min(b).min(c), a.max(b).max(c)])
    }

    fn reach(&self) -> f64 {
        self.vertices.iter().map(|vertex| vertex.length()).fold(0.0, f64::max)
    }

    fn area(&self) -> Option<f64> {
        let [a, b, c] = self.vertices;
        Some(0.5 * (b - a).cross(c - a).length())
    }

    fn corners(&self, _axes: DMat3) -> Corners {
        Corners::new(self.vertices)
    }

    fn place(&self) -> [Vec3; 3] {
        let mut corners = self.vertices.map(|vertex| vertex.as_vec3());
        corners.sort_by_key(|corner| corner.to_array().map(|coordinate| (coordinate + 0.0).to_bits()));
        corners
    }
}

/// The table `[[triangle]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct TriangleTable {
    vertices: Spanned<[Vector; 3]>,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

impl ShapeTable for TriangleTable {
    fn shape(&self) -> Result<Shape, ParseError> {
        let vertices = [0, 1, 2].map(|corner| self.vertices.get_ref()[corner].0);
        let shape = Triangle { vertices, normals: None };
        if !shape.has_area() {
            let message = "the three vertices lie on one line, or too near one another";
            return Err(ParseError::at(&self.vertices, message));
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
