//! The part of the panel that says where the camera stands.

use super::widgets::{Layout, named, note_item, tooltip};
use crate::scene::{Camera, MAX_LENGTH, VFOV_DEGREES};
use glam::DVec3;
use imgui::{Drag, SliderFlags, Ui};

/// Edits the camera. Says whether the scene's own is wanted back.
pub(super) fn edit(ui: &Ui, camera: &mut Camera, layout: &mut Layout) -> bool {
    let speed = 0.002 * camera.eye.distance(camera.look_at);
    let vector = |id: String, vector: &mut DVec3| {
        let mut parts = vector.to_array();
        let changed = Drag::new(id)
            .range(-f64::from(MAX_LENGTH), f64::from(MAX_LENGTH))
            .speed(speed as f32)
            .display_format("%.4g")
            .flags(SliderFlags::NO_ROUND_TO_FORMAT | SliderFlags::ALWAYS_CLAMP)
            .build_array(ui, &mut parts);
        if changed {
            *vector = DVec3::from_array(parts);
        }
    };
    let before = *camera;
    named(ui, "Lens centre", "Where the camera stands: x, y up, z.", layout, |id| {
        vector(id, &mut camera.eye)
    });
    named(ui, "Looks at", "A point on the line of sight; orbiting goes around it.", layout, |id| {
        vector(id, &mut camera.look_at);
    });
    if camera.fault().is_some() {
        *camera = before;
    }
    named(
        ui,
        "Field of view",
        "The angle from the lower to the upper edge. The f-number changes with it: the film moves, and the lens stays as wide.",
        layout,
        |id| {
            let mut degrees = camera.vfov_radians.to_degrees();
            let range = [VFOV_DEGREES.start(), VFOV_DEGREES.end()];
            if ui
                .slider_config(id, *range[0], *range[1])
                .display_format("%.1f degrees")
                .flags(SliderFlags::NO_ROUND_TO_FORMAT | SliderFlags::ALWAYS_CLAMP)
                .build(&mut degrees)
            {
                camera.vfov_radians = degrees.to_radians();
            }
        },
    );
    let reset = ui.button("Reset camera");
    note_item(ui, "Reset camera", layout);
    tooltip(ui, "Back to where the scene was opened (Home). Everything else stays.");
    reset
}
