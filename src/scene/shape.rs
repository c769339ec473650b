//! Shapes, in world coordinates and scene units.

use glam::{DVec3, Vec3};

/// A shape with the index of its material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaded<T> {
    /// The shape.
    pub shape: T,
    /// Index into [`super::Scene::materials`].
    pub material: u32,
    /// How it moves, in scene units a second. It is where the scene file says in the middle of the exposure,
    /// and takes its checker along. Planes stand still.
    pub velocity: Vec3,
}

impl<T> Shaded<T> {
    /// A shape that stands still.
    pub fn still(shape: T, material: u32) -> Self {
        Self { shape, material, velocity: Vec3::ZERO }
    }

    /// Another shape of the same material and motion.
    pub fn map<U>(&self, other: impl Fn(T) -> U) -> Shaded<U>
    where
        T: Copy,
    {
        Shaded { shape: other(self.shape), material: self.material, velocity: self.velocity }
    }
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub center: DVec3,
    /// Greater than zero.
    pub radius: f32,
}

/// An axis-aligned box, `lower < upper` on every axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The corner with the smallest coordinates.
    pub lower: DVec3,
    /// The corner with the largest coordinates.
    pub upper: DVec3,
}

/// A triangle, seen from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Its corners.
    pub vertices: [DVec3; 3],
    /// Unit normals at the corners, for shading; none: flat. At barycentric `(b1, b2)` the shading
    /// normal is `normalize((1 - b1 - b2) n0 + b1 n1 + b2 n2)`, or the geometric one where that sum is
    /// zero, turned to the side of the geometric normal as wound; then both are turned to the side that
    /// the ray comes from, by the geometric normal.
    pub normals: Option<[Vec3; 3]>,
}

impl Triangle {
    /// Whether it has an area beyond what rounding makes of none, and a normal that can be made a unit vector, in
    /// f32 too.
    pub(super) fn has_area(&self) -> bool {
        let [a, b, c] = self.vertices;
        let longest = (b - a).length_squared().max((c - a).length_squared());
        let area = (b - a).cross(c - a).length_squared();
        area > (1e-9 * longest).powi(2) && area >= f64::from(f32::MIN_POSITIVE)
    }
}

/// An infinite plane, seen from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Any point on it.
    pub point: DVec3,
    /// Across it, of any length but zero.
    pub normal: Vec3,
}

impl Sphere {
    /// The same sphere in coordinates with this origin.
    pub fn seen_from(self, origin: DVec3) -> Self {
        Self { center: self.center - origin, ..self }
    }
}

impl Aabb {
    /// The same box in coordinates with this origin.
    pub fn seen_from(self, origin: DVec3) -> Self {
        Self { lower: self.lower - origin, upper: self.upper - origin }
    }
}

impl Triangle {
    /// The same triangle in coordinates with this origin.
    pub fn seen_from(self, origin: DVec3) -> Self {
        Self { vertices: self.vertices.map(|vertex| vertex - origin), ..self }
    }

    /// The same triangle, wound in the same sense, with the corner first that is opposite its longest edge. From
    /// there the two edges span it with the least loss to rounding.
    pub fn from_widest_corner(self) -> Self {
        let length =
            |corner: usize| self.vertices[(corner + 1) % 3].distance_squared(self.vertices[(corner + 2) % 3]);
        let first = (1..3).fold(0, |best, corner| if length(corner) > length(best) { corner } else { best });
        let order = [0, 1, 2].map(|corner| (first + corner) % 3);
        let normals = self.normals.map(|of| order.map(|corner| of[corner]));
        Self { vertices: order.map(|corner| self.vertices[corner]), normals }
    }
}
