//! Rays against the scene.

use super::Ray;
use super::shape::{Crossing, crossing};
use crate::scene::{Scene, Shaded};
use glam::{DVec2, DVec3};

/// A point where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Along the ray.
    pub distance: f64,
    /// Across the surface. Unit length, on the side the ray comes from.
    pub normal: DVec3,
    /// What light and mirrors see: [`crate::scene::Triangle::normals`] interpolated, elsewhere `normal`. Unit length,
    /// within a right angle of `normal`.
    pub shading_normal: DVec3,
    /// Whether the ray comes from where the shape's own normal does not point to: from inside, or from the back.
    pub from_behind: bool,
    /// Where on the shape: see the shaders of the kinds.
    pub uv: DVec2,
    /// Index into [`Scene::materials`].
    pub material: u32,
    /// Of what was hit, in scene units a second.
    pub velocity: DVec3,
}

/// The nearest hit farther than `least`.
pub fn intersect(scene: &Scene, ray: Ray, least: f64) -> Option<Hit> {
    let hits = scene.shapes.iter().filter_map(|of| hit(of, ray, least));
    hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Where the ray meets a shape. To a moving shape it is the ray that moves, the other way.
fn hit(of: &Shaded, ray: Ray, least: f64) -> Option<Hit> {
    let velocity = of.velocity.as_dvec3();
    let seen = Ray { origin: ray.origin - ray.time * velocity, ..ray };
    let Crossing { distance, normal, shading_normal, uv } = crossing(&of.shape, seen, least)?;
    let from_behind = normal.dot(ray.direction) > 0.0;
    let side = if from_behind { -1.0 } else { 1.0 };
    let (normal, shading_normal) = (side * normal, side * shading_normal);
    Some(Hit { distance, normal, shading_normal, from_behind, uv, material: of.material, velocity })
}
