//! The part of the panel that opens and saves.

use super::widgets::{Layout, combo, named, note_item, tooltip};
use super::{Action, Panel};
use crate::output;
use imgui::Ui;
use std::path::Path;

/// The name that pictures have until another one is typed.
const PICTURE: &str = "thinlens.png";
/// Likewise, of scenes.
const SCENE: &str = "scene.toml";

/// What is typed into the panel's fields.
pub(super) struct Files {
    open: String,
    picture: String,
    scene: String,
}

impl Default for Files {
    fn default() -> Self {
        Self { open: String::new(), picture: free(PICTURE), scene: free(SCENE) }
    }
}

impl Panel {
    pub(super) fn files(&mut self, ui: &Ui, layout: &mut Layout) -> Option<Action> {
        let mut action = None;
        let mut wanted = None;
        combo(ui, "Recent files", "Recent files", "Files that were opened before.", layout, |layout| {
            if self.recent.is_empty() {
                ui.text_disabled("none yet");
            }
            for file in &self.recent {
                if ui.selectable(file) {
                    wanted = Some(file.clone());
                }
                note_item(ui, "Recent file", layout);
            }
        });
        let files = &mut self.files;
        named(
            ui,
            "Open",
            "A scene (.toml), a mesh (.obj), or a picture that thinlens saved (.png, .exr): type its path and press Enter, or drop it on the window.",
            layout,
            |id| {
                if ui.input_text(id, &mut files.open).enter_returns_true(true).build() {
                    wanted = Some(std::mem::take(&mut files.open));
                }
            },
        );
        named(
            ui,
            "Picture file",
            "Where the picture is saved: .png as it is shown, .exr for linear light. It carries its settings, so that it can be opened again.",
            layout,
            |id| {
                ui.input_text(id, &mut files.picture).build();
            },
        );
        let mut button = |name, asks, help| {
            if ui.button(name) {
                action = Some(asks);
            }
            note_item(ui, name, layout);
            tooltip(ui, help);
        };
        button("Save picture", Action::SavePicture, "Writes the picture as it is now (Ctrl+S).");
        ui.same_line();
        button(
            "Copy command line",
            Action::CopyCommand,
            "Puts the command that renders this picture into the clipboard (Ctrl+C).",
        );
        named(
            ui,
            "Scene file",
            "Where the scene is saved, a .toml, with this camera, lens and view. Open it like any other.",
            layout,
            |id| {
                ui.input_text(id, &mut files.scene).build();
            },
        );
        if ui.button("Save scene") {
            action = Some(Action::SaveScene);
        }
        note_item(ui, "Save scene", layout);
        tooltip(
            ui,
            "Writes a scene file with the camera, the lens and the view as they are now (Ctrl+Shift+S).",
        );
        if let Some(file) = wanted {
            self.open(&file);
        }
        action
    }

    /// Where the picture goes.
    pub(in crate::app) fn picture_file(&self) -> &str {
        &self.files.picture
    }

    /// It went there; the next one goes elsewhere.
    pub(in crate::app) fn picture_is_saved(&mut self) {
        self.say(format!("saved {}", self.files.picture));
        self.files.picture = free(&self.files.picture);
    }

    /// Saves the scene, and says so or why not.
    pub(in crate::app) fn save_scene(&mut self) {
        let file = self.files.scene.clone();
        match output::save_scene(&self.settings, Path::new(&file)) {
            Ok(()) => {
                self.say(format!("saved {file}"));
                self.remember(&file);
                self.files.scene = free(&file);
            }
            Err(error) => self.say(error.to_string()),
        }
    }
}

/// The name, or one like it with a number, that no file has yet.
fn free(name: &str) -> String {
    let path = Path::new(name);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // What was numbered before counts on.
    let (stem, first) = match stem.rsplit_once('-').map(|(stem, number)| (stem, number.parse::<u32>())) {
        Some((stem, Ok(number))) => (stem.to_owned(), number),
        _ => (stem.into_owned(), 1),
    };
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let numbered = (first.max(2)..).map(|number| path.with_file_name(format!("{stem}-{number}.{extension}")));
    std::iter::once(path.to_path_buf())
        .chain(numbered)
        .find(|path| !path.exists())
        .map_or_else(|| name.to_owned(), |path| path.display().to_string())
}
