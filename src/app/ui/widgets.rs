//! The controls of the panel.

pub(super) use crate::app::panel::Layout;

use imgui::{TreeNodeFlags, Ui};

/// Draws a control as wide as the panel, with its name above it.
pub(super) fn named(
    ui: &Ui,
    name: &'static str,
    help: &str,
    layout: &mut Layout,
    control: impl FnOnce(String),
) {
    ui.text(name);
    ui.set_next_item_width(-1.0);
    control(format!("##{name}"));
    note_item(ui, name, layout);
    tooltip(ui, help);
}

pub(super) fn tooltip(ui: &Ui, help: &str) {
    if ui.is_item_hovered() && !ui.is_item_active() {
        ui.tooltip(|| {
            let _wrap = ui.push_text_wrap_pos_with_pos(280.0);
            ui.text_wrapped(help);
        });
    }
}

/// Notes where the last item was drawn: left, top, width and height in physical pixels.
pub(super) fn note_item(ui: &Ui, name: &'static str, layout: &mut Layout) {
    let scale = ui.io().display_framebuffer_scale;
    let (min, max) = (ui.item_rect_min(), ui.item_rect_max());
    let pixels = |value: f32, axis: usize| (value * scale[axis]).round() as i32;
    layout.push((
        name,
        [pixels(min[0], 0), pixels(min[1], 1), pixels(max[0] - min[0], 0), pixels(max[1] - min[1], 1)],
    ));
}

/// Draws a part of the panel that can be collapsed.
pub(super) fn section(
    ui: &Ui,
    name: &'static str,
    open: bool,
    layout: &mut Layout,
    content: impl FnOnce(&mut Layout),
) {
    let flags = if open { TreeNodeFlags::DEFAULT_OPEN } else { TreeNodeFlags::empty() };
    let open = ui.collapsing_header(name, flags);
    note_item(ui, name, layout);
    if open {
        content(layout);
    }
}

/// Draws a drop-down list as wide as the panel.
pub(super) fn combo(
    ui: &Ui,
    name: &'static str,
    shown: &str,
    help: &str,
    layout: &mut Layout,
    choices: impl FnOnce(&mut Layout),
) {
    ui.set_next_item_width(-1.0);
    match ui.begin_combo(format!("##{name}"), shown) {
        Some(_open) => choices(layout),
        // While the list is open, the last item is an entry of it and not the list.
        None => {
            note_item(ui, name, layout);
            tooltip(ui, help);
        }
    }
}
