//! The comparison of a held picture with the current one: the line between them and its labels.

use super::widgets::{Layout, note_item};
use crate::app::area::Area;
use crate::app::panel::{Held, Panel};
use crate::app::theme::{
    self, DIVIDER_REACH, DIVIDER_SHADE, HANDLE, LABEL_GAP, LABEL_PADDING, LABEL_TOP, MARK, SHADE, STROKE,
};
use crate::app::words::length;
use crate::scene::CameraModel;
use crate::settings::Settings;
use imgui::{Condition, MouseCursor, Ui, WindowFlags};

/// Describes the picture that is held, with its settings.
pub(super) fn held(settings: &Settings, share: f32) -> Held {
    Held { share, words: words(settings) }
}

impl Panel {
    /// Draws the line, and moves it when it is dragged.
    pub(super) fn divider(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) {
        let now = words(&self.settings);
        let Some(held) = &mut self.held else {
            return;
        };
        let ([left, _], [width, height]) = (area.min(), area.size());
        let x = left + (held.share * width).round();
        let _unseen = theme::unseen(ui);
        ui.window("##divider")
            .position([x - DIVIDER_REACH, 0.0], Condition::Always)
            .size([2.0 * DIVIDER_REACH, height], Condition::Always)
            .flags(
                WindowFlags::NO_DECORATION
                    | WindowFlags::NO_BACKGROUND
                    | WindowFlags::NO_SAVED_SETTINGS
                    | WindowFlags::NO_FOCUS_ON_APPEARING
                    | WindowFlags::NO_BRING_TO_FRONT_ON_FOCUS,
            )
            .build(|| {
                ui.invisible_button("##line", [2.0 * DIVIDER_REACH, height]);
                note_item(ui, "Divider", layout);
                if ui.is_item_active() {
                    held.share = ((ui.io().mouse_pos[0] - left) / width).clamp(0.0, 1.0);
                }
                if ui.is_item_active() || ui.is_item_hovered() {
                    ui.set_mouse_cursor(Some(MouseCursor::ResizeEW));
                }
            });
        let list = ui.get_background_draw_list();
        list.add_line([x, 0.0], [x, height], SHADE).thickness(DIVIDER_SHADE).build();
        list.add_line([x, 0.0], [x, height], MARK).thickness(STROKE).build();
        let middle = 0.5 * height;
        list.add_circle([x, middle], HANDLE, SHADE).filled(true).build();
        list.add_circle([x, middle], HANDLE, MARK).thickness(STROKE).build();
        // An arrow to each side.
        for side in [-1.0, 1.0] {
            let at = |share: f32| x + side * share * HANDLE;
            let (above, below) = (middle - 0.4 * HANDLE, middle + 0.4 * HANDLE);
            list.add_triangle([at(0.7), middle], [at(0.3), above], [at(0.3), below], MARK)
                .filled(true)
                .build();
        }
        let label = |text: &str, at_left: bool| {
            let [text_width, text_height] = ui.calc_text_size(text);
            let [across, down] = LABEL_PADDING;
            let beside = LABEL_GAP + across;
            let left = if at_left { x - beside - text_width } else { x + beside };
            let top = LABEL_TOP + down;
            let (min, max) =
                ([left - across, LABEL_TOP], [left + text_width + across, top + text_height + down]);
            list.add_rect(min, max, SHADE).filled(true).rounding(down).build();
            list.add_text([left, top], theme::TEXT, text);
        };
        label(&format!("held: {}", held.words), true);
        label(&now, false);
    }
}

/// The lens or the hole in a few words.
fn words(settings: &Settings) -> String {
    let estimator = &settings.estimator;
    match estimator.model {
        CameraModel::ThinLens if estimator.lens.diameter > 0.0 => {
            let f_number = (1e3 * estimator.f_number()).round() / 1e3;
            format!("f/{f_number}, in focus at {}", length(estimator.lens.focal_distance.into()))
        }
        CameraModel::ThinLens | CameraModel::Pinhole => "pinhole".into(),
        CameraModel::Hole => format!("hole of {}", length(estimator.hole.diameter.into())),
    }
}
