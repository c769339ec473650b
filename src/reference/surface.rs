//! Points of surfaces, as materials and textures see them.

use super::Ray;
use super::intersect::Hit;
use glam::DVec3;

/// A point of a surface. Both of its sides are alike: the normals are those of the
/// side that the ray comes from.
pub(super) struct Surface {
    pub(super) position: DVec3,
    /// The position where the shape was in the middle of the exposure: it takes its colours along.
    pub(super) on_shape: DVec3,
    /// Across the surface.
    pub(super) normal: DVec3,
    /// What light and mirrors see.
    pub(super) shading_normal: DVec3,
    /// Of the numbers that the position was computed from.
    pub(super) magnitude: f64,
}

impl Surface {
    /// Where the ray meets it.
    pub(super) fn new(ray: &Ray, hit: &Hit) -> Self {
        let position = ray.origin + hit.distance * ray.direction;
        Self {
            position,
            on_shape: position - ray.time * hit.velocity,
            normal: hit.normal,
            shading_normal: hit.shading_normal,
            magnitude: position.abs().max_element().max(hit.distance),
        }
    }
}
