//! The part of the panel that shows numbers: what is sharp, and what is under the pointer.

use super::widgets::{from_end, tooltip};
use crate::app::panel::Panel;
use crate::app::theme;
use crate::app::words::{self, length, with_digits};
use crate::renderer::Picked;
use crate::scene::CameraModel;
use imgui::Ui;

/// The lines of this section: those of the lens, and those of what is under the pointer.
const LINES: usize = 5;

impl Panel {
    pub(super) fn numbers(&mut self, ui: &Ui, picked: Option<&Picked>) {
        let _close = theme::close(ui);
        let top = ui.cursor_pos()[1];
        let depths = self.depths();
        let estimator = &self.settings.estimator;
        let (camera, lens) = (&estimator.camera, &estimator.lens);
        let focused = estimator.focused_camera();
        let seen = format!("{:.1} mm, {:.1}° high", camera.focal_length_mm(), focused.vfov_degrees());
        let of_seen =
            "The focal length, and the angle that the picture shows from its lower to its upper edge.";
        if estimator.model == CameraModel::ThinLens {
            let [near, far] = self.settings.depth_of_field();
            let focused = f64::from(lens.focal_distance);
            let sharp = format!("sharp from {} to {}", length(near), length(far));
            if depths.is_empty() || depths.meet([near, far]) {
                ui.text(sharp);
            } else {
                ui.text_colored(theme::ACCENT, format!("{sharp}: nothing is there"));
            }
            tooltip(
                ui,
                &format!(
                    "The depth of field: what lies between these distances has a circle of confusion of at most {:.2} px. That is the tolerance, which you set below. The orange marks of the focal plane's slider show where things are.",
                    self.settings.tolerance_pixels()
                ),
            );
            let parts = [focused - near, far - focused, far - near].map(|length| with_digits(3, length));
            let sides = format!("{} in front, {} behind", parts[0], parts[1]);
            let all = format!("{sides}, {} in all", parts[2]);
            let fits = ui.calc_text_size(&all)[0] <= ui.content_region_avail()[0];
            ui.text(if fits { all } else { sides });
            tooltip(
                ui,
                "How far the depth of field reaches from the focal plane to the camera and to the horizon.",
            );
            let hyperfocal = format!("hyperfocal at {}", length(self.settings.hyperfocal_distance()));
            let both = format!("{seen}, {hyperfocal}");
            let fits = ui.calc_text_size(&both)[0] <= ui.content_region_avail()[0];
            ui.text(if fits { both } else { hyperfocal });
            tooltip(
                ui,
                &format!(
                    "{of_seen} If the lens is focused at the hyperfocal distance, everything is sharp from half of it to the horizon."
                ),
            );
        } else {
            ui.text(seen);
            tooltip(ui, of_seen);
        }
        self.under_pointer(ui, picked);
        // However many lines there are, what follows stays in its place.
        let height = LINES as f32 * ui.text_line_height_with_spacing();
        ui.set_cursor_pos([ui.cursor_pos()[0], top + height]);
    }

    /// Says what is under the pointer, and how far it is blurred.
    fn under_pointer(&self, ui: &Ui, picked: Option<&Picked>) {
        let Some(picked) = picked else {
            ui.text_disabled("point at something to see its blur");
            return;
        };
        let Some(surface) = &picked.surface else {
            ui.text("background");
            return;
        };
        let [blur, side] = words::blur(&self.settings, surface.point);
        let place = format!(" at {}", length(surface.depth));
        let whole = if side.is_empty() { place.clone() } else { format!("{place}, {side}") };
        // A long name is shortened, so that the side is said. A narrow panel has no room for that.
        let left_by = |text: &str| ui.content_region_avail()[0] - ui.calc_text_size(text)[0];
        let named = |rest: &str| from_end(ui, &surface.material, left_by(rest)) + rest;
        let name_needs = ui.calc_text_size(&surface.material)[0].min(ui.calc_text_size("...name")[0]);
        ui.text(named(if left_by(&whole) >= name_needs { &whole } else { &place }));
        ui.text(&blur);
        tooltip(
            ui,
            "The diameter of its circle of confusion: the spot on the film over which the lens spreads the light of one point.",
        );
    }
}
