//! What the panel edits, and what it has to know for it. How it is drawn is in `ui`.

use super::Options;
use super::memory::Memory;
use super::save_as::{Files, SaveAs};
use super::telemetry;
use crate::error::{Error, Result};
use crate::output::{self, Origin, PictureFormat};
use crate::scene::{self, ApertureImage, BUILTINS, SceneRef};
use crate::settings::{Called, Settings};
use std::path::{Path, PathBuf};

/// Files that are offered again.
const MOST_RECENT: usize = 8;

/// The panel's state.
pub(super) struct Panel {
    /// What is rendered now.
    pub(super) settings: Settings,
    /// What Reset goes back to.
    pub(super) initial: Settings,
    /// What the renderer took last: of this is the picture that is shown.
    pub(super) accepted: State,
    /// The last aperture that was an image.
    pub(super) image: Option<ApertureImage>,
    /// The choices: the built-ins, and what was opened.
    pub(super) scenes: Vec<PathBuf>,
    /// What was opened before, the latest first.
    pub(super) recent: Vec<PathBuf>,
    pub(super) files: Files,
    /// What was asked to be opened and is not being loaded yet.
    pub(super) to_open: Option<PathBuf>,
    pub(super) message: Option<String>,
    pub(super) optics: Optics,
    /// The picture that is held to compare with, if one is.
    pub(super) held: Option<Held>,
    pub(super) paused: bool,
    pub(super) keys: bool,
    /// Where the controls were drawn, to tell when they moved.
    pub(super) layout: Layout,
}

/// What the window's own controls say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Optics {
    pub(super) open: bool,
    /// Of each fan, and samples in the front view.
    pub(super) rays: u32,
    /// How often as high things are drawn in the side and top view, where the lens is too narrow to see.
    pub(super) stretch: f32,
}

impl Default for Optics {
    fn default() -> Self {
        Self { open: false, rays: 9, stretch: 1.0 }
    }
}

/// A picture that is held.
pub(super) struct Held {
    /// Where the line stands, as a share of the width.
    pub(super) share: f32,
    /// What was set when it was held.
    pub(super) words: String,
}

/// Where controls are, in physical pixels: name, and left, top, width, height.
pub(super) type Layout = Vec<(&'static str, [i32; 4])>;

/// What a change changes.
#[derive(Clone, PartialEq)]
pub(super) struct State {
    pub(super) settings: Settings,
    initial: Settings,
}

/// A file's path from wherever one is.
fn whole_path(file: &Path) -> PathBuf {
    std::path::absolute(file).unwrap_or_else(|_| file.to_path_buf())
}

pub(super) fn builtin(name: &Path) -> Option<&'static str> {
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
            to_open: None,
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

    /// Back to what the scene was opened with.
    pub(super) fn reset(&mut self) {
        let size = self.settings.estimator.size;
        self.settings = self.initial.clone();
        self.settings.estimator.size = size;
    }

    /// Puts the camera back to where the scene was opened, and leaves all else.
    pub(super) fn reset_camera(&mut self) {
        let (camera, initial) = (&mut self.settings.estimator.camera, &self.initial.estimator.camera);
        (camera.eye, camera.look_at, camera.up) = (initial.eye, initial.look_at, initial.up);
    }

    /// Shows a message until there is another one.
    pub(super) fn say(&mut self, message: String) {
        log::debug!("{} {message}", telemetry::MESSAGE);
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
        // What is wrong with a number is said in the panel's words.
        let own = self.settings.check_as(Called::Label).err();
        self.say(own.as_ref().unwrap_or(error).to_string());
        self.restore(self.accepted.clone());
    }

    /// The settings of the picture that is shown.
    pub(super) fn shown(&self) -> &Settings {
        &self.accepted.settings
    }

    /// Asks for a scene, a mesh, or a picture with its settings.
    pub(super) fn open(&mut self, name: &Path) {
        self.message = None;
        self.to_open = Some(name.to_path_buf());
    }

    /// Shows what was opened from now on.
    pub(super) fn show(&mut self, name: &Path, content: &Content) {
        let settings = content.settings(&self.settings);
        let initial = self.settings.with_scene(settings.estimator.scene.clone());
        self.initial = Settings { samples: settings.samples, ..initial };
        self.image = settings.estimator.aperture.image.clone().or(self.image.take());
        self.settings = settings;
        self.message = self.settings.estimator.too_coarse().or(self.message.take());
        self.offer_scene();
        if builtin(name).is_none() {
            self.remember(name);
        }
    }

    /// The file is the latest of those that are offered again.
    pub(super) fn remember(&mut self, file: &Path) {
        let file = whole_path(file);
        self.recent.retain(|known| *known != file);
        self.recent.insert(0, file);
        self.recent.truncate(MOST_RECENT);
    }

    /// Where the picture goes.
    pub(super) fn picture_file(&mut self) -> String {
        self.files.picture.file()
    }

    /// It went there; the next one goes elsewhere.
    pub(super) fn picture_is_saved(&mut self) {
        let SaveAs { file, .. } = &self.files.picture;
        let (said, next) = (format!("saved {file}"), SaveAs::new(file));
        self.files.picture = next;
        self.say(said);
    }

    /// Saves the scene, and says so or why not.
    pub(super) fn save_scene(&mut self) {
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

/// What a file holds that was opened.
pub(super) enum Content {
    Scene(SceneRef),
    /// The settings of a picture.
    Picture(Settings),
}

impl Content {
    /// Reads a scene, a mesh, or the settings of a picture.
    pub(super) fn read(name: &Path) -> Result<Self> {
        match PictureFormat::of(name) {
            Some(_) => Origin::read(name)
                .and_then(|origin| Settings::of_arguments(&origin.arguments))
                .map(Self::Picture),
            None => scene::load(name).map(|scene| Self::Scene(SceneRef::new(scene))),
        }
    }

    /// What is rendered when it is shown in place of what is rendered now.
    pub(super) fn settings(&self, now: &Settings) -> Settings {
        match self {
            Self::Scene(scene) => now.with_scene(scene.clone()),
            Self::Picture(settings) => {
                let mut settings = settings.clone();
                settings.estimator.size = now.estimator.size;
                settings
            }
        }
    }
}
