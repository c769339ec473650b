//! The part of the panel that opens and saves.

use super::widgets::{Layout, combo, named, note_item, tooltip};
use super::{Action, Panel};
use crate::output;
use imgui::Ui;
use std::path::{Path, PathBuf};

/// The name that pictures have until another one is typed.
const PICTURE: &str = "thinlens.png";
/// Likewise, of scenes.
const SCENE: &str = "scene.toml";

/// What is typed into the panel's fields.
pub(super) struct Files {
    open: String,
    picture: SaveAs,
    scene: SaveAs,
}

/// Where something is saved.
struct SaveAs {
    file: String,
    /// Whether nobody typed it: then no file is to be lost.
    offered: bool,
}

impl SaveAs {
    fn new(file: &str) -> Self {
        Self { file: free(file), offered: true }
    }

    fn edit(&mut self, ui: &Ui, id: String) {
        self.offered &= !ui.input_text(id, &mut self.file).build();
    }

    /// The file, now that something is saved.
    fn file(&mut self) -> String {
        if self.offered {
            // There may be one by now.
            self.file = free(&self.file);
        }
        self.file.clone()
    }
}

impl Default for Files {
    fn default() -> Self {
        Self { open: String::new(), picture: SaveAs::new(PICTURE), scene: SaveAs::new(SCENE) }
    }
}

impl Panel {
    pub(super) fn files(&mut self, ui: &Ui, layout: &mut Layout) -> Option<Action> {
        let mut action = None;
        let mut wanted: Option<PathBuf> = None;
        combo(ui, "Recent files", "Recent files", "Files that were opened before.", layout, |layout| {
            if self.recent.is_empty() {
                ui.text_disabled("none yet");
            }
            for (number, file) in self.recent.iter().enumerate() {
                // Names may be shown alike.
                let _id = ui.push_id_usize(number);
                if ui.selectable(file.to_string_lossy()) {
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
                    wanted = Some(std::mem::take(&mut files.open).into());
                }
            },
        );
        named(
            ui,
            "Picture file",
            "Where the picture is saved: .png as it is shown, .exr for linear light. It carries its settings, so that it can be opened again.",
            layout,
            |id| {
                files.picture.edit(ui, id);
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
                files.scene.edit(ui, id);
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
    pub(in crate::app) fn picture_file(&mut self) -> String {
        self.files.picture.file()
    }

    /// It went there; the next one goes elsewhere.
    pub(in crate::app) fn picture_is_saved(&mut self) {
        let SaveAs { file, .. } = &self.files.picture;
        let (said, next) = (format!("saved {file}"), SaveAs::new(file));
        self.files.picture = next;
        self.say(said);
    }

    /// Saves the scene, and says so or why not.
    pub(in crate::app) fn save_scene(&mut self) {
        let file = self.files.scene.file();
        if let Err(error) = output::save_scene(&self.settings, Path::new(&file)) {
            self.say(error.to_string());
            return;
        }
        // What is rendered is told by its difference from the file, which has changed.
        if Path::new(&file) == self.settings.estimator.scene.source {
            self.open(Path::new(&file));
        }
        self.remember(Path::new(&file));
        self.files.scene = SaveAs::new(&file);
        self.say(format!("saved {file}"));
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
