//! Keys that work wherever the pointer is. `ui` lists them.

use super::dialog::Purpose;
use super::ui::Action;
use imgui::{Io, Key, Ui};
use winit::event::WindowEvent;
use winit::keyboard::{Key as WinitKey, ModifiersState, NamedKey};

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
