//! Rough surfaces of small facets with the distribution GGX: B. Walter et al., EGSR 2007. Directions are local: y goes along
//! the shading normal.

use crate::reference::sampler::concentric_disk;
use crate::reference::shape::local;
use crate::reference::surface::Surface;
use glam::DVec3;
use std::f64::consts::PI;

/// The slopes of the facets, or `None` for a smooth surface.
pub(super) fn alpha(roughness: f32) -> Option<f64> {
    (roughness >= 0.03).then(|| f64::from(roughness).powi(2))
}

/// The direction to the viewer, who is above the horizon of the shading normal.
pub(super) fn viewer(at: &Surface, to_viewer: DVec3) -> DVec3 {
    let viewer = local(at.shading_normal, to_viewer);
    viewer.with_y(viewer.y.max(1e-3)).normalize()
}

/// A facet that the viewer sees, in proportion to its visible area: J. Dupuy and A. Benyoub, CGF 42(8), 2023. The surface is
/// stretched so that its facets form a hemisphere. The viewer sees the half-way normals of a cap.
pub(super) fn visible_facet(viewer: DVec3, alpha: f64, xi: [f64; 2]) -> DVec3 {
    let stretched = DVec3::new(alpha * viewer.x, viewer.y, alpha * viewer.z).normalize();
    let [x, z] = concentric_disk(xi);
    let radius = x.hypot(z);
    let height = 1.0 - radius * radius * (1.0 + stretched.y);
    let wide = (1.0 - height * height).max(0.0).sqrt();
    let turn = if radius > 0.0 { [x / radius, z / radius] } else { [0.0, 0.0] };
    let facet = DVec3::new(wide * turn[0], height, wide * turn[1]) + stretched;
    DVec3::new(alpha * facet.x, facet.y.max(1e-6), alpha * facet.z).normalize()
}

/// The area of facets that others hide from this direction, relative to what can be seen: Smith's function.
fn hidden(direction: DVec3, alpha: f64) -> f64 {
    let tangent = (1.0 - direction.y * direction.y).max(0.0).sqrt() / direction.y;
    ((1.0 + (alpha * tangent).powi(2)).sqrt() - 1.0) / 2.0
}

/// The part of the facets that neither direction is hidden from.
pub(super) fn seen_of_both(viewer: DVec3, other: DVec3, alpha: f64) -> f64 {
    1.0 / (1.0 + hidden(viewer, alpha) + hidden(other, alpha))
}

/// The part of a visible facet's light that no other facet blocks.
pub(super) fn unblocked(viewer: DVec3, other: DVec3, alpha: f64) -> f64 {
    seen_of_both(viewer, other, alpha) * (1.0 + hidden(viewer, alpha))
}

/// The density of facets with this normal, over the area of the surface: the distribution GGX, by the angle to the normal.
pub(super) fn facet_density(facet: DVec3, alpha: f64) -> f64 {
    let squared_tangent = (facet.x * facet.x + facet.z * facet.z) / (facet.y * facet.y);
    let slope = alpha * (1.0 + squared_tangent / (alpha * alpha));
    1.0 / (PI * facet.y.powi(4) * slope * slope)
}

/// The density of the mirrored directions at visible facets, per solid angle: a mirror doubles angles, which divides the
/// density of the facets by 4 cos.
pub(super) fn mirrored_density(viewer: DVec3, facet: DVec3, alpha: f64) -> f64 {
    let cosine = viewer.dot(facet);
    let visible = facet_density(facet, alpha) * cosine / ((1.0 + hidden(viewer, alpha)) * viewer.y);
    visible / (4.0 * cosine)
}
