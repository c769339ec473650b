//! Keys that work wherever the pointer is, and the list of all keys.

use super::ui::Action;
use imgui::{Condition, Key, Ui};

/// What the mouse and the keys do, as shown to the user.
const LIST: [(&str, &str); 21] = [
    ("Right click, F", "focus on what is under the pointer"),
    ("Ctrl + wheel", "move the focal plane"),
    ("Click", "draw the optics of this pixel"),
    ("Drag", "orbit around what the camera looks at"),
    ("Shift + drag, middle drag", "pan"),
    ("Wheel", "come nearer or go away"),
    ("W A S D, Q E", "fly forward, left, back, right; down, up"),
    ("Home", "the scene's own camera"),
    ("O", "optics"),
    ("C", "compare: hold this picture on the left, or release it"),
    ("P", "pause, and go on"),
    ("H", "hide everything but the picture, or show it"),
    ("Ctrl + Z", "undo"),
    ("Ctrl + Shift + Z, Ctrl + Y", "redo"),
    ("Ctrl + S", "save the picture"),
    ("Ctrl + Shift + S", "save the scene"),
    ("Ctrl + C", "copy the command line that renders it"),
    ("Tab, arrows, Space", "walk through the panel"),
    ("Ctrl + click, Enter", "type a number into a slider, such as 1/250, f/2.8 or 1.2 m"),
    ("Left, right", "move the slider under the pointer a little; with Shift, ten times as far"),
    ("?, F1", "this list"),
];

/// The modifier keys. imgui knows only their state at the start of a frame. If Ctrl is released in the frame in which
/// its letter is pressed, as happens when frames are slow, that state would miss it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Modifiers {
    pub(super) ctrl: bool,
    pub(super) shift: bool,
    last: [bool; 2],
}

impl Modifiers {
    /// The modifiers of this frame: those that are held now, or were held in the frame before.
    pub(super) fn take(&mut self, ui: &Ui) -> Self {
        let io = ui.io();
        let now = [io.key_ctrl, io.key_shift];
        let [ctrl, shift] = [0, 1].map(|key| now[key] || self.last[key]);
        *self = Self { ctrl, shift, last: now };
        *self
    }
}

/// The action of the key that was pressed, if it has one.
pub(super) fn pressed(ui: &Ui, modifiers: Modifiers) -> Option<Action> {
    let io = ui.io();
    if io.want_text_input {
        return None;
    }
    let pressed = |key: Key| ui.is_key_pressed_no_repeat(key);
    // The character is used and not the key, because each keyboard layout has it on another key.
    if pressed(Key::F1) || io.peek_input_characters().contains('?') {
        return Some(Action::Keys);
    }
    let chosen = if modifiers.ctrl {
        let [undo, save] = if modifiers.shift {
            [Action::Redo, Action::SaveScene]
        } else {
            [Action::Undo, Action::SavePicture]
        };
        let again = [(Key::Z, undo), (Key::Y, Action::Redo)];
        let once = [(Key::S, save), (Key::C, Action::CopyCommand)];
        let again = again.into_iter().find(|(key, _)| ui.is_key_pressed(*key));
        again.or_else(|| once.into_iter().find(|(key, _)| pressed(*key)))
    } else {
        let plain = [
            (Key::O, Action::Optics),
            (Key::C, Action::Compare),
            (Key::P, Action::Pause),
            (Key::H, Action::Hide),
            (Key::Home, Action::ResetCamera),
        ];
        plain.into_iter().find(|(key, _)| pressed(*key))
    };
    chosen.map(|(_, action)| action)
}

/// Shows the list of keys, while it is open.
pub(super) fn help(ui: &Ui, open: &mut bool) {
    if !*open {
        return;
    }
    let [width, height] = ui.io().display_size;
    ui.window("Keys")
        .position([0.5 * width, 0.5 * height], Condition::Always)
        .position_pivot([0.5, 0.5])
        .size_constraints([0.0; 2], [width, height])
        .horizontal_scrollbar(true)
        .always_auto_resize(true)
        .collapsible(false)
        .opened(open)
        .build(|| {
            let column = LIST.iter().map(|(keys, _)| ui.calc_text_size(keys)[0]).fold(0.0, f32::max) + 24.0;
            for (keys, meaning) in LIST {
                ui.text_colored([1.0, 0.85, 0.5, 1.0], keys);
                ui.same_line_with_pos(ui.cursor_start_pos()[0] + column);
                ui.text(meaning);
            }
        });
}
