//! Keys that work wherever the pointer is. `ui` lists them.

use super::dialog::Purpose;
use super::ui::Action;
use imgui::{Io, Key, Ui};
use winit::event::WindowEvent;
use winit::keyboard::{Key as WinitKey, ModifiersState, NamedKey};

/// A key that has no meaning here.
const SEPARATOR: Key = Key::ScrollLock;

/// The keys that are held, as winit reports them. imgui learns of several changes one frame after the other.
#[derive(Default)]
pub(super) struct HeldKeys {
    modifiers: ModifiersState,
    /// Whether the key that changed last, beside modifiers, was pressed.
    key: bool,
}

impl HeldKeys {
    /// Has imgui handle the release of a modifier in a later frame than the keys that were pressed before it. imgui
    /// knows only the modifiers that are held after all events of a frame. When frames are slow, Ctrl+A would be a
    /// plain A.
    pub(super) fn take(&mut self, event: &WindowEvent, io: &mut Io) {
        match event {
            WindowEvent::ModifiersChanged(held) => self.modify(held.state(), io),
            WindowEvent::KeyboardInput { event, .. } => {
                let modifier = match event.logical_key {
                    WinitKey::Named(NamedKey::Control) => ModifiersState::CONTROL,
                    WinitKey::Named(NamedKey::Shift) => ModifiersState::SHIFT,
                    _ => {
                        self.key = event.state.is_pressed();
                        return;
                    }
                };
                if !event.state.is_pressed() {
                    self.modify(self.modifiers.difference(modifier), io);
                }
            }
            _ => {}
        }
    }

    /// These modifiers are held now.
    fn modify(&mut self, held: ModifiersState, io: &mut Io) {
        if !held.contains(self.modifiers) {
            // imgui handles one change of a key per frame, and what comes after the second change waits as well.
            io.add_key_event(SEPARATOR, true);
            io.add_key_event(SEPARATOR, false);
        }
        self.modifiers = held;
    }
}

/// The action of the key that was pressed, if it has one.
pub(super) fn pressed(ui: &Ui, held: &HeldKeys) -> Option<Action> {
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
        // After a slow frame, imgui takes a key for held that was let go long ago, maybe after its modifiers.
        let acts = |key: Key| if held.key { ui.is_key_pressed(key) } else { pressed(key) };
        let again = again.into_iter().find(|(key, _)| acts(*key));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches a key that acts again although it was let go: when a frame is slow, both Ctrl+Shift+Z and the release of its
    /// keys are waiting, and what is left in the next frame looks like a Ctrl+Z that is held.
    #[test]
    fn a_key_that_was_let_go_does_not_act_again() {
        let mut imgui = imgui::Context::create();
        imgui.set_ini_filename(None);
        imgui.fonts().build_rgba32_texture();
        imgui.io_mut().display_size = [100.0; 2];
        let mut acts = |is_let_go: bool| {
            let io = imgui.io_mut();
            let mut held = HeldKeys { modifiers: ModifiersState::CONTROL | ModifiersState::SHIFT, key: true };
            for key in [Key::ModCtrl, Key::ModShift, Key::Z] {
                io.add_key_event(key, true);
            }
            if is_let_go {
                held.modify(ModifiersState::CONTROL, io);
                io.add_key_event(Key::ModShift, false);
                held.modify(ModifiersState::empty(), io);
                io.add_key_event(Key::ModCtrl, false);
                io.add_key_event(Key::Z, false);
                held.key = false;
            }
            let acts: Vec<_> = (0..8)
                .filter_map(|_| {
                    imgui.io_mut().delta_time = 0.3;
                    let action = pressed(imgui.new_frame(), &held);
                    imgui.render();
                    action
                })
                .collect();
            for key in [Key::Z, Key::ModShift, Key::ModCtrl] {
                imgui.io_mut().add_key_event(key, false);
            }
            for _ in 0..8 {
                imgui.new_frame();
                imgui.render();
            }
            acts
        };
        assert_eq!(acts(true), [Action::Redo]);
        assert!(acts(false).len() > 2, "a key that is held acts only once");
    }
}
