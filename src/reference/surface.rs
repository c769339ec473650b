//! Points of surfaces, as materials and textures see them.

use super::Ray;
use super::intersect::Hit;
use glam::DVec3;

/// A point of a surface. Surfaces look the same from both sides, so the normals are on the side that the ray comes
/// from.
pub(super) struct Surface {
    pub(super) position: DVec3,
    /// The same point of the shape where it is in the middle of the exposure. Textures read this position, so that a
    /// moving shape takes its colours along.
    pub(super) rest_position: DVec3,
    /// The unit normal of the surface.
    pub(super) normal: DVec3,
    /// The unit normal that shading and mirrors use.
    pub(super) shading_normal: DVec3,
    /// Whether the ray comes from the side that the shape's own normal points away from.
    pub(super) from_behind: bool,
    /// The refractive index beyond the surface, relative to that on the side that the ray comes from.
    pub(super) index_ratio: f64,
    /// The magnitude of the numbers that the position was computed from.
    pub(super) magnitude: f64,
}

impl Surface {
    /// The point where the ray meets the surface.
    pub(super) fn new(ray: &Ray, hit: &Hit) -> Self {
        let position = ray.origin + hit.distance * ray.direction;
        Self {
            position,
            rest_position: position - ray.time * hit.velocity,
            normal: hit.normal,
            shading_normal: hit.shading_normal,
            from_behind: hit.from_behind,
            index_ratio: 1.0,
            magnitude: position.abs().max_element().max(hit.distance),
        }
    }
}
