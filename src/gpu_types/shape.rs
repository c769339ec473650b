//! Shapes in the form that the shaders read. Each kind of shape has a match arm.

use super::denormal::{flush_denormal, flush_denormals};
use crate::interface::shape;
use crate::scene::{Shaded, Shape};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

/// `ShapeRecord` of shape/record.glsl, in the list and in the tree.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct ShapeRecord {
    pub position: [f32; 3],
    pub material: u32,
    pub a: [f32; 3],
    pub kind: u32,
    pub b: [f32; 3],
    pub index: u32,
}

/// A shape in coordinates whose origin is `origin`. A triangle starts at its widest corner, as its record does.
pub(super) fn on_device(of: &Shaded, origin: DVec3) -> Shaded {
    let shape = match of.shape.seen_from(origin) {
        Shape::Triangle(triangle) => triangle.from_widest_corner().into(),
        other => other,
    };
    Shaded { shape, ..*of }
}

impl ShapeRecord {
    /// The number that the shaders use for a shape's kind.
    pub fn kind(of: &Shape) -> u32 {
        match of {
            Shape::Sphere(_) => shape::SPHERE,
            Shape::Box(_) => shape::BOX,
            Shape::Triangle(_) => shape::TRIANGLE,
            Shape::Cylinder(_) => shape::CYLINDER,
            Shape::Rectangle(_) => shape::RECTANGLE,
            Shape::Disc(_) => shape::DISC,
            Shape::Plane(_) => shape::PLANE,
        }
    }

    /// The record of a shape in the device's coordinates; a triangle must start at its widest corner. `index` is the
    /// place of the shape's velocity and, for shapes of the tree, of its corner normals.
    pub fn new(of: &Shaded, index: u32) -> Self {
        let (position, a, b) = match &of.shape {
            Shape::Sphere(sphere) => (sphere.center.as_vec3(), Vec3::splat(sphere.radius), Vec3::ZERO),
            Shape::Box(of) => (of.lower.as_vec3(), of.upper.as_vec3(), Vec3::ZERO),
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_vec3());
                (a, b - a, c - a)
            }
            Shape::Cylinder(cylinder) => {
                let half = 0.5 * (cylinder.end - cylinder.start);
                let numbers = Vec3::new(cylinder.radius, half.length() as f32, 0.0);
                ((cylinder.start + half).as_vec3(), cylinder.axis().as_vec3(), numbers)
            }
            Shape::Rectangle(rectangle) => {
                let [a, b] = rectangle.edges.map(|edge| edge.as_vec3());
                (rectangle.corner.as_vec3(), a, b)
            }
            Shape::Disc(disc) => (disc.center.as_vec3(), disc.axis().as_vec3(), Vec3::X * disc.radius),
            Shape::Plane(plane) => {
                let normal = plane.normal.as_dvec3().normalize();
                let offset = flush_denormal(normal.dot(plane.point) as f32);
                (normal.as_vec3(), Vec3::X * offset, Vec3::ZERO)
            }
        };
        let [position, a, b] = [position, a, b].map(flush_denormals);
        Self { position, material: of.material, a, kind: Self::kind(&of.shape), b, index }
    }
}
