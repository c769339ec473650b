//! Reflects light evenly into all directions.

use super::{Kind, Scatter};
use crate::reference::sampler::concentric_disk;
use crate::reference::shape::around;
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Matte;
use glam::DVec3;
use std::f64::consts::PI;

impl Kind for Matte {
    fn ambient(&self, at: &Surface) -> DVec3 {
        f64::from(self.ka) * texture::value(&self.color, at)
    }

    /// The density is that of the cosine: the direction lies above an even point of the unit disc.
    fn sample(&self, at: &Surface, _to_viewer: DVec3, xi: [f64; 3]) -> Option<Scatter> {
        let [x, z] = concentric_disk([xi[0], xi[1]]);
        let height = (1.0 - x * x - z * z).max(0.0).sqrt();
        let direction = around(at.shading_normal, DVec3::new(x, height, z));
        let weight = f64::from(self.kd) * texture::value(&self.color, at);
        (direction.dot(at.normal) > 0.0).then(|| Scatter { direction, weight, density: Some(height / PI) })
    }

    fn scattered(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> Option<(DVec3, f64)> {
        let cosine = at.shading_normal.dot(to_light);
        Some((cosine * self.f(at, to_light, to_viewer), cosine / PI))
    }

    fn f(&self, at: &Surface, _to_light: DVec3, _to_viewer: DVec3) -> DVec3 {
        f64::from(self.kd) / PI * texture::value(&self.color, at)
    }
}
