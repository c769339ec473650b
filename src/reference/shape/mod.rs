//! Rays against shapes, by the textbook: a file a kind, with the name of its shader in `shaders/shape`.

mod r#box;
mod cylinder;
mod plane;
mod sphere;
mod triangle;

use super::Ray;
use crate::scene::Shape;
use glam::{DQuat, DVec2, DVec3};

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Along the ray.
    pub distance: f64,
    /// Across the surface, of unit length: outwards, or as the shape is wound.
    pub normal: DVec3,
    /// What light and mirrors see, of unit length, on the same side.
    pub shading_normal: DVec3,
    /// Where on the shape: see the shaders.
    pub uv: DVec2,
}

impl Crossing {
    /// Where light and mirrors see the surface's own normal.
    fn flat(distance: f64, normal: DVec3, uv: DVec2) -> Self {
        Self { distance, normal, shading_normal: normal, uv }
    }
}

/// The coordinates of a vector along two directions across a unit normal: the world's axes x and z, turned with the
/// normal from the vertical that it is nearer to.
fn across_normal(normal: DVec3, vector: DVec3) -> DVec2 {
    let vertical = if normal.y < 0.0 { DVec3::NEG_Y } else { DVec3::Y };
    let turned_back = DQuat::from_rotation_arc(vertical, normal).inverse() * vector;
    DVec2::new(turned_back.x, turned_back.z)
}

/// The nearest crossing farther than `least`.
pub fn crossing(shape: &Shape, ray: Ray, least: f64) -> Option<Crossing> {
    match shape {
        Shape::Sphere(shape) => sphere::crossing(shape, ray, least),
        Shape::Box(shape) => r#box::crossing(shape, ray, least),
        Shape::Triangle(shape) => triangle::crossing(shape, ray, least),
        Shape::Cylinder(shape) => cylinder::crossing(shape, ray, least),
        Shape::Plane(shape) => plane::crossing(shape, ray, least),
    }
}
