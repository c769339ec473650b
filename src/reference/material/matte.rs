//! Reflects light evenly into all directions.

use super::Kind;
use crate::reference::surface::Surface;
use crate::reference::texture;
use crate::scene::Matte;
use glam::DVec3;
use std::f64::consts::PI;

impl Kind for Matte {
    fn ambient(&self, at: &Surface) -> DVec3 {
        f64::from(self.ka) * texture::value(&self.color, at)
    }

    fn f(&self, at: &Surface, _to_light: DVec3, _to_viewer: DVec3) -> DVec3 {
        f64::from(self.kd) / PI * texture::value(&self.color, at)
    }
}
