//! The part of the panel for opening and saving files.

use super::Action;
use super::widgets::{Layout, button, combo, from_end, named, note_item, toggle};
use crate::app::dialog::Purpose;
use crate::app::message::Kind;
use crate::app::panel::Panel;
use crate::app::save_as::SaveAs;
use crate::app::theme::PATH_WIDTH;
use crate::renderer::Progress;
use imgui::Ui;
use std::path::PathBuf;

impl Panel {
    pub(super) fn files(&mut self, ui: &Ui, progress: &Progress, layout: &mut Layout) -> Option<Action> {
        let mut action = None;
        let mut wanted: Option<PathBuf> = None;
        let mut typed = None;
        let count = match self.recent.len() {
            1 => "1 file".into(),
            number => format!("{number} files"),
        };
        combo(ui, "Recent files", &count, "Files that were opened before.", layout, |layout| {
            if self.recent.is_empty() {
                ui.text_disabled("none yet");
            }
            for (number, file) in self.recent.iter().enumerate() {
                // imgui needs an id, because two files may be shown by the same name.
                let _id = ui.push_id_usize(number);
                if ui.selectable(from_end(ui, &file.to_string_lossy(), PATH_WIDTH)) {
                    wanted = Some(file.clone());
                }
                note_item(ui, "Recent file", layout);
            }
        });
        let files = &mut self.files;
        let is_open = self.dialog.is_some();
        let browse = |name, purpose, help, layout: &mut Layout| {
            let mut asks = None;
            ui.disabled(is_open, || {
                asks = button(ui, name, help, layout).then_some(Action::Browse(purpose));
            });
            asks
        };
        let help = "Chooses a scene (.toml), a mesh (.obj), or a picture that thinlens saved (.png, .exr) in a dialog (Ctrl+O).";
        action = browse("Open file ...", Purpose::Open, help, layout).or(action);
        named(
            ui,
            "Open",
            "The same by its path: type it and press Enter. Or drop the file on the window.",
            layout,
            |id| {
                if ui.input_text(id, &mut files.open).enter_returns_true(true).build() {
                    typed = Some(std::mem::take(&mut files.open));
                }
            },
        );
        named(
            ui,
            "Picture file",
            "The file for the picture: .png for the picture as it is shown, .exr for linear light. It contains the settings, so that it can be opened again.",
            layout,
            |id| {
                edit(ui, id, &mut files.picture);
            },
        );
        let help = "Chooses the file in a dialog, and writes the picture as it is now.";
        action = browse("Save picture as ...", Purpose::Save(Kind::Picture), help, layout).or(action);
        let mut ask = |name, is_on, asks, help| {
            if toggle(ui, name, is_on, help, layout) {
                action = Some(asks);
            }
        };
        ask("Save picture", false, Action::SavePicture, "Writes the picture as it is now (Ctrl+S).");
        ui.same_line();
        ui.disabled(progress.samples >= self.settings.samples, || {
            ask(
                "Save when done",
                self.save_when_done,
                Action::SaveWhenDone,
                "Writes the picture once it has all of its points. Press again to change your mind.",
            );
        });
        ask(
            "Copy command line",
            false,
            Action::CopyCommand,
            "Copies the command that renders this picture to the clipboard (Ctrl+C).",
        );
        named(
            ui,
            "Scene file",
            "The .toml file for the scene with this camera, lens and view. It can be opened like any other scene.",
            layout,
            |id| {
                edit(ui, id, &mut files.scene);
            },
        );
        let help =
            "Writes a scene file with the camera, the lens and the view as they are now (Ctrl+Shift+S).";
        if button(ui, "Save scene", help, layout) {
            action = Some(Action::SaveScene);
        }
        ui.same_line();
        let help = "Chooses the file in a dialog, and writes the scene as it is now.";
        action = browse("Save scene as ...", Purpose::Save(Kind::Scene), help, layout).or(action);
        if let Some(file) = wanted {
            self.open(&file);
        }
        if let Some(typed) = typed {
            self.open_typed(&typed);
        }
        action
    }
}

fn edit(ui: &Ui, id: String, save_as: &mut SaveAs) {
    if ui.input_text(id, &mut save_as.file).build() {
        (save_as.offered, save_as.replaces) = (false, false);
    }
}
