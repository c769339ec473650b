//! The legend of an overlay.

use crate::app::area::Area;
use crate::app::over_picture::{Over, Place};
use crate::app::theme::{LEGEND_BAR, LEGEND_WIDTH};
use crate::settings::{Settings, rounded, to_srgb};
use imgui::Ui;

/// Draws the legend at the lower right of the picture.
pub(super) fn legend(ui: &Ui, settings: &Settings, area: &Area) {
    let Some(overlay) = settings.view.overlay else {
        return;
    };
    let entry = overlay.entry();
    let focal_distance = rounded(settings.estimator.lens.focal_distance.into(), 4);
    let labels = (entry.labels)(settings.overlay_scale(overlay), &focal_distance);
    // Where the labels need more room than the colours, the legend becomes wider.
    let widths = labels.each_ref().map(|label| ui.calc_text_size(label)[0]);
    let apart = 2.0 * ui.calc_text_size(" ")[0];
    let [left, middle, right] = widths;
    let needed = if middle > 0.0 { middle + 2.0 * (left.max(right) + apart) } else { left + right + apart };
    let size = [LEGEND_WIDTH.max(needed).max(ui.calc_text_size(entry.label)[0]), 0.0];
    let over = Over { takes_pointer: false, ..Over::new("##legend", Place::LowerRight, size) };
    over.draw(ui, area, || {
        ui.text(entry.label);
        bar(ui, entry.colors);
        let room = ui.content_region_avail()[0];
        for (place, (label, width)) in [0_u8, 1, 2].into_iter().zip(labels.iter().zip(widths)) {
            if place > 0 {
                let share = 0.5 * f32::from(place);
                ui.same_line_with_pos(ui.cursor_start_pos()[0] + share * (room - width));
            }
            ui.text(label);
        }
    });
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
        list.add_rect([from, y], [to, y + LEGEND_BAR], linear.map(|level| to_srgb(level.into()) as f32))
            .filled(true)
            .build();
    }
    ui.dummy([width, LEGEND_BAR]);
}
