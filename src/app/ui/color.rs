//! The row of a colour: a patch, and the window in which another colour is chosen.

use super::widgets::{Layout, note_item, note_window, tooltip};
use crate::app::theme::{self, MARGIN, PADDING, PICKER_WIDTH};
use crate::settings::{Field, Row, Settings, to_linear, to_srgb};
use glam::DVec3;
use imgui::{Condition, Key, MouseButton, Ui, WindowFlags, WindowHoveredFlags};

/// Draws a patch of the colour. A click opens the window in which another one is chosen, or closes it. The window stands
/// at the right of the panel, which ends at `right`. `open` is the name of the row whose window is open.
pub(super) fn pick_color(
    ui: &Ui,
    row: &Row,
    field: &Field<DVec3>,
    settings: &mut Settings,
    open: &mut Option<&'static str>,
    right: f32,
    layout: &mut Layout,
) {
    let mut shown = (field.get)(settings).to_array().map(|channel| to_srgb(channel) as f32);
    let [red, green, blue] = shown;
    let size = [ui.calc_item_width(), ui.frame_height()];
    let patch = ui.color_button_config(format!("##{}", row.label), [red, green, blue, 1.0]).size(size);
    let pressed = patch.tooltip(false).drag_drop(false).build();
    let points_at_patch = ui.is_item_hovered();
    note_item(ui, row.label, layout);
    let was_open = *open == Some(row.label);
    if !was_open {
        tooltip(ui, row.help);
    }
    if pressed {
        *open = (!was_open).then_some(row.label);
    }
    if !was_open || pressed {
        return;
    }
    let mut points_at_window = false;
    beside_panel(ui, right, || {
        ui.set_next_item_width(PICKER_WIDTH);
        let picker = ui.color_picker3_config("##picker", &mut shown);
        let picker = picker.side_preview(false).small_preview(false).options(false).display_rgb(false);
        let changed = picker.display_hex(false).inputs(false).build();
        note_item(ui, "Picker", layout);
        note_window(ui, "Window of the picker", layout);
        if changed {
            let linear = shown.map(|level| to_linear(level.into()));
            (field.set)(settings, DVec3::from_array(linear));
        }
        points_at_window =
            ui.is_window_hovered_with_flags(WindowHoveredFlags::ALLOW_WHEN_BLOCKED_BY_ACTIVE_ITEM);
    });
    // The click also does what it does without the picker: a slider moves at once. The settings stay if the picture is only
    // clicked.
    let clicked = MouseButton::VARIANTS.into_iter().any(|button| ui.is_mouse_clicked(button));
    if (clicked && !points_at_window && !points_at_patch) || ui.is_key_pressed(Key::Escape) {
        *open = None;
    }
}

/// Draws a window at the right of the panel and beside the last item, so that it covers no control.
fn beside_panel(ui: &Ui, right: f32, content: impl FnOnce()) {
    let [display_width, display_height] = ui.io().display_size;
    let widest = PICKER_WIDTH + 2.0 * PADDING;
    // The share of the display above the item is also the share of the window above it. So the window never leaves the
    // display, however high it is.
    let y = ui.item_rect_min()[1].clamp(0.0, display_height);
    let _over = theme::over(ui, theme::OVER_CONTROLS);
    ui.window("##window of the picker")
        .position([(right + MARGIN).min(display_width - widest).max(0.0), y], Condition::Always)
        .position_pivot([0.0, y / display_height])
        .flags(
            WindowFlags::NO_DECORATION
                | WindowFlags::NO_MOVE
                | WindowFlags::NO_SAVED_SETTINGS
                | WindowFlags::ALWAYS_AUTO_RESIZE,
        )
        .build(content);
}
