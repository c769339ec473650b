//! The part of the panel that shows numbers: what is sharp, and what is under the pointer.

use crate::app::panel::Panel;
use crate::renderer::Picked;
use crate::scene::{CameraModel, FRAME_HEIGHT_MM};
use imgui::Ui;

impl Panel {
    pub(super) fn numbers(&self, ui: &Ui, picked: Option<&Picked>) {
        let estimator = &self.settings.estimator;
        let tolerance = f64::from(self.settings.view.tolerance);
        let (camera, lens, height) = (&estimator.camera, &estimator.lens, estimator.size[1]);
        ui.text(format!("{:.0} mm on a 24 mm high frame", camera.focal_length_mm()));
        if estimator.model == CameraModel::ThinLens {
            let [near, far] = camera.depth_of_field(lens, tolerance, height);
            let hyperfocal = camera.hyperfocal_distance(lens, tolerance, height);
            ui.text(format!("sharp from {} to {}", length(near), length(far)));
            ui.text(format!("hyperfocal distance {}", length(hyperfocal)));
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
            let millimetres = pixels.abs() * FRAME_HEIGHT_MM / f64::from(height);
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
