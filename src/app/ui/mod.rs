//! The panel.

mod aperture;
mod compare;
mod files;
mod lens;
mod numbers;
mod optics;
mod overlay;
mod rows;
mod sampling;
mod widgets;

use super::Options;
use super::diagram::Diagram;
use super::memory::Memory;
use crate::error::Error;
use crate::output::{Origin, PictureFormat};
use crate::renderer::{Picked, Progress};
use crate::scene::{self, ApertureImage, BUILTINS, CameraModel, SceneRef};
use crate::settings::{Part, Settings};
use compare::Held;
use files::Files;
use imgui::{Condition, Ui};
use optics::Optics;
use std::path::{Path, PathBuf};
use widgets::{Layout, combo, note_item, section, tooltip};

/// Files that are offered again.
const MOST_RECENT: usize = 8;

/// Width of the panel, in points.
const PANEL_WIDTH: f32 = 320.0;
/// Around the panel, in points.
const MARGIN: f32 = 12.0;

/// What the panel edits, and what it has to know for it.
pub(super) struct Panel {
    /// What is rendered now.
    pub(super) settings: Settings,
    /// What Reset goes back to.
    initial: Settings,
    /// What the renderer took last: of this is the picture that is shown.
    accepted: State,
    /// The last aperture that was an image.
    image: Option<ApertureImage>,
    /// The choices: the built-ins, and what was opened.
    scenes: Vec<PathBuf>,
    /// What was opened before, the latest first.
    recent: Vec<PathBuf>,
    files: Files,
    message: Option<String>,
    pub(super) optics: Optics,
    /// The picture that is held to compare with, if one is.
    pub(super) held: Option<Held>,
    pub(super) paused: bool,
    pub(super) keys: bool,
    /// Where the controls were drawn, to tell when they moved.
    layout: Layout,
}

/// What a change changes.
#[derive(Clone, PartialEq)]
pub(super) struct State {
    pub(super) settings: Settings,
    initial: Settings,
}

/// What the panel shows of the renderer.
pub(super) struct Status<'a> {
    pub(super) progress: Progress,
    pub(super) device: &'a str,
    /// What lies under the pointer, while it is over the picture.
    pub(super) picked: Option<&'a Picked>,
    /// The optics of the pixel that was clicked last.
    pub(super) diagram: Option<&'a Diagram>,
}

/// What a button asks for beyond the settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Action {
    /// Focus on what is in the middle of the picture.
    Autofocus,
    /// Back to the settings that the scene was opened with.
    Reset,
    /// Likewise, but only where the camera stands and looks.
    ResetCamera,
    /// Take the last change back.
    Undo,
    /// Make it again.
    Redo,
    /// Hold the picture beside what comes, or let it go.
    Compare,
    /// Let the device rest, or go on.
    Pause,
    /// Open or close the drawing of the optics.
    Optics,
    /// Show what mouse and keys do, or no longer.
    Keys,
    /// Write the picture to the file that is named.
    SavePicture,
    /// Write the scene to the file that is named.
    SaveScene,
    /// Put the command that renders the picture into the clipboard.
    CopyCommand,
}

/// A file's path from wherever one is.
fn whole_path(file: &Path) -> PathBuf {
    std::path::absolute(file).unwrap_or_else(|_| file.to_path_buf())
}

fn builtin(name: &Path) -> Option<&'static str> {
    BUILTINS.iter().map(|builtin| builtin.name).find(|builtin| Path::new(builtin) == name)
}

impl Panel {
    pub(super) fn new(options: &Options) -> Self {
        let settings = options.settings.clone();
        let mut panel = Self {
            initial: options.initial.clone(),
            accepted: State { settings: settings.clone(), initial: options.initial.clone() },
            image: settings.estimator.aperture.image.clone(),
            settings,
            scenes: BUILTINS.iter().map(|builtin| builtin.name.into()).collect(),
            recent: options.memory.recent.clone(),
            files: Files::default(),
            message: options.message.clone().or_else(|| options.settings.estimator.too_coarse()),
            optics: Optics { open: options.memory.optics, ..Optics::default() },
            held: None,
            paused: false,
            keys: false,
            layout: Vec::new(),
        };
        panel.offer_scene();
        panel
    }

    /// The scene is among the choices from now on.
    fn offer_scene(&mut self) {
        let source = &self.settings.estimator.scene.source;
        if !self.scenes.contains(source) {
            self.scenes.push(source.clone());
        }
    }

    /// Draws the panel and changes the settings as told.
    pub(super) fn draw(&mut self, ui: &Ui, status: &Status<'_>) -> Option<Action> {
        let mut layout = Vec::new();
        let mut action = None;
        let [_, height] = ui.io().display_size;
        ui.window("thinlens")
            .position([MARGIN; 2], Condition::FirstUseEver)
            .size([PANEL_WIDTH, 0.0], Condition::Always)
            .size_constraints([PANEL_WIDTH, 0.0], [PANEL_WIDTH, (height - 2.0 * MARGIN).max(64.0)])
            .resizable(false)
            .build(|| {
                self.scene_chooser(ui, &mut layout);
                self.rows(ui, Part::Top, &mut layout);
                self.progress(ui, status);
                let mut button = |name, asks| {
                    if ui.button(name) {
                        action = Some(asks);
                    }
                };
                button("Autofocus", Action::Autofocus);
                note_item(ui, "Autofocus", &mut layout);
                tooltip(
                    ui,
                    "Focuses on what is in the middle of the picture. Right-click anything, or point at it and press F, to focus on that instead; Ctrl and the wheel move the plane by hand.",
                );
                ui.same_line();
                button("Reset", Action::Reset);
                note_item(ui, "Reset", &mut layout);
                tooltip(ui, "Back to the settings that the scene was opened with.");
                ui.same_line();
                ui.checkbox("Optics", &mut self.optics.open);
                note_item(ui, "Optics", &mut layout);
                tooltip(
                    ui,
                    "Draws what the lens does with the light of one pixel, to scale. Click the picture to choose the pixel.",
                );
                for (name, asks, help) in [
                    ("Undo", Action::Undo, "Takes the last change back (Ctrl+Z)."),
                    ("Redo", Action::Redo, "Makes it again (Ctrl+Shift+Z)."),
                    ("Compare", Action::Compare, "Holds this picture on the left, to see beside it what you change (C). Once more lets it go."),
                    (if self.paused { "Go on" } else { "Pause" }, Action::Pause, "The picture stays as it is, and the device rests (P)."),
                    ("?", Action::Keys, "What mouse and keys do (?)."),
                ] {
                    button(name, asks);
                    note_item(ui, name, &mut layout);
                    tooltip(ui, help);
                    ui.same_line();
                }
                ui.new_line();
                section(ui, "Lens", false, &mut layout, |layout| self.lens(ui, layout));
                if self.settings.estimator.model != CameraModel::Pinhole {
                    section(ui, "Aperture shape", false, &mut layout, |layout| self.aperture(ui, layout));
                }
                section(ui, "Viewpoint", false, &mut layout, |layout| {
                    self.rows(ui, Part::Viewpoint, layout);
                    if ui.button("Reset camera") {
                        action = Some(Action::ResetCamera);
                    }
                    note_item(ui, "Reset camera", layout);
                    tooltip(ui, "Back to where the scene was opened (Home). Everything else stays.");
                });
                section(ui, "What is sharp", true, &mut layout, |_| self.numbers(ui, status.picked));
                section(ui, "Light", false, &mut layout, |layout| self.rows(ui, Part::Light, layout));
                section(ui, "Sampling", false, &mut layout, |layout| {
 self.rows(ui, Part::Sampling, layout);
});
                section(ui, "View", false, &mut layout, |layout| self.rows(ui, Part::View, layout));
                section(ui, "Files", false, &mut layout, |layout| {
                    action = self.files(ui, layout).or(action);
                });
                section(ui, "Device", false, &mut layout, |_| sampling::device(ui, status));
            });
        self.divider(ui, &mut layout);
        self.optics.draw(ui, status.diagram, &mut layout);
        overlay::legend(ui, &self.settings);
        if layout != self.layout {
            for (name, [x, y, width, height]) in &layout {
                log::debug!("control '{name}' at {x} {y} {width} {height}");
            }
            self.layout = layout;
        }
        action
    }

    /// Back to what the scene was opened with.
    pub(super) fn reset(&mut self) {
        let size = self.settings.estimator.size;
        self.settings = self.initial.clone();
        self.settings.estimator.size = size;
    }

    /// Likewise, but only where the camera stands and looks.
    pub(super) fn reset_camera(&mut self) {
        let (camera, initial) = (&mut self.settings.estimator.camera, &self.initial.estimator.camera);
        (camera.eye, camera.look_at, camera.up) = (initial.eye, initial.look_at, initial.up);
    }

    /// A picture is held from now on, on the left of what the panel leaves free.
    pub(super) fn hold(&mut self) {
        let width = self.settings.estimator.size[0] as f32;
        let left = (PANEL_WIDTH + 2.0 * MARGIN) / width;
        self.held = Some(Held::new(self.shown(), if left < 0.8 { 0.5 * (left + 1.0) } else { 0.5 }));
    }

    /// Shows a message until there is another one.
    pub(super) fn say(&mut self, message: String) {
        log::debug!("message {message}");
        self.message = Some(message);
    }

    /// What to remember of it.
    pub(super) fn memory(&self) -> Memory {
        let Settings { estimator, .. } = &self.settings;
        Memory {
            size: Some(estimator.size),
            // The next time the viewer may be started elsewhere.
            arguments: self.settings.arguments_from_anywhere(),
            recent: self.recent.clone(),
            optics: self.optics.open,
        }
    }

    /// What undo and redo go back and forth between. The window's size is not part of it.
    pub(super) fn state(&self) -> State {
        let mut state = State { settings: self.settings.clone(), initial: self.initial.clone() };
        (state.settings.estimator.size, state.initial.estimator.size) = ([1; 2], [1; 2]);
        state
    }

    /// Puts a state back.
    pub(super) fn restore(&mut self, state: State) {
        let size = self.settings.estimator.size;
        (self.settings, self.initial) = (state.settings, state.initial);
        self.settings.estimator.size = size;
    }

    /// The renderer took the settings.
    pub(super) fn accept(&mut self) {
        if self.accepted.settings != self.settings || self.accepted.initial != self.initial {
            self.accepted = State { settings: self.settings.clone(), initial: self.initial.clone() };
        }
    }

    /// The renderer did not: back to what it took last, and say why.
    pub(super) fn refuse(&mut self, error: &Error) {
        self.say(error.to_string());
        self.restore(self.accepted.clone());
    }

    /// The settings of the picture that is shown.
    pub(super) fn shown(&self) -> &Settings {
        &self.accepted.settings
    }

    fn scene_chooser(&mut self, ui: &Ui, layout: &mut Layout) {
        let mut chosen = None;
        let shown = self.settings.estimator.scene.source.clone();
        let help = "What is rendered: the built-in scenes, and what was opened.";
        combo(ui, "Scene", &shown.to_string_lossy(), help, layout, |layout| {
            for (number, name) in self.scenes.iter().enumerate() {
                // Names may be shown alike.
                let _id = ui.push_id_usize(number);
                if ui.selectable_config(name.to_string_lossy()).selected(*name == shown).build() {
                    chosen = Some(name.clone());
                }
                if let Some(builtin) = builtin(name) {
                    note_item(ui, builtin, layout);
                }
            }
        });
        if let Some(name) = chosen {
            self.open(&name);
        }
        if let Some(message) = &self.message {
            ui.text_wrapped(message);
        }
    }

    /// Opens a scene, a mesh, or a picture with its settings; or says why not.
    pub(super) fn open(&mut self, name: &Path) {
        let opened = match PictureFormat::of(name) {
            Some(_) => Origin::read(name).and_then(|origin| Settings::of_arguments(&origin.arguments)),
            None => scene::load(name).map(|loaded| self.settings.with_scene(SceneRef::new(loaded))),
        };
        match opened {
            Ok(mut settings) => {
                settings.estimator.size = self.settings.estimator.size;
                self.initial = Settings {
                    samples: settings.samples,
                    ..self.settings.with_scene(settings.estimator.scene.clone())
                };
                self.image = settings.estimator.aperture.image.clone().or(self.image.take());
                self.settings = settings;
                self.message = self.settings.estimator.too_coarse();
                self.offer_scene();
                if builtin(name).is_none() {
                    self.remember(name);
                }
            }
            Err(error) => self.say(error.to_string()),
        }
    }

    /// The file is the latest of those that are offered again.
    fn remember(&mut self, file: &Path) {
        let file = whole_path(file);
        self.recent.retain(|known| *known != file);
        self.recent.insert(0, file);
        self.recent.truncate(MOST_RECENT);
    }

    /// The rows of a part that change settings.
    fn rows(&mut self, ui: &Ui, part: Part, layout: &mut Layout) {
        rows::rows(ui, part, &mut self.settings, &self.initial, layout);
    }
}
