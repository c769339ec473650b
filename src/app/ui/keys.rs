//! The list of what the mouse and the keys do.

use super::icons::{Icon, IconButton};
use super::widgets::Layout;
use crate::app::area::Area;
use crate::app::over_picture::{Over, Place};
use crate::app::theme::{self, COLUMN_GAP, ICON};
use imgui::Ui;

/// What the mouse and the keys do, as shown to the user.
const LIST: [(&str, &str); 25] = [
    ("Right click, F", "focus on what is under the pointer"),
    ("Ctrl + wheel", "move the focal plane"),
    ("Click", "say what is there; while Optics is open, draw its optics"),
    ("Double click", "look there, and orbit around it"),
    ("Drag", "orbit around what the camera looks at"),
    ("Shift + drag, middle drag", "pan"),
    ("Wheel", "come nearer or go away"),
    ("W A S D, Q E", "fly forward, left, back, right; down, up"),
    ("Home", "the scene's own camera"),
    ("V", "view all: move away until all of the scene is in the picture"),
    ("O", "optics"),
    ("C", "compare: hold this picture on the left, or release it"),
    ("P", "pause, and go on"),
    ("H", "hide everything but the picture, or show it"),
    ("Ctrl + Z", "undo"),
    ("Ctrl + Shift + Z, Ctrl + Y", "redo"),
    ("Ctrl + O", "open a file"),
    ("Ctrl + S", "save the picture"),
    ("Ctrl + Shift + S", "save the scene"),
    ("Ctrl + C", "copy the command line that renders it"),
    ("Tab, arrows, Space", "walk through the panel"),
    ("Ctrl + click, Enter", "type a number into a slider, such as 1/250, f/2.8 or 1.2 m"),
    ("Left, right", "move the slider under the pointer a little; with Shift, ten times as far"),
    ("L", "the lesson: six steps that show what a lens does"),
    ("?, F1", "this list"),
];

/// Shows the list over the picture, while it is open, or over the whole window if the picture has no room for it.
pub(super) fn keys(ui: &Ui, open: &mut bool, [picture, window]: [&Area; 2], layout: &mut Layout) {
    if !*open {
        return;
    }
    let widest = |texts: [&str; LIST.len()]| {
        texts.map(|text| ui.calc_text_size(text)[0]).into_iter().fold(0.0, f32::max)
    };
    let column = widest(LIST.map(|(keys, _)| keys)) + COLUMN_GAP;
    let width = column + widest(LIST.map(|(_, meaning)| meaning));
    let area = if Over::room(picture) < width { window } else { picture };
    Over { scrolls: true, ground: theme::OVER_CONTROLS, ..Over::new("##keys", Place::Middle, [width, 0.0]) }
        .draw(ui, area, || {
            let left = ui.cursor_pos()[0];
            ui.align_text_to_frame_padding();
            ui.text("What the mouse and the keys do");
            ui.same_line_with_pos(ui.window_content_region_max()[0] - ICON);
            let plain = theme::plain(ui);
            let help = "Closes the list.";
            let close = IconButton { icon: Icon::Close, name: "Close keys", help, is_on: false, can: true };
            *open = !close.draw(ui, layout);
            drop(plain);
            for (keys, meaning) in LIST {
                ui.text_colored(theme::ACCENT, keys);
                ui.same_line_with_pos(left + column);
                ui.text_wrapped(meaning);
            }
        });
}
