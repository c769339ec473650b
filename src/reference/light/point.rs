//! Light from a point.

use crate::scene::PointLight;
use glam::DVec3;

pub(super) fn arriving(light: &PointLight, from: DVec3) -> (DVec3, f64) {
    let path = light.position - from;
    (path.normalize(), path.length())
}
