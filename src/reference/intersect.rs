//! Intersects rays with the scene.

use super::Ray;
use super::shape::{Crossing, crossing};
use crate::scene::{Scene, Shaded, Shape};
use glam::{DVec2, DVec3};

/// A point where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The distance along the ray.
    pub distance: f64,
    /// The unit normal of the surface, on the side that the ray comes from.
    pub normal: DVec3,
    /// The unit normal that shading and mirrors use: [`crate::scene::Triangle::normals`] interpolated, or `normal` for
    /// other shapes. It is within a right angle of `normal`.
    pub shading_normal: DVec3,
    /// Whether the ray meets the inside or the back of the shape, which its own normal does not point to.
    pub from_behind: bool,
    /// The surface coordinates: see the shaders of the kinds.
    pub uv: DVec2,
    /// The index into [`Scene::materials`].
    pub material: u32,
    /// The velocity of the shape, in scene units per second.
    pub velocity: DVec3,
    /// The shape, where it is in the middle of the exposure.
    pub shape: Shape,
}

/// The nearest hit farther than `least`.
pub fn intersect(scene: &Scene, ray: Ray, least: f64) -> Option<Hit> {
    let hits = scene.shapes.iter().filter_map(|of| hit(of, ray, least));
    hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// The hit of the ray on a shape. In the frame of a moving shape, the shape rests and the ray is displaced the other
/// way.
fn hit(of: &Shaded, ray: Ray, least: f64) -> Option<Hit> {
    let velocity = of.velocity.as_dvec3();
    let seen = Ray { origin: ray.origin - ray.time * velocity, ..ray };
    let Crossing { distance, normal, shading_normal, uv } = crossing(&of.shape, seen, least)?;
    let from_behind = normal.dot(ray.direction) > 0.0;
    let side = if from_behind { -1.0 } else { 1.0 };
    let (normal, shading_normal) = (side * normal, side * shading_normal);
    Some(Hit {
        distance,
        normal,
        shading_normal,
        from_behind,
        uv,
        material: of.material,
        velocity,
        shape: of.shape,
    })
}
