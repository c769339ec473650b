//! A metal.

use super::layers::Layers;
use super::{Kind, Scatter};
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Metal;
use glam::DVec3;

fn layers(of: &Metal, at: &Surface) -> Layers {
    let color = texture::value(&of.color, at);
    Layers {
        roughness: of.roughness,
        reflectance: color,
        of_metal: color,
        metallic: 1.0,
        base: DVec3::ZERO,
        coat: 0.0,
    }
}

impl Kind for Metal {
    fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        layers(self, at).sample(at, to_viewer, xi)
    }

    fn scattered(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> Option<(DVec3, f64)> {
        layers(self, at).scattered(at, to_light, to_viewer)
    }
}
