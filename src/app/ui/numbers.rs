//! The part of the panel that shows numbers: what is sharp, and what is under the pointer.

use crate::app::panel::Panel;
use crate::renderer::Picked;
use crate::scene::CameraModel;
use imgui::Ui;

impl Panel {
    pub(super) fn numbers(&self, ui: &Ui, picked: Option<&Picked>) {
        let estimator = &self.settings.estimator;
        let (camera, lens, height) = (&estimator.camera, &estimator.lens, estimator.size[1]);
        let focused = estimator.focused_camera();
        ui.text(format!("{:.1} mm, {:.1} degrees high", camera.focal_length_mm(), focused.vfov_degrees()));
        if estimator.model == CameraModel::ThinLens {
            let [near, far] = self.settings.depth_of_field();
            let focused = f64::from(lens.focal_distance);
            ui.text(format!("sharp from {} to {}", length(near), length(far)));
            let parts = [focused - near, far - focused, far - near].map(length);
            ui.text(format!("{} in front, {} behind, {} in all", parts[0], parts[1], parts[2]));
            ui.text(format!("hyperfocal distance {}", length(self.settings.hyperfocal_distance())));
        }
        let Some(picked) = picked else {
            ui.text_disabled("point at something to see its blur");
            ui.new_line();
            return;
        };
        let Some(surface) = &picked.surface else {
            ui.text("background");
            ui.new_line();
            return;
        };
        ui.text(format!("{}, {} away", surface.material, length(surface.depth)));
        if estimator.model == CameraModel::ThinLens {
            let pixels = camera.circle_of_confusion(lens, surface.depth, height);
            let millimetres = self.settings.mm_of_pixels(pixels.abs());
            let side = if pixels < 0.0 { "in front" } else { "behind" };
            ui.text(format!("blurred over {:.2} px ({millimetres:.3} mm), {side}", pixels.abs()));
        } else {
            ui.new_line();
        }
    }
}

/// A length with four digits, or "infinity".
pub(super) fn length(value: f64) -> String {
    if value.is_infinite() {
        return "infinity".into();
    }
    let decimals = (3 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 9);
    format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
}
