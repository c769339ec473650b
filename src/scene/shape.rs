//! Shapes, in world coordinates and scene units.

use glam::Vec3;

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
    pub(super) fn map<U>(&self, other: impl Fn(T) -> U) -> Shaded<U>
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
    pub center: Vec3,
    /// Greater than zero.
    pub radius: f32,
}

/// An axis-aligned box, `lower < upper` on every axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The corner with the smallest coordinates.
    pub lower: Vec3,
    /// The corner with the largest coordinates.
    pub upper: Vec3,
}

/// A triangle, seen from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Its corners.
    pub vertices: [Vec3; 3],
    /// Unit normals at the corners, for shading; none: flat. At barycentric `(b1, b2)` the shading
    /// normal is `normalize((1 - b1 - b2) n0 + b1 n1 + b2 n2)`, or the geometric one where that sum is
    /// zero, turned to the side of the geometric normal as wound; then both are turned to the side that
    /// the ray comes from, by the geometric normal.
    pub normals: Option<[Vec3; 3]>,
}

impl Triangle {
    /// Whether its normal can be made a unit vector, in f32 too.
    pub(super) fn has_area(&self) -> bool {
        let [a, b, c] = self.vertices;
        (b - a).cross(c - a).length_squared() >= f32::MIN_POSITIVE
    }
}

/// An infinite plane, seen from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Any point on it.
    pub point: Vec3,
    /// Across it, of any length but zero.
    pub normal: Vec3,
}
