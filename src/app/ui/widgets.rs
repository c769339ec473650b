//! The controls of the panel.

pub(super) use crate::app::panel::Layout;

use crate::app::theme::{
    self, Color, GRIP, LIST_NAME, PANEL_PADDING, SPACING, TOOLTIP_PADDING, TOOLTIP_WIDTH,
};
use imgui::{Condition, ItemHoveredFlags, MouseButton, MouseCursor, TreeNodeFlags, Ui, WindowFlags};
use std::collections::BTreeMap;

/// Draws a control as wide as the panel, with its name above it.
pub(super) fn named(
    ui: &Ui,
    name: &'static str,
    help: &str,
    layout: &mut Layout,
    control: impl FnOnce(String),
) {
    let close = theme::close(ui);
    ui.text(name);
    drop(close);
    ui.set_next_item_width(-1.0);
    control(format!("##{name}"));
    note_item(ui, name, layout);
    tooltip(ui, help);
}

/// What the user does with the name and the number of a row.
pub(super) struct Heading {
    /// The name was clicked twice: the value of the scene is wanted.
    pub(super) resets: bool,
    /// The number was clicked: another one will be typed.
    pub(super) types: bool,
    pub(super) hovered: bool,
}

/// Draws the name of a row, and its number at the right edge.
pub(super) fn heading(ui: &Ui, name: &str, number: &str, help: &str) -> Heading {
    let _close = theme::close(ui);
    ui.text(name);
    tooltip(ui, &format!("{help} A double click resets it to the scene's value."));
    let hovers_name = points_at_item(ui);
    let resets = hovers_name && ui.is_mouse_double_clicked(MouseButton::Left);
    if number.is_empty() {
        return Heading { resets, types: false, hovered: hovers_name };
    }
    // A narrow panel has no room for the same length in another unit.
    let right = ui.window_content_region_max()[0];
    let taken = ui.item_rect_max()[0] - ui.window_pos()[0] + SPACING[0];
    let fits = |number: &str| taken + ui.calc_text_size(number)[0] <= right;
    let short = number.split(" = ").next().unwrap_or(number);
    let number = if fits(number) { number } else { short };
    ui.same_line_with_pos(right - ui.calc_text_size(number)[0]);
    ui.text(number);
    tooltip(ui, "Click it to type another value.");
    let hovers_number = points_at_item(ui);
    if hovers_number {
        ui.set_mouse_cursor(Some(MouseCursor::TextInput));
    }
    let types = hovers_number && ui.is_mouse_clicked(MouseButton::Left);
    Heading { resets, types, hovered: hovers_name || hovers_number }
}

/// Whether the pointer is on the last item, wherever the focus of the keyboard is.
pub(super) fn points_at_item(ui: &Ui) -> bool {
    ui.is_window_hovered() && ui.is_mouse_hovering_rect(ui.item_rect_min(), ui.item_rect_max())
}

/// The position of a number on a slider with these ends, from 0 to 1.
pub(super) fn share(logarithmic: bool, [low, high]: [f64; 2], number: f64) -> f64 {
    let share =
        if logarithmic { (number / low).ln() / (high / low).ln() } else { (number - low) / (high - low) };
    if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) }
}

/// Explains the last item, once the pointer has rested on it for a moment.
pub(super) fn tooltip(ui: &Ui, help: &str) {
    let flags = ItemHoveredFlags::DELAY_NORMAL | ItemHoveredFlags::ALLOW_WHEN_DISABLED;
    if ui.is_item_hovered_with_flags(flags) && !ui.is_item_active() && !help.is_empty() {
        beside(ui, help, theme::TEXT);
    }
}

/// Draws a text beside the window of the last item, so that it covers no control: at its right, or above it, where the
/// picture is. If there is no room for that, it stands below the item.
pub(super) fn beside(ui: &Ui, text: &str, color: Color) {
    let lines = wrapped(text, |line| ui.calc_text_size(line)[0] <= TOOLTIP_WIDTH);
    let line_height = ui.text_line_height();
    let width =
        lines.iter().map(|line| ui.calc_text_size(line)[0]).fold(0.0, f32::max) + 2.0 * TOOLTIP_PADDING;
    let height = lines.len() as f32 * line_height + 2.0 * TOOLTIP_PADDING;
    let ([left, top], [extent, _]) = (ui.window_pos(), ui.window_size());
    let [display_width, display_height] = ui.io().display_size;
    let (min, max) = (ui.item_rect_min(), ui.item_rect_max());
    let (right, above) = (left + extent + TOOLTIP_PADDING, top - TOOLTIP_PADDING - height);
    // As far right as the item, if it fits into the display there.
    let at_item = (display_width - width).clamp(0.0, min[0].max(0.0));
    // Above the sections of the panel, there are other controls and no picture.
    let is_panel = left <= PANEL_PADDING[0];
    let [x, y] = if right + width <= display_width {
        [right, min[1]]
    } else if above >= 0.0 && !is_panel {
        [at_item, above]
    } else {
        [at_item, max[1] + TOOLTIP_PADDING]
    };
    let y = y.min(display_height - height).max(0.0);
    let list = ui.get_foreground_draw_list();
    let corners = ([x, y], [x + width, y + height]);
    let rounding = 0.5 * TOOLTIP_PADDING;
    list.add_rect(corners.0, corners.1, theme::OVER_CONTROLS).filled(true).rounding(rounding).build();
    list.add_rect(corners.0, corners.1, theme::EDGE).rounding(rounding).build();
    for (number, line) in lines.iter().enumerate() {
        let y = y + TOOLTIP_PADDING + number as f32 * line_height;
        list.add_text([x + TOOLTIP_PADDING, y], color, line);
    }
}

/// A text in lines that fit.
pub(super) fn wrapped(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last_mut().expect("there is a line");
        let longer = if last.is_empty() { word.to_owned() } else { format!("{last} {word}") };
        if fits(&longer) || last.is_empty() {
            *last = longer;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// Notes where the last item was drawn: left, top, width and height in physical pixels.
pub(super) fn note_item(ui: &Ui, name: &'static str, layout: &mut Layout) {
    let (min, max) = (ui.item_rect_min(), ui.item_rect_max());
    note(ui, name, min, [max[0] - min[0], max[1] - min[1]], layout);
}

/// A row of items that goes on below where there is no room at the right.
#[derive(Default)]
pub(super) struct Row {
    has_items: bool,
}

impl Row {
    /// Prepares for the next item, which has this width and this distance from the last one.
    pub(super) fn next(&mut self, ui: &Ui, width: f32, gap: f32) {
        if std::mem::replace(&mut self.has_items, true) {
            ui.same_line_with_spacing(0.0, gap);
            if ui.content_region_avail()[0] < width {
                ui.new_line();
            }
        }
    }
}

/// Draws a button. Returns whether it is pressed.
pub(super) fn button(ui: &Ui, label: &'static str, help: &str, layout: &mut Layout) -> bool {
    let pressed = ui.button(label);
    note_item(ui, label, layout);
    tooltip(ui, help);
    pressed
}

/// Draws a button that shows whether what it stands for is on. Returns whether it is pressed.
pub(super) fn toggle(ui: &Ui, label: &'static str, is_on: bool, help: &str, layout: &mut Layout) -> bool {
    let _on = is_on.then(|| theme::on(ui));
    button(ui, label, help, layout)
}

/// Draws a box to tick. Returns whether it changes.
pub(super) fn tick(ui: &Ui, label: &'static str, help: &str, ticked: &mut bool, layout: &mut Layout) -> bool {
    let changed = ui.checkbox(label, ticked);
    note_item(ui, label, layout);
    tooltip(ui, help);
    changed
}

/// Notes where the current window is.
pub(super) fn note_window(ui: &Ui, name: &'static str, layout: &mut Layout) {
    note(ui, name, ui.window_pos(), ui.window_size(), layout);
}

/// Notes where something was drawn, whose place is given in points.
pub(super) fn note(ui: &Ui, name: &'static str, min: [f32; 2], size: [f32; 2], layout: &mut Layout) {
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
    let flat = theme::flat(ui);
    let open = ui.collapsing_header(name, flags);
    drop(flat);
    let ([left, top], [right, _]) = (ui.item_rect_min(), ui.item_rect_max());
    ui.get_window_draw_list().add_line([left, top], [right, top], theme::EDGE).build();
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

/// A path, or as much of its end as fits in this width: the end says more than the start.
pub(super) fn from_end(ui: &Ui, path: &str, width: f32) -> String {
    let fits = |text: &String| ui.calc_text_size(text)[0] <= width;
    let starts = path.char_indices().map(|(at, _)| at).skip(1);
    let shortened = starts.map(|at| format!("...{}", &path[at..]));
    let mut texts = std::iter::once(path.to_owned()).chain(shortened);
    texts.find(fits).unwrap_or_default()
}

/// Draws the name of a drop-down list, and at its right the list with what is chosen. Where that has no room, only the
/// part before its comma is shown.
pub(super) fn combo(
    ui: &Ui,
    name: &'static str,
    shown: &str,
    help: &str,
    layout: &mut Layout,
    choices: impl FnOnce(&mut Layout),
) {
    let left = ui.cursor_pos()[0];
    ui.align_text_to_frame_padding();
    ui.text(name);
    tooltip(ui, help);
    ui.same_line_with_pos(left + ui.calc_text_size(name)[0].max(LIST_NAME) + SPACING[0]);
    ui.set_next_item_width(-1.0);
    // The arrow is as wide as it is high.
    let room = ui.calc_item_width() - ui.frame_height() - 2.0 * ui.clone_style().frame_padding[0];
    let short = shown.split(", ").next().unwrap_or(shown);
    let shown = if ui.calc_text_size(shown)[0] <= room { shown } else { short };
    match ui.begin_combo(format!("##{name}"), shown) {
        Some(_open) => choices(layout),
        // While the list is open, the last item is an entry of it and not the list.
        None => {
            note_item(ui, name, layout);
            tooltip(ui, help);
        }
    }
}

/// An edge of a part of the window, with its length in points.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Right(f32),
    Top(f32),
}

/// Lets the user drag an edge that begins at this place. The strip with which it is grasped lies within the part of the
/// window, where nothing else covers it. Gives the place of the edge while it is dragged.
pub(super) fn edge(
    ui: &Ui,
    name: &'static str,
    [x, y]: [f32; 2],
    side: Side,
    layout: &mut Layout,
) -> Option<f32> {
    let _unseen = theme::unseen(ui);
    let (position, size, cursor, to_edge) = match side {
        Side::Right(length) => ([x - GRIP, y], [GRIP, length], MouseCursor::ResizeEW, 0.5 * GRIP),
        Side::Top(length) => ([x, y], [length, GRIP], MouseCursor::ResizeNS, -0.5 * GRIP),
    };
    let mut place = None;
    ui.window(format!("##{name}"))
        .position(position, Condition::Always)
        .size(size, Condition::Always)
        .flags(
            WindowFlags::NO_DECORATION
                | WindowFlags::NO_BACKGROUND
                | WindowFlags::NO_NAV
                | WindowFlags::NO_SAVED_SETTINGS
                | WindowFlags::NO_FOCUS_ON_APPEARING,
        )
        .build(|| {
            ui.invisible_button("##line", size);
            note_item(ui, name, layout);
            if ui.is_item_active() {
                place = Some(ui.io().mouse_pos[usize::from(matches!(side, Side::Top(_)))] + to_edge);
            }
            if ui.is_item_active() || ui.is_item_hovered() {
                ui.set_mouse_cursor(Some(cursor));
            }
        });
    place
}
