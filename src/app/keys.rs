//! Keys that work wherever the pointer is, and the list of all keys.

use super::dialog::Purpose;
use super::ui::Action;
use imgui::{Condition, Io, Key, Ui};
use winit::event::WindowEvent;
use winit::keyboard::{Key as WinitKey, ModifiersState, NamedKey};

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

/// A key that has no meaning here.
const SEPARATOR: Key = Key::ScrollLock;

/// The modifier keys that are held, as winit reports them.
#[derive(Default)]
pub(super) struct Modifiers(ModifiersState);

impl Modifiers {
    /// Has imgui handle the release of a modifier in a later frame than the keys that were pressed before it. imgui
    /// knows only the modifiers that are held after all events of a frame. When frames are slow, Ctrl+A would be a
    /// plain A.
    pub(super) fn take(&mut self, event: &WindowEvent, io: &mut Io) {
        let held = match event {
            WindowEvent::ModifiersChanged(held) => held.state(),
            WindowEvent::KeyboardInput { event, .. } if !event.state.is_pressed() => {
                self.0.difference(match event.logical_key {
                    WinitKey::Named(NamedKey::Control) => ModifiersState::CONTROL,
                    WinitKey::Named(NamedKey::Shift) => ModifiersState::SHIFT,
                    _ => return,
                })
            }
            _ => return,
        };
        if !held.contains(self.0) {
            // imgui handles one change of a key per frame, and what comes after the second change waits as well.
            io.add_key_event(SEPARATOR, true);
            io.add_key_event(SEPARATOR, false);
        }
        self.0 = held;
    }
}

/// The action of the key that was pressed, if it has one.
pub(super) fn pressed(ui: &Ui) -> Option<Action> {
    let io = ui.io();
    if io.want_text_input {
        return None;
    }
    let pressed = |key: Key| ui.is_key_pressed_no_repeat(key);
    // The character is used and not the key, because each keyboard layout has it on another key.
    if pressed(Key::F1) || io.peek_input_characters().contains('?') {
        return Some(Action::Keys);
    }
    let chosen = if io.key_ctrl {
        let [undo, save] = if io.key_shift {
            [Action::Redo, Action::SaveScene]
        } else {
            [Action::Undo, Action::SavePicture]
        };
        let again = [(Key::Z, undo), (Key::Y, Action::Redo)];
        let open = Action::Browse(Purpose::Open);
        let once = [(Key::O, open), (Key::S, save), (Key::C, Action::CopyCommand)];
        let again = again.into_iter().find(|(key, _)| ui.is_key_pressed(*key));
        again.or_else(|| once.into_iter().find(|(key, _)| pressed(*key)))
    } else {
        let plain = [
            (Key::O, Action::Optics),
            (Key::C, Action::Compare),
            (Key::P, Action::Pause),
            (Key::H, Action::Hide),
            (Key::Home, Action::ResetCamera),
            (Key::V, Action::ViewAll),
            (Key::L, Action::Lesson),
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
