//! The comparison of a held picture with the current one: the line between them and its labels.

use super::widgets::{Layout, note_item};
use crate::app::area::Area;
use crate::app::panel::{Held, Panel};
use crate::app::words::length;
use crate::scene::CameraModel;
use crate::settings::Settings;
use imgui::{Condition, MouseCursor, StyleVar, Ui, WindowFlags};

/// The line can be dragged from this distance, in points.
const REACH: f32 = 6.0;
const LINE: [f32; 4] = [1.0, 1.0, 1.0, 0.85];
const SHADE: [f32; 4] = [0.0, 0.0, 0.0, 0.65];

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
        let _bare = (
            ui.push_style_var(StyleVar::WindowPadding([0.0; 2])),
            ui.push_style_var(StyleVar::WindowMinSize([1.0; 2])),
        );
        ui.window("##divider")
            .position([x - REACH, 0.0], Condition::Always)
            .size([2.0 * REACH, height], Condition::Always)
            .flags(
                WindowFlags::NO_DECORATION
                    | WindowFlags::NO_BACKGROUND
                    | WindowFlags::NO_SAVED_SETTINGS
                    | WindowFlags::NO_DOCKING
                    | WindowFlags::NO_FOCUS_ON_APPEARING
                    | WindowFlags::NO_BRING_TO_FRONT_ON_FOCUS,
            )
            .build(|| {
                ui.invisible_button("##line", [2.0 * REACH, height]);
                note_item(ui, "Divider", layout);
                if ui.is_item_active() {
                    held.share = ((ui.io().mouse_pos[0] - left) / width).clamp(0.0, 1.0);
                }
                if ui.is_item_active() || ui.is_item_hovered() {
                    ui.set_mouse_cursor(Some(MouseCursor::ResizeEW));
                }
            });
        let list = ui.get_background_draw_list();
        list.add_line([x, 0.0], [x, height], SHADE).thickness(4.0).build();
        list.add_line([x, 0.0], [x, height], LINE).thickness(1.5).build();
        let middle = 0.5 * height;
        list.add_circle([x, middle], 9.0, SHADE).filled(true).build();
        list.add_circle([x, middle], 9.0, LINE).thickness(1.5).build();
        for side in [-1.0, 1.0] {
            let tip = x + side * 6.0;
            let back = x + side * 2.5;
            list.add_triangle([tip, middle], [back, middle - 3.5], [back, middle + 3.5], LINE)
                .filled(true)
                .build();
        }
        let label = |text: &str, at_left: bool| {
            let [text_width, text_height] = ui.calc_text_size(text);
            let left = if at_left { x - 18.0 - text_width } else { x + 18.0 };
            let (min, max) = ([left - 6.0, 10.0], [left + text_width + 6.0, 18.0 + text_height]);
            list.add_rect(min, max, SHADE).filled(true).rounding(4.0).build();
            list.add_text([left, 14.0], [1.0; 4], text);
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
