//! The row of the tolerance: a number, and the list of its units.

use super::widgets::{Layout, note_item, share, tooltip};
use crate::app::theme::{self, SPACING, UNIT_WIDTH};
use crate::scene::{TOLERANCES_MM, TOLERANCES_PIXELS, Tolerance};
use crate::settings::{Field, Row, Settings};
use imgui::{SliderFlags, Ui};

/// Draws the slider and the list. Another unit keeps what is sharp in this picture.
pub(super) fn tolerance(
    ui: &Ui,
    id: &str,
    row: &Row,
    field: &Field<Tolerance>,
    settings: &mut Settings,
    layout: &mut Layout,
) {
    let before = (field.get)(settings);
    let pixels = settings.tolerance_pixels() as f32;
    let mm = settings.mm_of_pixels(1.0) as f32 * pixels;
    let mut now = before;
    ui.set_next_item_width(-(UNIT_WIDTH + SPACING[0]));
    let (number, [low, high]) = match &mut now {
        Tolerance::Film(mm) => (mm, [0.001, 1.0]),
        Tolerance::Pixels(pixels) => (pixels, [0.1, 30.0]),
    };
    let flags = SliderFlags::ALWAYS_CLAMP
        | SliderFlags::LOGARITHMIC
        | SliderFlags::NO_ROUND_TO_FORMAT
        | SliderFlags::NO_INPUT;
    let low_slider = theme::slider(ui, share(true, [low, high].map(f64::from), f64::from(*number)) as f32);
    ui.slider_config(id, low, high).display_format("").flags(flags).build(number);
    drop(low_slider);
    note_item(ui, row.label, layout);
    tooltip(ui, row.help);
    ui.same_line();
    ui.set_next_item_width(-1.0);
    let unit = if matches!(now, Tolerance::Film(_)) { "mm" } else { "pixels" };
    match ui.begin_combo("##unit of the tolerance", unit) {
        Some(_open) => {
            let clamped = |value: f32, [low, high]: [f32; 2]| value.clamp(low, high);
            for (name, of) in [
                ("mm", Tolerance::Film(clamped(mm, TOLERANCES_MM))),
                ("pixels", Tolerance::Pixels(clamped(pixels, TOLERANCES_PIXELS))),
            ] {
                if ui.selectable_config(name).selected(name == unit).build() && name != unit {
                    now = of;
                }
                note_item(ui, name, layout);
            }
        }
        None => {
            note_item(ui, "Tolerance in", layout);
            tooltip(ui, "Millimetres on the film, or pixels of the picture.");
        }
    }
    if now != before {
        (field.set)(settings, now);
    }
}
