//! A matte material with a highlight around the direction of the mirrored light.

use super::Kind;
use crate::reference::surface::Surface;
use crate::scene::Phong;
use glam::DVec3;

impl Kind for Phong {
    fn ambient(&self, at: &Surface) -> DVec3 {
        self.matte().ambient(at)
    }

    fn f(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> DVec3 {
        self.matte().f(at, to_light, to_viewer) + highlight(self.ks, self.exponent, at, to_light, to_viewer)
    }
}

/// The share of a light's radiance that the highlight reflects towards the viewer.
pub(super) fn highlight(ks: f32, exponent: f32, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> f64 {
    let mirrored = 2.0 * at.shading_normal.dot(to_light) * at.shading_normal - to_light;
    let cosine = mirrored.dot(to_viewer);
    if ks > 0.0 && cosine > 0.0 { f64::from(ks) * cosine.powf(f64::from(exponent)) } else { 0.0 }
}
