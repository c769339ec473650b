//! Lights. Each kind is a file with the name of its shader in `shaders/light`.

mod background;
mod directional;
pub(super) mod lamps;
mod point;
pub(super) mod sky;

use crate::scene::{LightKind, Scene};
use glam::DVec3;

/// The direction from a point to a light, and the distance of the light.
pub(super) fn arriving(light: &LightKind, from: DVec3) -> (DVec3, f64) {
    match light {
        LightKind::Point(light) => point::arriving(light, from),
        LightKind::Directional(light) => directional::arriving(light),
    }
}

/// The radiance along a ray that has this direction and meets no surface.
pub(super) fn background(scene: &Scene, direction: DVec3) -> DVec3 {
    sky::radiance(&scene.background, direction)
}
