//! A metal: C. Schlick, CGF 13(3), 1994.

use super::microfacet::{
    alpha, facet_density, mirrored_density, seen_of_both, unblocked, viewer, visible_facet,
};
use super::{Kind, Scatter, mirror};
use crate::reference::shape::{around, local};
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Metal;
use glam::DVec3;

/// The fraction of light that a facet reflects.
fn reflectance(color: DVec3, cosine: f64) -> DVec3 {
    color + (1.0 - color) * (1.0 - cosine).max(0.0).powi(5)
}

impl Kind for Metal {
    fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        let color = texture::value(&self.color, at);
        let Some(alpha) = alpha(self.roughness) else {
            let weight = reflectance(color, at.shading_normal.dot(to_viewer));
            return Some(Scatter { direction: mirror::direction(at, to_viewer), weight, density: None });
        };
        let viewer = viewer(at, to_viewer);
        let facet = visible_facet(viewer, alpha, [xi[0], xi[1]]);
        let other = 2.0 * viewer.dot(facet) * facet - viewer;
        let direction = around(at.shading_normal, other);
        let weight = unblocked(viewer, other, alpha) * reflectance(color, viewer.dot(facet));
        let density = Some(mirrored_density(viewer, facet, alpha));
        (other.y > 0.0 && direction.dot(at.normal) > 0.0).then_some(Scatter { direction, weight, density })
    }

    /// The BRDF is D F G / (4 cos cos), with the part G of the facets that neither shades nor hides.
    fn scattered(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> Option<(DVec3, f64)> {
        let alpha = alpha(self.roughness)?;
        let (viewer, light) = (viewer(at, to_viewer), local(at.shading_normal, to_light));
        let facet = (viewer + light).normalize();
        let reflectance = reflectance(texture::value(&self.color, at), viewer.dot(facet));
        let both = facet_density(facet, alpha) * seen_of_both(viewer, light, alpha);
        let brdf = both * reflectance / (4.0 * viewer.y * light.y);
        Some((light.y * brdf, mirrored_density(viewer, facet, alpha)))
    }
}
