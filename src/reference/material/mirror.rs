//! A mirror, which may also show highlights of the lights.

use super::phong::highlight;
use super::{Kind, Scatter};
use crate::reference::surface::Surface;
use crate::scene::Mirror;
use glam::{DVec3, Vec3};

/// The direction of the mirror image. The shading normal mirrors. If the result would enter the surface, it is mirrored
/// out of the surface again.
pub(super) fn direction(at: &Surface, to_viewer: DVec3) -> DVec3 {
    let mirrored = 2.0 * to_viewer.dot(at.shading_normal) * at.shading_normal - to_viewer;
    mirrored - 2.0 * mirrored.dot(at.normal).min(0.0) * at.normal
}

impl Kind for Mirror {
    fn f(&self, at: &Surface, to_light: DVec3, to_viewer: DVec3) -> DVec3 {
        DVec3::splat(highlight(self.ks, self.exponent, at, to_light, to_viewer))
    }

    fn mirrored(&self, at: &Surface, to_viewer: DVec3) -> Option<(DVec3, DVec3)> {
        let reflects = self.reflectance != Vec3::ZERO;
        reflects.then(|| (direction(at, to_viewer), self.reflectance.as_dvec3()))
    }

    fn sample(&self, at: &Surface, to_viewer: DVec3, _xi: [f64; 3]) -> Option<Scatter> {
        let (direction, weight) = self.mirrored(at, to_viewer)?;
        Some(Scatter { direction, weight, density: None })
    }
}
