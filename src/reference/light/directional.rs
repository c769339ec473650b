//! Light along parallel lines, from an infinite distance.

use crate::scene::DirectionalLight;
use glam::DVec3;

pub(super) fn arriving(light: &DirectionalLight) -> (DVec3, f64) {
    (light.direction.as_dvec3().normalize(), f64::INFINITY)
}
