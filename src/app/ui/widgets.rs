//! The controls of the panel.

pub(super) use crate::app::panel::Layout;

use imgui::{StyleColor, TreeNodeFlags, Ui};
use std::collections::BTreeMap;

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
    let (min, max) = (ui.item_rect_min(), ui.item_rect_max());
    note(ui, name, min, [max[0] - min[0], max[1] - min[1]], layout);
}

/// Notes where the current window is.
pub(super) fn note_window(ui: &Ui, name: &'static str, layout: &mut Layout) {
    note(ui, name, ui.window_pos(), ui.window_size(), layout);
}

fn note(ui: &Ui, name: &'static str, min: [f32; 2], size: [f32; 2], layout: &mut Layout) {
    let scale = ui.io().display_framebuffer_scale;
    let pixels = |value: f32, axis: usize| (value * scale[axis]).round() as i32;
    layout.push((name, [pixels(min[0], 0), pixels(min[1], 1), pixels(size[0], 0), pixels(size[1], 1)]));
}

/// Which sections of the panel are open, as far as the user has opened or closed them.
pub(super) type Folds = BTreeMap<String, bool>;

/// Draws a part of the panel that can be collapsed. When it is opened, the panel scrolls so far that all of it is in
/// view, or its beginning if it is too high.
pub(super) fn section(
    ui: &Ui,
    name: &'static str,
    open_at_first: bool,
    folds: &mut Folds,
    layout: &mut Layout,
    content: impl FnOnce(&mut Layout),
) {
    let was_open = folds.get(name).copied().unwrap_or(open_at_first);
    let flags = if was_open { TreeNodeFlags::DEFAULT_OPEN } else { TreeNodeFlags::empty() };
    let open = ui.collapsing_header(name, flags);
    let top = ui.item_rect_min()[1];
    note_item(ui, name, layout);
    if open {
        content(layout);
    }
    if open != was_open {
        folds.insert(name.to_owned(), open);
    }
    if open && !was_open {
        let (view_top, bottom) = (ui.window_pos()[1], ui.cursor_screen_pos()[1]);
        let hidden_below = bottom - (view_top + ui.window_size()[1]);
        ui.set_scroll_y(ui.scroll_y() + hidden_below.min(top - view_top).max(0.0));
    }
}

/// The largest width of a path in a list, in points.
pub(super) const LONGEST: f32 = 420.0;

/// A path, or as much of its end as fits in this width: the end says more than the start.
pub(super) fn from_end(ui: &Ui, path: &str, width: f32) -> String {
    let fits = |text: &String| ui.calc_text_size(text)[0] <= width;
    let starts = path.char_indices().map(|(at, _)| at).skip(1);
    let shortened = starts.map(|at| format!("...{}", &path[at..]));
    let mut texts = std::iter::once(path.to_owned()).chain(shortened);
    texts.find(fits).unwrap_or_default()
}

/// Makes the next button look pressed.
pub(super) fn pressed(ui: &Ui) -> imgui::ColorStackToken<'_> {
    ui.push_style_color(StyleColor::Button, ui.style_color(StyleColor::ButtonActive))
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
