//! Rough surfaces that lose no light: C. Kulla and A. Conty, SIGGRAPH Courses 2017.

use super::albedo::Albedo;
use super::microfacet::{alpha, facet_density, mirrored_density, seen_of_both, viewer, visible_facet};
use super::{Scatter, mirror};
use crate::reference::sampler::concentric_disk;
use crate::reference::shape::{around, local};
use crate::reference::surface::Surface;
use glam::DVec3;
use std::f64::consts::PI;

/// A surface of facets, and what its light does that the facets do not reflect at once.
pub(super) struct Layers {
    pub(super) roughness: f32,
    /// Of a facet at a right angle.
    pub(super) reflectance: DVec3,
    /// Of facets that lose light to each other, and give it back.
    pub(super) of_metal: DVec3,
    /// The share of metal.
    pub(super) metallic: f64,
    /// What leaves of the light in the base, for each part that enters it and each part that may leave.
    pub(super) base: DVec3,
    /// The reflectance at a right angle of the facets above the base.
    pub(super) coat: f64,
}

/// The fraction of light that a facet reflects: C. Schlick, CGF 13(3), 1994.
pub(super) fn reflected(reflectance: DVec3, cosine: f64) -> DVec3 {
    reflectance + (1.0 - reflectance) * (1.0 - cosine).max(0.0).powi(5)
}

impl Layers {
    fn albedo(&self, cosine: f64) -> Albedo {
        Albedo::new(Some(cosine), self.roughness)
    }

    /// The BRDF of the light that goes on between the facets, times pi.
    fn between(&self, viewer: Albedo, other: Albedo) -> DVec3 {
        let mean = Albedo::new(None, self.roughness);
        // What leaves after two, three and more reflections at facets. After so many, nothing is left.
        let average = self.of_metal + (1.0 - self.of_metal) / 21.0;
        let after = |reflections: i32| {
            average.map(|of| of.powi(reflections)) * (1.0 - mean.all).powi(reflections - 2) * mean.all
        };
        let between: DVec3 = (2..200).map(after).sum();
        let lost = (1.0 - viewer.all) * (1.0 - other.all) / (1.0 - mean.all).max(1e-4);
        self.metallic * lost * between
    }

    /// The BRDF of the light that enters the base, times pi.
    fn below(&self, viewer: Albedo, other: Albedo) -> DVec3 {
        viewer.unreflected(self.coat) * other.unreflected(self.coat) * self.base
    }

    /// The probabilities that a direction comes from the facets, from between them, and from the base.
    fn chances(&self, viewer: Albedo) -> [f64; 3] {
        let mean = Albedo::new(None, self.roughness);
        let facets = self.reflectance * viewer.all + (1.0 - self.reflectance) * viewer.grazing;
        let brings =
            [facets, self.between(viewer, mean), self.below(viewer, mean)].map(|color| color.max_element());
        let all: f64 = brings.iter().sum();
        if all > 0.0 { brings.map(|part| part / all) } else { [1.0, 0.0, 0.0] }
    }

    pub(super) fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        let to_eye = viewer(at, to_viewer);
        let [of_facets, of_between, _] = self.chances(self.albedo(to_eye.y));
        let other = match alpha(self.roughness) {
            _ if xi[2] >= of_facets + of_between => {
                let [x, z] = concentric_disk([xi[0], xi[1]]);
                DVec3::new(x, (1.0 - x * x - z * z).max(0.0).sqrt(), z)
            }
            None => {
                let weight = reflected(self.reflectance, to_eye.y) / of_facets;
                return Some(Scatter { direction: mirror::direction(at, to_viewer), weight, density: None });
            }
            Some(alpha) if xi[2] >= of_facets => direction_between(alpha, [xi[0], xi[1]]),
            Some(alpha) => {
                let facet = visible_facet(to_eye, alpha, [xi[0], xi[1]]);
                2.0 * to_eye.dot(facet) * facet - to_eye
            }
        };
        let direction = around(at.shading_normal, other);
        let (share, density) = self.share_and_density(to_eye, other);
        (other.y > 0.0 && direction.dot(at.normal) > 0.0).then(|| Scatter {
            direction,
            weight: share / density,
            density: Some(density),
        })
    }

    /// `None` if there are only single directions.
    pub(super) fn scattered(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> Option<(DVec3, f64)> {
        let (share, density) =
            self.share_and_density(viewer(at, to_viewer), local(at.shading_normal, to_light));
        (density > 0.0).then_some((share, density))
    }

    /// The BRDF times the cosine of the light, and the density of its direction. The BRDF of the facets is D F G / (4 cos
    /// cos), with the part G of the facets that neither shades nor hides.
    fn share_and_density(&self, viewer: DVec3, light: DVec3) -> (DVec3, f64) {
        let [from, to] = [viewer, light].map(|direction| self.albedo(direction.y.max(0.0)));
        let [of_facets, of_between, of_base] = self.chances(from);
        let share = light.y / PI * (self.between(from, to) + self.below(from, to));
        let density = of_base * light.y / PI;
        let Some(alpha) = alpha(self.roughness) else {
            return (share, density);
        };
        let facet = (viewer + light).normalize();
        let both = facet_density(facet, alpha) * seen_of_both(viewer, light, alpha);
        let brdf = both * reflected(self.reflectance, viewer.dot(facet)) / (4.0 * viewer.y * light.y);
        let density = density
            + of_facets * mirrored_density(viewer, facet, alpha)
            + of_between * density_between(alpha, light.y);
        (share + light.y * brdf, density)
    }
}

/// A direction in which light may leave the space between facets. The share of such directions whose cosine is smaller is
/// `ln(1 + (cos / alpha)^2) / ln(1 + 1 / alpha^2)`.
fn direction_between(alpha: f64, xi: [f64; 2]) -> DVec3 {
    let [x, z] = concentric_disk(xi);
    let radius = x.hypot(z);
    let share = 1.0 - radius * radius;
    let squared = (share * (1.0 + alpha.powi(-2)).ln()).exp() - 1.0;
    let height = alpha * squared.sqrt();
    let wide = (1.0 - height * height).max(0.0).sqrt() / radius.max(1e-6);
    DVec3::new(wide * x, height, wide * z)
}

/// The density of these directions: the derivative of that share by the cosine, over the whole turn.
fn density_between(alpha: f64, cosine: f64) -> f64 {
    2.0 * cosine / (alpha.powi(2) + cosine.powi(2)) / (1.0 + alpha.powi(-2)).ln() / (2.0 * PI)
}
