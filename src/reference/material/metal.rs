//! A metal: C. Schlick, CGF 13(3), 1994.

use super::microfacet::{alpha, unblocked, viewer, visible_facet};
use super::{Kind, mirror};
use crate::reference::shape::around;
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Metal;
use glam::DVec3;

impl Kind for Metal {
    fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<(DVec3, DVec3)> {
        let color = texture::value(&self.color, at);
        let reflectance = |cosine: f64| color + (1.0 - color) * (1.0 - cosine).max(0.0).powi(5);
        let Some(alpha) = alpha(self.roughness) else {
            return Some((mirror::direction(at, to_viewer), reflectance(at.shading_normal.dot(to_viewer))));
        };
        let viewer = viewer(at, to_viewer);
        let facet = visible_facet(viewer, alpha, [xi[0], xi[1]]);
        let other = 2.0 * viewer.dot(facet) * facet - viewer;
        let direction = around(at.shading_normal, other);
        let weight = unblocked(viewer, other, alpha) * reflectance(viewer.dot(facet));
        (other.y > 0.0 && direction.dot(at.normal) > 0.0).then_some((direction, weight))
    }
}
