//! The rows of the panel, made from the list of settings.

use super::color::pick_color;
use super::sensor::sensor;
use super::tolerance::tolerance;
use super::widgets::{Layout, beside, combo, heading, note_item, points_at_item, share, tick, tooltip};
use crate::app::panel::Panel;
use crate::app::theme::{self, SLIDER_MARK};
use crate::app::typing::Typing;
use crate::scene::{Depths, PLACES};
use crate::settings::{Access, Choice, Field, Part, Row, Setting, Settings, Slider, Widget, list};
use glam::DVec3;
use imgui::{Drag, Key, MouseButton, SliderFlags, Ui};

/// An arrow key moves a slider by this part of its length, or by ten times as much with Shift.
const STEP: f64 = 0.002;
/// The setting whose slider shows at which depths the picture has something.
const FOCUS: &str = "focal-distance";

impl Panel {
    /// Draws the rows of a part of the panel.
    pub(super) fn rows(&mut self, ui: &Ui, part: Part, layout: &mut Layout) {
        let before = (self.settings.estimator.camera, self.settings.estimator.lens);
        for setting in list::all() {
            if let Some(row) = &setting.row
                && row.part == part
                && (row.shown)(&self.settings)
            {
                self.row(ui, setting, row, layout);
            }
        }
        self.zoom_lock.follow(part, before, &mut self.settings.estimator);
    }

    fn row(&mut self, ui: &Ui, setting: &'static Setting, row: &Row, layout: &mut Layout) {
        let Row { label, help, .. } = row;
        let settings = &mut self.settings;
        match (&row.widget, &setting.access) {
            (Widget::Slider(_) | Widget::Drag | Widget::Length | Widget::Color, _) => {
                self.number(ui, setting, row, layout)
            }
            (Widget::Box, Access::Switch(field)) => {
                let mut ticked = (field.get)(settings);
                if tick(ui, label, help, &mut ticked, layout) {
                    (field.set)(settings, ticked);
                }
            }
            (Widget::BoxOf { ticked, plain }, Access::Single(field, ..)) => {
                let mut is = (field.get)(settings) == *ticked;
                if tick(ui, label, help, &mut is, layout) {
                    (field.set)(settings, if is { *ticked } else { *plain });
                }
            }
            (Widget::List, Access::Sensor(field)) => sensor(ui, row, field, settings, layout),
            (Widget::List, Access::Choice(field, choices)) => {
                choose(ui, row, field, &choices(), settings, layout);
            }
            _ => {}
        }
    }

    /// Draws a row whose value can be typed: its name and its number, and below them the control or the field.
    fn number(&mut self, ui: &Ui, setting: &'static Setting, row: &Row, layout: &mut Layout) {
        let heading = heading(ui, row.label, &setting.shown(&self.settings), row.help);
        if heading.resets && setting.set(&mut self.settings, &setting.get(&self.initial)).is_ok() {
            self.typing = None;
        }
        if self.typing.as_ref().is_some_and(|typing| std::ptr::eq(typing.setting, setting)) {
            self.field(ui);
            note_item(ui, row.label, layout);
            return;
        }
        // A click with Ctrl moves the slider before the field opens. imgui's own flag misses a Ctrl that is released in the
        // frame of the click.
        let ctrl = ui.io().key_ctrl || [Key::LeftCtrl, Key::RightCtrl].iter().any(|key| ui.is_key_down(*key));
        let before = ctrl.then(|| self.settings.clone());
        ui.set_next_item_width(-1.0);
        let id = format!("##{}", row.label);
        // Whether the row has noted and explained its control already, because another item follows it.
        let mut noted = false;
        match (&row.widget, &setting.access) {
            (Widget::Slider(slider), _) => {
                slide(ui, &id, setting, slider, &mut self.settings, &self.initial);
                if setting.flag == FOCUS {
                    let ends = (slider.range)(&self.initial).map(f64::from);
                    mark_depths(ui, &self.depths(), |depth| share(slider.logarithmic, ends, depth));
                }
            }
            (_, Access::Tolerance(field)) => {
                noted = true;
                tolerance(ui, &id, row, field, &mut self.settings, layout);
            }
            (_, Access::Vector(field, _)) => drag(ui, &id, field, &mut self.settings),
            (_, Access::Color(field, _)) => {
                noted = true;
                let right = self.column(ui.io().display_size[0]);
                pick_color(ui, row, field, &mut self.settings, &mut self.picks, right, layout);
            }
            _ => {}
        }
        if !noted {
            note_item(ui, row.label, layout);
            tooltip(ui, row.help);
        }
        let clicked = ui.is_item_hovered() && ui.is_mouse_clicked(MouseButton::Left) && ctrl;
        let twice = ui.is_item_hovered() && ui.is_mouse_double_clicked(MouseButton::Left);
        let by_key = ui.is_item_focused()
            && (ui.is_key_pressed_no_repeat(Key::Enter) || ui.is_key_pressed_no_repeat(Key::KeypadEnter));
        let is_drag = matches!(row.widget, Widget::Drag);
        if heading.types || (clicked && !noted) || (twice && is_drag) || (by_key && !noted) {
            self.settings = before.unwrap_or_else(|| self.settings.clone());
            self.typing = Some(Typing::new(setting, &self.settings));
        } else if let Widget::Slider(slider) = &row.widget {
            // An arrow key also moves imgui's focus, and then imgui takes no notice of the pointer. A focused slider is
            // meant only where the pointer means no other one.
            let focused = ui.is_item_focused() && !ui.io().want_capture_mouse;
            if heading.hovered || points_at_item(ui) || focused {
                self.step(ui, setting, slider);
            }
        }
    }

    /// Moves a slider by a small step if an arrow key is pressed.
    fn step(&mut self, ui: &Ui, setting: &Setting, slider: &Slider) {
        let arrows = [(Key::RightArrow, 1.0), (Key::LeftArrow, -1.0)];
        let pressed = arrows.into_iter().find(|(key, _)| ui.is_key_pressed(*key));
        if let Some((_, direction)) = pressed
            && !ui.is_item_active()
            && !ui.io().want_text_input
            && let Some(now) = setting.number(&self.settings)
        {
            let ends = (slider.range)(&self.initial).map(f64::from);
            let length = STEP * if ui.io().key_shift { 10.0 } else { 1.0 };
            let least = match (&setting.access, slider.decimals) {
                (Access::Whole(..) | Access::WholeOrZero(..), _) => 1.0,
                (_, Some(decimals)) => 10_f64.powi(-decimals),
                _ => 0.0,
            };
            let next = at(slider, ends, share(slider.logarithmic, ends, now) + direction * length);
            let next = if (next - now).abs() < least { now + direction * least } else { next };
            // A value beyond the ends was typed, and goes no further.
            let value = rounded_to(slider, next).clamp(ends[0].min(now), ends[1].max(now));
            setting.set_number(&mut self.settings, value);
        }
    }

    /// Draws the field into which a value is typed. Enter takes it; Escape and a click elsewhere leave it.
    fn field(&mut self, ui: &Ui) {
        let Some(typing) = &mut self.typing else { return };
        typing.drawn = true;
        if typing.without_keyboard == 0 {
            ui.set_keyboard_focus_here();
        }
        let red = typing.refused.is_some().then(|| theme::refused(ui));
        ui.set_next_item_width(-1.0);
        let field = ui.input_text("##typed", &mut typing.text);
        let entered = field.enter_returns_true(true).auto_select_all(true).build();
        drop(red);
        typing.without_keyboard = if ui.is_item_active() { 1 } else { typing.without_keyboard + 1 };
        let left = ui.is_item_deactivated() || typing.without_keyboard > 4;
        match &typing.refused {
            Some(reason) => beside(ui, reason, theme::FAILED_TEXT),
            None => beside(ui, "Enter takes what you type, Escape leaves it.", theme::TEXT),
        }
        let over = if entered { typing.take(&mut self.settings) } else { left };
        if over {
            self.typing = None;
        }
    }

    /// Leaves a field whose row is not drawn any more.
    pub(super) fn leave_hidden_field(&mut self) {
        if let Some(typing) = &mut self.typing
            && !std::mem::take(&mut typing.drawn)
        {
            self.typing = None;
        }
    }
}

/// The number at a position of a slider.
fn at(slider: &Slider, [low, high]: [f64; 2], share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    match share {
        // The ends come out exactly.
        0.0 => low,
        1.0 => high,
        _ if slider.logarithmic => low * (high / low).powf(share),
        _ => low + (high - low) * share,
    }
}

fn rounded_to(slider: &Slider, number: f64) -> f64 {
    slider.decimals.map_or(number, |decimals| {
        let power = 10_f64.powi(decimals);
        (number * power).round() / power
    })
}

/// Draws a slider. A value that the user does not change keeps every bit.
fn slide(ui: &Ui, id: &str, setting: &Setting, slider: &Slider, settings: &mut Settings, initial: &Settings) {
    let ends = (slider.range)(initial).map(f64::from);
    let mut now = share(slider.logarithmic, ends, setting.number(settings).unwrap_or(0.0));
    // imgui's own field reads 1/250 as 1.
    let flags = SliderFlags::NO_INPUT | SliderFlags::NO_ROUND_TO_FORMAT | SliderFlags::ALWAYS_CLAMP;
    let _low = theme::slider(ui, now as f32);
    if ui.slider_config(id, 0.0, 1.0).display_format("").flags(flags).build(&mut now) {
        setting.set_number(settings, rounded_to(slider, at(slider, ends, now)));
    }
}

/// Marks on the slider that was drawn last where the things in the picture are.
fn mark_depths(ui: &Ui, depths: &Depths, share: impl Fn(f64) -> f64) {
    let ([left, _], [right, bottom]) = (ui.item_rect_min(), ui.item_rect_max());
    let place = |depth: f64| left + theme::along_slider(right - left, share(depth) as f32);
    let [height, least] = SLIDER_MARK;
    let color = theme::faded(theme::ACCENT, theme::opacity(ui));
    let list = ui.get_window_draw_list();
    for [near, far] in &depths.shapes {
        let (from, to) = (place(*near), place(*far));
        let from = from.min(0.5 * (from + to - least));
        let corners = ([from, bottom - height], [to.max(from + least), bottom]);
        list.add_rect(corners.0, corners.1, color).filled(true).build();
    }
}

fn choose(
    ui: &Ui,
    row: &Row,
    field: &Field<&'static str>,
    choices: &[Choice],
    settings: &mut Settings,
    layout: &mut Layout,
) {
    let now = (field.get)(settings);
    let shown = choices.iter().find(|choice| choice.name == now).map_or("another", |choice| choice.label);
    combo(ui, row.label, shown, row.help, layout, |layout| {
        for choice in choices {
            if ui.selectable_config(choice.label).selected(choice.name == now).build() {
                (field.set)(settings, choice.name);
            }
            note_item(ui, choice.label, layout);
            tooltip(ui, choice.help);
        }
    });
}

/// Draws three numbers that can be dragged. Values with which the camera would have no view are refused.
fn drag(ui: &Ui, id: &str, field: &Field<DVec3>, settings: &mut Settings) {
    let before = settings.estimator.camera;
    let mut parts = (field.get)(settings).to_array();
    let changed = Drag::new(id)
        .range(PLACES[0], PLACES[1])
        .speed((0.002 * before.eye.distance(before.look_at)) as f32)
        .display_format("%.4g")
        .flags(SliderFlags::NO_INPUT | SliderFlags::NO_ROUND_TO_FORMAT | SliderFlags::ALWAYS_CLAMP)
        .build_array(ui, &mut parts);
    if changed {
        (field.set)(settings, DVec3::from_array(parts));
        if !settings.estimator.camera.has_frame() {
            settings.estimator.camera = before;
        }
    }
}
