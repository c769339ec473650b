//! The legend of an overlay.

use super::MARGIN;
use crate::app::area::Area;
use crate::settings::{Settings, to_srgb};
use imgui::{Condition, Ui, WindowFlags};

const WIDTH: f32 = 260.0;
/// The height of the bar with the space below it, in points.
const BAR: f32 = 18.0;

/// Draws the legend at the lower right of the picture.
pub(super) fn legend(ui: &Ui, settings: &Settings, area: &Area) {
    let Some(overlay) = settings.view.overlay else {
        return;
    };
    let entry = overlay.entry();
    let labels = (entry.labels)(settings.overlay_scale(overlay), settings.estimator.lens.focal_distance);
    let [right, bottom] = area.max();
    ui.window("##legend")
        .position([right - MARGIN, bottom - MARGIN], Condition::Always)
        .position_pivot([1.0; 2])
        .size([WIDTH, height(ui)], Condition::Always)
        .flags(
            WindowFlags::NO_DECORATION
                | WindowFlags::NO_INPUTS
                | WindowFlags::NO_DOCKING
                | WindowFlags::NO_FOCUS_ON_APPEARING,
        )
        .build(|| {
            ui.text(entry.label);
            bar(ui, entry.colors);
            let [left, middle, right] = &labels;
            let room = ui.content_region_avail()[0];
            ui.text(left);
            for (label, share) in [(middle, 0.5), (right, 1.0)] {
                let [text_width, _] = ui.calc_text_size(label);
                ui.same_line_with_pos(ui.cursor_start_pos()[0] + share * (room - text_width));
                ui.text(label);
            }
        });
}

/// A title, a bar, and a line of labels.
fn height(ui: &Ui) -> f32 {
    let style = ui.clone_style();
    2.0 * (ui.text_line_height() + style.window_padding[1] + style.item_spacing[1]) + BAR
}

/// Draws a bar that blends from colour to colour in linear light, as the overlay does.
fn bar(ui: &Ui, colors: &[[f32; 3]]) {
    let steps = 64;
    let [x, y] = ui.cursor_screen_pos();
    let [width, _] = ui.content_region_avail();
    let list = ui.get_window_draw_list();
    for step in 0..steps {
        let at = (step as f32 + 0.5) / steps as f32 * (colors.len() - 1) as f32;
        let (left, share) = (at as usize, at.fract());
        let linear = [0, 1, 2].map(|c| colors[left][c] + share * (colors[left + 1][c] - colors[left][c]));
        let [from, to] = [step, step + 1].map(|step| x + width * step as f32 / steps as f32);
        list.add_rect([from, y], [to, y + 14.0], linear.map(|level| to_srgb(level.into()) as f32))
            .filled(true)
            .build();
    }
    ui.dummy([width, BAR]);
}
