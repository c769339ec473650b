//! The material of models: appendix B of the specification of glTF 2.0.

use super::albedo::Albedo;
use super::layers::Layers;
use super::{Kind, Scatter};
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Standard;
use glam::DVec3;

/// What the coat reflects at a right angle: that of the refractive index 1.5.
const COAT: f64 = 0.04;

fn layers(of: &Standard, at: &Surface) -> Layers {
    let color = texture::value(&of.color, at);
    let metallic = f64::from(of.metallic);
    let through = Albedo::new(None, of.roughness).unreflected(COAT);
    Layers {
        roughness: of.roughness,
        reflectance: COAT + metallic * (color - COAT),
        of_metal: color,
        metallic,
        base: (1.0 - metallic) * color / through,
        coat: COAT,
    }
}

impl Kind for Standard {
    fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        layers(self, at).sample(at, to_viewer, xi)
    }

    fn scattered(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> Option<(DVec3, f64)> {
        layers(self, at).scattered(at, to_light, to_viewer)
    }
}
