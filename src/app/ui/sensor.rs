//! The row of the sensor: the list of formats.

use super::widgets::{Layout, combo, note_item, tooltip};
use crate::scene::{FORMATS, Sensor};
use crate::settings::{Field, Row, Settings};
use imgui::Ui;

/// Draws the row. A sensor without a name is shown by its sides.
pub(super) fn sensor(
    ui: &Ui,
    row: &Row,
    field: &Field<Sensor>,
    settings: &mut Settings,
    layout: &mut Layout,
) {
    let now = (field.get)(settings);
    let size = format!("{} x {} mm", now.width_mm, now.height_mm);
    let shown = now.format().map_or_else(|| size.clone(), |of| format!("{}, {size}", of.label));
    combo(ui, row.label, &shown, row.help, layout, |layout| {
        for format in &FORMATS {
            if ui.selectable_config(format.label).selected(format.sensor == now).build() {
                (field.set)(settings, format.sensor);
            }
            note_item(ui, format.label, layout);
            tooltip(ui, format.help);
        }
    });
}
