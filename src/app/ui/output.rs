//! The part of the panel for pictures that are rendered to a file, and the lines over the picture for them.

use super::Action;
use super::widgets::{Layout, button, combo, note_item, tick};
use crate::app::area::Area;
use crate::app::panel::Panel;
use crate::app::theme::{FAINT_MARK, GROUND};
use imgui::Ui;

/// The sizes to choose from, in pixels.
const SIZES: [(&str, [u32; 2]); 7] = [
    ("1280 x 720", [1280, 720]),
    ("1920 x 1080", [1920, 1080]),
    ("3840 x 2160", [3840, 2160]),
    ("1800 x 1200, 3:2", [1800, 1200]),
    ("3600 x 2400, 3:2", [3600, 2400]),
    ("1080 x 1080, square", [1080, 1080]),
    ("1080 x 1920, upright", [1080, 1920]),
];
const AS_SHOWN: &str = "As it is shown";

impl Panel {
    pub(super) fn output(&mut self, ui: &Ui, layout: &mut Layout) -> Option<Action> {
        let name = |size: &[u32; 2]| SIZES.iter().find(|(_, known)| known == size).map(|(name, _)| *name);
        let shown = match &self.output {
            None => AS_SHOWN.into(),
            Some(size) => name(size).map_or_else(|| format!("{} x {}", size[0], size[1]), str::to_owned),
        };
        let help = "The size of the picture that is rendered to a file. The picture that is shown has its proportions.";
        let output = &mut self.output;
        combo(ui, "Size of the picture", &shown, help, layout, |layout| {
            let all = SIZES.map(|(name, size)| (name, Some(size)));
            for (name, size) in std::iter::once((AS_SHOWN, None)).chain(all) {
                if ui.selectable_config(name).selected(size == *output).build() {
                    *output = size;
                }
                note_item(ui, name, layout);
            }
        });
        let help = "Divides the picture into thirds, to place things on the lines.";
        tick(ui, "Thirds", help, &mut self.thirds, layout);
        let Some(job) = &self.job else {
            let help = "Renders the picture in this size, with all of its points, to the picture file that is named under Files. Meanwhile you can go on.";
            return button(ui, "Render to file", help, layout).then_some(Action::Render);
        };
        ui.text_wrapped(format!("rendering {}: {}", job.file.display(), job.progress));
        if button(ui, "Stop rendering", "Ends this, and writes no file.", layout) {
            self.job = None;
        }
        None
    }
}

/// Paints what the picture leaves free of the room that it has.
pub(super) fn paint_around(ui: &Ui, room: &Area, area: &Area) {
    if room == area {
        return;
    }
    let ([left, top], [right, bottom]) = (room.min(), room.max());
    let ([x, y], [to_x, to_y]) = (area.min(), area.max());
    let list = ui.get_background_draw_list();
    for (min, max) in [
        ([left, top], [right, y]),
        ([left, to_y], [right, bottom]),
        ([left, y], [x, to_y]),
        ([to_x, y], [right, to_y]),
    ] {
        list.add_rect(min, max, GROUND).filled(true).build();
    }
}

/// Draws the lines that divide the picture into thirds.
pub(super) fn thirds(ui: &Ui, area: &Area) {
    let ([left, top], [width, height]) = (area.min(), area.size());
    let list = ui.get_background_draw_list();
    for third in [1.0 / 3.0, 2.0 / 3.0] {
        let (x, y) = (left + third * width, top + third * height);
        list.add_line([x, top], [x, top + height], FAINT_MARK).build();
        list.add_line([left, y], [left + width, y], FAINT_MARK).build();
    }
}
