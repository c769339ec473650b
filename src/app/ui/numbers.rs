//! The part of the panel that shows numbers: what is sharp, and what is under the pointer.

use crate::app::panel::Panel;
use crate::app::words::{self, length};
use crate::renderer::Picked;
use crate::scene::CameraModel;
use imgui::Ui;

impl Panel {
    pub(super) fn numbers(&self, ui: &Ui, picked: Option<&Picked>) {
        let estimator = &self.settings.estimator;
        let (camera, lens) = (&estimator.camera, &estimator.lens);
        let focused = estimator.focused_camera();
        let seen = format!("{:.1} mm, {:.1}° high", camera.focal_length_mm(), focused.vfov_degrees());
        if estimator.model == CameraModel::ThinLens {
            let [near, far] = self.settings.depth_of_field();
            let focused = f64::from(lens.focal_distance);
            ui.text(format!("sharp from {} to {}", length(near), length(far)));
            let parts = [focused - near, far - focused, far - near].map(length);
            ui.text(format!("{} in front, {} behind, {} in all", parts[0], parts[1], parts[2]));
            ui.text(format!("{seen}, hyperfocal at {}", length(self.settings.hyperfocal_distance())));
        } else {
            ui.text(seen);
        }
        let Some(picked) = picked else {
            ui.text_disabled("point at something to see its blur");
            ui.new_line();
            ui.new_line();
            return;
        };
        let Some(surface) = &picked.surface else {
            ui.text("background");
            ui.new_line();
            ui.new_line();
            return;
        };
        ui.text(format!("{}, {} away", surface.material, length(surface.depth)));
        for line in words::blur(&self.settings, surface.point) {
            ui.text(line);
        }
    }
}
