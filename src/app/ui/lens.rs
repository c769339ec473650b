//! The part of the panel for the lens, the ideal pinhole or the hole.

use super::widgets::{Layout, note_item};
use crate::app::panel::Panel;
use crate::scene::CameraModel;
use crate::settings::Part;
use imgui::Ui;

/// The f-numbers of the full stops, each of which has a button.
const STOPS: [(f64, &str); 11] = [
    (1.2, "f/1.2"),
    (1.4, "f/1.4"),
    (2.0, "f/2"),
    (2.8, "f/2.8"),
    (4.0, "f/4"),
    (5.6, "f/5.6"),
    (8.0, "f/8"),
    (11.0, "f/11"),
    (16.0, "f/16"),
    (22.0, "f/22"),
    (32.0, "f/32"),
];
const STOPS_PER_ROW: usize = 6;

impl Panel {
    /// Draws the list of camera models, the f-number, and a button for each full stop.
    pub(super) fn lens(&mut self, ui: &Ui, layout: &mut Layout) {
        self.rows(ui, Part::Model, layout);
        self.rows(ui, Part::Lens, layout);
        let estimator = &mut self.settings.estimator;
        if estimator.model != CameraModel::ThinLens {
            return;
        }
        let width = (ui.content_region_avail()[0] + 4.0) / STOPS_PER_ROW as f32 - 4.0;
        let _spacing = ui.push_style_var(imgui::StyleVar::ItemSpacing([4.0, 4.0]));
        let _padding = ui.push_style_var(imgui::StyleVar::FramePadding([2.0, 3.0]));
        for (i, (stop, name)) in STOPS.into_iter().enumerate() {
            if i % STOPS_PER_ROW != 0 {
                ui.same_line();
            }
            if ui.button_with_size(name, [width, 0.0]) {
                estimator.set_f_number(stop);
            }
            note_item(ui, name, layout);
        }
    }
}
