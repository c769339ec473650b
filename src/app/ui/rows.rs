//! The rows of the panel, made from the list of settings.

use super::sensor::sensor;
use super::tolerance::tolerance;
use super::widgets::{Layout, combo, named, note_item, tooltip};
use crate::scene::PLACES;
use crate::settings::{Access, Choice, Field, Part, Row, Setting, Settings, Slider, Widget, list};
use glam::DVec3;
use imgui::{Drag, SliderFlags, Ui};

/// Draws the rows of a part of the panel. `initial` has the settings that the scene was opened with.
pub(super) fn rows(ui: &Ui, part: Part, settings: &mut Settings, initial: &Settings, layout: &mut Layout) {
    for setting in list::all() {
        if let Some(row) = &setting.row
            && row.part == part
            && (row.shown)(settings)
        {
            draw(ui, setting, row, settings, initial, layout);
        }
    }
}

fn draw(
    ui: &Ui,
    setting: &Setting,
    row: &Row,
    settings: &mut Settings,
    initial: &Settings,
    layout: &mut Layout,
) {
    let Row { label, help, .. } = row;
    match (&row.widget, &setting.access) {
        (Widget::Slider(slider), access) => named(ui, label, help, layout, |id| match access {
            Access::Single(field, _) | Access::Seconds(field, _) => {
                slide(ui, id, slider, field, settings, initial, |end| end, |now| now);
            }
            Access::Double(field, _) => {
                slide(ui, id, slider, field, settings, initial, f64::from, |now| now as f32);
            }
            Access::Whole(field, _) | Access::WholeOrZero(field, ..) => {
                slide(ui, id, slider, field, settings, initial, |end| end as u32, |now| now as f32);
            }
            _ => {}
        }),
        (Widget::Box, Access::Switch(field)) => {
            let mut ticked = (field.get)(settings);
            if tick(ui, label, help, &mut ticked, layout) {
                (field.set)(settings, ticked);
            }
        }
        (Widget::BoxOf { ticked, plain }, Access::Single(field, _)) => {
            let mut is = (field.get)(settings) == *ticked;
            if tick(ui, label, help, &mut is, layout) {
                (field.set)(settings, if is { *ticked } else { *plain });
            }
        }
        (Widget::List, Access::Choice(field, choices)) => {
            choose(ui, row, field, &choices(), settings, layout);
        }
        (Widget::Drag, Access::Vector(field, _)) => {
            named(ui, label, help, layout, |id| drag(ui, id, field, settings));
        }
        (Widget::List, Access::Sensor(field)) => sensor(ui, row, field, settings, layout),
        (Widget::Length, Access::Tolerance(field)) => tolerance(ui, row, field, settings, layout),
        _ => {}
    }
}

/// Draws a slider. A value that the user does not change keeps every bit.
#[allow(clippy::too_many_arguments, reason = "the last two arguments depend on the type")]
fn slide<T: imgui::internal::DataTypeKind>(
    ui: &Ui,
    id: String,
    slider: &Slider,
    field: &Field<T>,
    settings: &mut Settings,
    initial: &Settings,
    of: fn(f32) -> T,
    shown: fn(T) -> f32,
) {
    let [low, high] = (slider.range)(initial).map(of);
    let mut now = (field.get)(settings);
    let mut flags = SliderFlags::ALWAYS_CLAMP;
    flags.set(SliderFlags::LOGARITHMIC, slider.logarithmic);
    flags.set(SliderFlags::NO_ROUND_TO_FORMAT, !slider.rounds);
    let format = (slider.format)(shown(now));
    if ui.slider_config(id, low, high).display_format(format).flags(flags).build(&mut now) {
        (field.set)(settings, now);
    }
}

fn tick(ui: &Ui, label: &'static str, help: &str, ticked: &mut bool, layout: &mut Layout) -> bool {
    let changed = ui.checkbox(label, ticked);
    note_item(ui, label, layout);
    tooltip(ui, help);
    changed
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
    let shown = choices.iter().find(|choice| choice.name == now).map_or(row.label, |choice| choice.label);
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
fn drag(ui: &Ui, id: String, field: &Field<DVec3>, settings: &mut Settings) {
    let before = settings.estimator.camera;
    let mut parts = (field.get)(settings).to_array();
    let changed = Drag::new(id)
        .range(PLACES[0], PLACES[1])
        .speed((0.002 * before.eye.distance(before.look_at)) as f32)
        .display_format("%.4g")
        .flags(SliderFlags::NO_ROUND_TO_FORMAT | SliderFlags::ALWAYS_CLAMP)
        .build_array(ui, &mut parts);
    if changed {
        (field.set)(settings, DVec3::from_array(parts));
        if !settings.estimator.camera.has_frame() {
            settings.estimator.camera = before;
        }
    }
}
