//! A clear coat over a matte base.

use super::albedo::Albedo;
use super::layers::Layers;
use super::{Kind, Scatter};
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Plastic;
use glam::DVec3;

fn layers(of: &Plastic, at: &Surface) -> Layers {
    let color = texture::value(&of.color, at);
    let index = f64::from(of.index);
    let coat = ((index - 1.0) / (index + 1.0)).powi(2);
    // Radiance below the coat is larger by the square of the index, so that of even light there, a smaller part leaves.
    let leaves = Albedo::new(None, of.roughness).unreflected(coat) / index.powi(2);
    Layers {
        roughness: of.roughness,
        reflectance: DVec3::splat(coat),
        of_metal: DVec3::ZERO,
        metallic: 0.0,
        base: color / index.powi(2) / (1.0 - color * (1.0 - leaves)),
        coat,
    }
}

impl Kind for Plastic {
    fn sample(&self, at: &Surface, to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        layers(self, at).sample(at, to_viewer, xi)
    }

    fn scattered(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> Option<(DVec3, f64)> {
        layers(self, at).scattered(at, to_light, to_viewer)
    }
}
