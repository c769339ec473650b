//! The part of the panel for the light that reaches the film.

use super::widgets::{Layout, tooltip};
use crate::app::panel::Panel;
use crate::settings::{Part, Settings};
use imgui::Ui;

impl Panel {
    pub(super) fn light(&mut self, ui: &Ui, layout: &mut Layout) {
        self.rows(ui, Part::Light, layout);
        if let Some([of_lens, at_iso_100]) = exposure_values(&self.settings) {
            ui.text(format!("exposure value {of_lens:.1} ({at_iso_100:.1} at ISO 100)"));
            tooltip(
                ui,
                "log2(N^2 / t), where N is the f-number and t the shutter time in seconds. The number at ISO 100 is for the same brightness with film of ISO 100: full sun is about 15, a lit room about 6.",
            );
        }
    }
}

/// The exposure value of lens and shutter, and that of film of ISO 100 with the same brightness. `None` for a lens that
/// lets in no light.
fn exposure_values(settings: &Settings) -> Option<[f64; 2]> {
    let estimator = &settings.estimator;
    let of_lens = (estimator.f_number().powi(2) / f64::from(estimator.shutter)).log2();
    of_lens.is_finite().then(|| [of_lens, of_lens - (f64::from(settings.view.iso) / 100.0).log2()])
}
