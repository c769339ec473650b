//! A clear body: the laws of Snell and Fresnel.

use super::albedo::Albedo;
use super::microfacet::{alpha, unblocked, viewer, visible_facet};
use super::{Kind, Scatter};
use crate::reference::shape::around;
use crate::reference::surface::Surface;
use crate::scene::Glass;
use glam::DVec3;

/// The share of unpolarized light that is reflected, and the angle of the refracted light to the normal, which there is none
/// of if all light is reflected. `ratio` is the refractive index beyond the surface, relative to that on this side.
fn fresnel(cosine: f64, ratio: f64) -> (f64, Option<f64>) {
    let angle = cosine.min(1.0).acos();
    let sine = angle.sin() / ratio;
    if sine >= 1.0 {
        return (1.0, None);
    }
    let refracted = sine.asin();
    if angle < 1e-6 {
        return (((1.0 - ratio) / (1.0 + ratio)).powi(2), Some(refracted));
    }
    let perpendicular = ((angle - refracted).sin() / (angle + refracted).sin()).powi(2);
    let parallel = ((angle - refracted).tan() / (angle + refracted).tan()).powi(2);
    // Without a change of medium, both angles are equal and nothing is reflected.
    ((perpendicular + parallel) / 2.0, Some(refracted))
}

impl Kind for Glass {
    fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        let alpha = alpha(self.roughness);
        let viewer = viewer(at, to_viewer);
        let facet = alpha.map_or(DVec3::Y, |alpha| visible_facet(viewer, alpha, [xi[0], xi[1]]));
        let (reflected, refracted) = fresnel(viewer.dot(facet), at.index_ratio);
        let side = if xi[2] < reflected { 1.0 } else { -1.0 };
        let other = match refracted {
            Some(angle) if side < 0.0 => {
                // The refracted ray lies in the plane of the viewer and the normal of the facet, on the other side.
                let along = (viewer.dot(facet) * facet - viewer).try_normalize().unwrap_or_default();
                angle.sin() * along - angle.cos() * facet
            }
            _ => 2.0 * viewer.dot(facet) * facet - viewer,
        };
        let direction = around(at.shading_normal, other);
        let leaves = || Albedo::of_glass(viewer.y, self.roughness, at.index_ratio);
        let weight = DVec3::splat(alpha.map_or(1.0, |alpha| unblocked(viewer, other, alpha) / leaves()));
        // Lamps are met by chance alone, so the density does not matter.
        (side * other.y > 0.0 && side * direction.dot(at.normal) > 0.0).then_some(Scatter {
            direction,
            weight,
            density: None,
        })
    }
}
