//! Intersects rays with shapes, by textbook formulas. Each kind is a file with the name of its shader in
//! `shaders/shape`.

mod r#box;
mod cylinder;
mod disc;
mod plane;
mod rectangle;
mod sphere;
mod triangle;

use super::Ray;
use crate::scene::Shape;
use glam::{DQuat, DVec2, DVec3};

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// The distance along the ray.
    pub distance: f64,
    /// The unit normal of the surface, which points outwards, or as the winding of a triangle says.
    pub normal: DVec3,
    /// The unit normal that shading and mirrors use, on the same side.
    pub shading_normal: DVec3,
    /// The surface coordinates: see the shaders of the kinds.
    pub uv: DVec2,
}

impl Crossing {
    /// A crossing whose shading normal is the normal of the surface.
    fn flat(distance: f64, normal: DVec3, uv: DVec2) -> Self {
        Self { distance, normal, shading_normal: normal, uv }
    }
}

/// The rotation that takes the vertical nearest to a unit normal to the normal.
fn from_vertical(normal: DVec3) -> DQuat {
    DQuat::from_rotation_arc(if normal.y < 0.0 { DVec3::NEG_Y } else { DVec3::Y }, normal)
}

/// The coordinates of a vector along two tangents, which are perpendicular to a unit normal. They are the world's axes
/// x and z, turned as the normal is turned from the vertical.
fn tangent_coordinates(normal: DVec3, vector: DVec3) -> DVec2 {
    let turned_back = local(normal, vector);
    DVec2::new(turned_back.x, turned_back.z)
}

/// The coordinates of a vector along these tangents, as x and z, and along the unit normal, as y.
pub(super) fn local(normal: DVec3, vector: DVec3) -> DVec3 {
    let turned_back = from_vertical(normal).inverse() * vector;
    turned_back.with_y(if normal.y < 0.0 { -turned_back.y } else { turned_back.y })
}

/// The vector that has these coordinates: see [`local`].
pub(super) fn around(normal: DVec3, DVec3 { x, y, z }: DVec3) -> DVec3 {
    from_vertical(normal) * DVec3::new(x, if normal.y < 0.0 { -y } else { y }, z)
}

/// The nearest crossing farther than `least`.
pub fn crossing(shape: &Shape, ray: Ray, least: f64) -> Option<Crossing> {
    match shape {
        Shape::Sphere(shape) => sphere::crossing(shape, ray, least),
        Shape::Box(shape) => r#box::crossing(shape, ray, least),
        Shape::Triangle(shape) => triangle::crossing(shape, ray, least),
        Shape::Cylinder(shape) => cylinder::crossing(shape, ray, least),
        Shape::Rectangle(shape) => rectangle::crossing(shape, ray, least),
        Shape::Disc(shape) => disc::crossing(shape, ray, least),
        Shape::Plane(shape) => plane::crossing(shape, ray, least),
    }
}

/// A point of the surface, chosen evenly by two values in [0, 1), and the unit normal there. `None` for a shape without
/// bounds.
pub(super) fn point(shape: &Shape, xi: [f64; 2]) -> Option<(DVec3, DVec3)> {
    match shape {
        Shape::Sphere(shape) => Some(sphere::point(shape, xi)),
        Shape::Box(shape) => Some(r#box::point(shape, xi)),
        Shape::Triangle(shape) => Some(triangle::point(shape, xi)),
        Shape::Cylinder(shape) => Some(cylinder::point(shape, xi)),
        Shape::Rectangle(shape) => Some(rectangle::point(shape, xi)),
        Shape::Disc(shape) => Some(disc::point(shape, xi)),
        Shape::Plane(_) => None,
    }
}
