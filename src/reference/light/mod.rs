//! Where light comes from: a file a kind, with the name of its shader in `shaders/light`.

mod background;
mod directional;
mod point;

use crate::scene::{LightKind, Scene};
use glam::DVec3;

/// The direction to a light from a point, and its distance.
pub(super) fn arriving(light: &LightKind, from: DVec3) -> (DVec3, f64) {
    match light {
        LightKind::Point(light) => point::arriving(light, from),
        LightKind::Directional(light) => directional::arriving(light),
    }
}

/// What a ray of this direction sees that meets nothing.
pub(super) fn background(scene: &Scene, direction: DVec3) -> DVec3 {
    background::radiance(&scene.background, direction)
}
