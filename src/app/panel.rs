//! The state of the panel: the settings that it edits, and what it needs for that. `ui` draws it.

use super::Options;
use super::area::Area;
use super::content::Content;
use super::dialog::{Dialog, Purpose};
use super::guide::Guide;
use super::lesson::{Lesson, Seen};
use super::memory::Memory;
use super::message::{Kind, Messages, Offer};
use super::optics::Optics;
use super::render_job::RenderJob;
use super::save_as::{self, Files, SaveAs, absolute};
use super::theme::{MIN_PANEL_WIDTH, MIN_STRIP, PANEL_WIDTH, STRIP};
use super::typing::Typing;
use super::zoom_lock::ZoomLock;
use crate::error::Error;
use crate::output::{self, PictureFormat};
use crate::scene::{Aperture, ApertureImage, BUILTINS, Builtin, Depths, Extents, SceneRef};
use crate::settings::{Called, Settings};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use winit::window::Window;

/// The largest number of recent files.
const MAX_RECENT: usize = 8;

/// The panel takes at most this share of the window.
const MAX_SHARE: f32 = 0.8;
/// The strip takes at most this share of the window.
const MAX_STRIP_SHARE: f32 = 0.65;

/// The panel's state.
pub(super) struct Panel {
    /// The settings as the user has set them.
    pub(super) settings: Settings,
    /// The settings that the Reset button restores.
    pub(super) initial: Settings,
    /// The settings that the renderer accepted last, which the picture on the screen has.
    pub(super) accepted: State,
    /// The image that was the aperture last, to switch back to.
    pub(super) image: Option<ApertureImage>,
    /// The scenes to choose from: the built-in ones and those that were opened.
    pub(super) scenes: Vec<PathBuf>,
    /// The file that may become the aperture, if one is offered.
    offered_image: Option<PathBuf>,
    /// Recent files, with the latest first.
    pub(super) recent: Vec<PathBuf>,
    pub(super) files: Files,
    /// The dialog of the system that is open.
    pub(super) dialog: Option<Dialog>,
    /// A file or scene to open, which the loader does not know of yet.
    pub(super) to_open: Option<PathBuf>,
    pub(super) messages: Messages,
    /// The value that is being typed, if there is one.
    pub(super) typing: Option<Typing>,
    /// The name of the row whose colour is being chosen, if there is one.
    pub(super) picks: Option<&'static str>,
    pub(super) optics: Optics,
    pub(super) zoom_lock: ZoomLock,
    /// The picture that is held for comparison, if there is one.
    pub(super) held: Option<Held>,
    pub(super) paused: bool,
    /// Whether the picture is to be saved once it has all of its points.
    pub(super) save_when_done: bool,
    /// Whether the focal plane follows what was focused on while the camera moves.
    pub(super) follows: bool,
    /// What the next clicks on the picture are for, if the user is guided.
    pub(super) guide: Option<Guide>,
    /// Whether those who are new are greeted: until they do something.
    pub(super) greets: bool,
    pub(super) lesson: Option<Lesson>,
    pub(super) keys: bool,
    /// The size of the picture that is rendered to a file. The shown picture has its proportions. `None` for the size of
    /// the shown picture.
    pub(super) output: Option<[u32; 2]>,
    /// Whether lines divide the picture into thirds.
    pub(super) thirds: bool,
    /// The picture that is being rendered to a file.
    pub(super) job: Option<RenderJob>,
    /// The width of the panel in points, as the user has set it.
    pub(super) width: f32,
    /// Whether the panel and everything else over the picture is hidden.
    pub(super) hidden: bool,
    /// The sections that were opened or closed, and whether they are open.
    pub(super) folds: BTreeMap<String, bool>,
    /// Where the shapes of the scene are.
    extents: (SceneRef, Extents),
    /// Where the controls were drawn last, to notice when they move.
    pub(super) layout: Layout,
}

/// A picture that is held for comparison.
pub(super) struct Held {
    /// The position of the dividing line, as a fraction of the picture's width.
    pub(super) share: f32,
    /// The settings of the held picture, in a few words.
    pub(super) words: String,
}

/// The controls, each with its name and its left, top, width and height in physical pixels.
pub(super) type Layout = Vec<(&'static str, [i32; 4])>;

/// What undo and redo restore.
#[derive(Clone, PartialEq)]
pub(super) struct State {
    pub(super) settings: Settings,
    initial: Settings,
    /// The depth that the point in the drawing of the optics was moved to. Which pixel is drawn is no change.
    depth: Option<f64>,
}

/// The name of a scene without its folder.
pub(super) fn file_name(scene: &Path) -> Cow<'_, str> {
    scene.file_name().unwrap_or(scene.as_os_str()).to_string_lossy()
}

pub(super) fn builtin(name: &Path) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|builtin| Path::new(builtin.name) == name)
}

impl Panel {
    pub(super) fn new(options: &Options) -> Self {
        let settings = options.settings.clone();
        // Pictures are recent files too, but no scenes.
        let is_scene = |file: &&PathBuf| PictureFormat::of(file).is_none() && file.exists();
        let opened = options.memory.recent.iter().filter(is_scene).cloned();
        let mut panel = Self {
            initial: options.initial.clone(),
            accepted: State { settings: settings.clone(), initial: options.initial.clone(), depth: None },
            zoom_lock: ZoomLock::new(&settings.estimator),
            image: settings.estimator.aperture.image.clone(),
            scenes: BUILTINS.iter().map(|builtin| builtin.name.into()).chain(opened).collect(),
            offered_image: None,
            recent: options.memory.recent.clone(),
            files: Files::default(),
            dialog: None,
            to_open: None,
            messages: Messages::default(),
            typing: None,
            picks: None,
            optics: Optics {
                open: options.memory.optics,
                height: options.memory.optics_height.unwrap_or(STRIP),
                ..Optics::default()
            },
            held: None,
            paused: false,
            save_when_done: false,
            follows: !options.memory.focus_stays,
            guide: None,
            greets: !options.memory.greeted,
            lesson: None,
            keys: false,
            output: options.memory.output.filter(|size| size.iter().all(|extent| *extent > 0)),
            thirds: false,
            job: None,
            width: options.memory.panel_width.unwrap_or(PANEL_WIDTH),
            hidden: false,
            folds: options.memory.folds.clone(),
            extents: (settings.estimator.scene.clone(), Extents::of(&settings.estimator.scene)),
            settings,
            layout: Vec::new(),
        };
        panel.offer_scene();
        match &options.message {
            Some(message) => panel.messages.fail(message.clone()),
            None => panel.warn(),
        }
        panel
    }

    /// Adds the scene to those to choose from.
    fn offer_scene(&mut self) {
        let source = &self.settings.estimator.scene.source;
        if builtin(source).is_none() && !self.scenes.iter().any(|known| absolute(known) == absolute(source)) {
            self.scenes.push(source.clone());
        }
    }

    /// Restores the settings that the scene was opened with.
    pub(super) fn reset(&mut self) {
        let size = self.settings.estimator.size;
        self.settings = self.initial.clone();
        self.settings.estimator.size = size;
    }

    /// Restores the position of the camera that the scene was opened with, and nothing else.
    pub(super) fn reset_camera(&mut self) {
        let Settings { estimator: now, .. } = &mut self.settings;
        // A model that stands in another way has another camera of its own.
        let stands = now.scene.stage() == self.initial.estimator.scene.stage();
        let initial = if stands { self.initial.estimator.camera } else { now.scene.camera };
        let camera = &mut now.camera;
        (camera.eye, camera.look_at, camera.up) = (initial.eye, initial.look_at, initial.up);
    }

    /// What the lesson looks at.
    pub(super) fn seen(&self) -> Seen {
        let Settings { estimator, samples, .. } = &self.settings;
        Seen {
            diameter: estimator.lens.diameter,
            f_number: estimator.f_number(),
            focal_distance: estimator.lens.focal_distance,
            samples: *samples,
            drawn: self.optics.open.then_some(self.optics.pin.share),
        }
    }

    /// The depths of what the picture shows.
    pub(super) fn depths(&mut self) -> Depths {
        let estimator = &self.settings.estimator;
        if !self.extents.0.shares_shapes(&estimator.scene) {
            self.extents = (estimator.scene.clone(), Extents::of(&estimator.scene));
        }
        self.extents.1.depths(&estimator.focused_camera(), estimator.size)
    }

    /// Says so if the picture cannot come out right.
    fn warn(&mut self) {
        if let Some(warning) = self.settings.estimator.too_coarse() {
            self.messages.fail(warning);
        }
    }

    /// The width of the column that the panel takes in a window of this width, in points.
    pub(super) fn column(&self, window: f32) -> f32 {
        if self.hidden { 0.0 } else { self.width.max(MIN_PANEL_WIDTH).min(MAX_SHARE * window).floor() }
    }

    /// The height of the strip that the drawing of the optics takes in a window of this height, in points.
    pub(super) fn strip(&self, window: f32) -> f32 {
        if self.hidden || !self.optics.open {
            return 0.0;
        }
        self.optics.height.max(MIN_STRIP).min(MAX_STRIP_SHARE * window).floor()
    }

    /// The part of the room for the picture that it takes: it has the proportions of the output.
    pub(super) fn picture_in(&self, room: Area) -> Area {
        self.output.map_or(room, |size| room.with_proportions(size))
    }

    /// What to remember for the next run, with these sizes of the window.
    pub(super) fn memory(&self, sizes: BTreeMap<u32, [u32; 2]>) -> Memory {
        Memory {
            sizes,
            // The next run may start in another folder.
            arguments: self.settings.arguments_from_anywhere(),
            recent: self.recent.clone(),
            optics: self.optics.open,
            optics_height: Some(self.optics.height),
            panel_width: Some(self.width),
            folds: self.folds.clone(),
            focus_stays: !self.follows,
            greeted: !self.greets,
            output: self.output,
        }
    }

    /// The state for undo and redo. The size of the window is not part of it.
    pub(super) fn state(&self) -> State {
        let mut state = self.full_state();
        (state.settings.estimator.size, state.initial.estimator.size) = ([1; 2], [1; 2]);
        state
    }

    fn full_state(&self) -> State {
        State { settings: self.settings.clone(), initial: self.initial.clone(), depth: self.optics.pin.depth }
    }

    /// Restores a state.
    pub(super) fn restore(&mut self, state: State) {
        let size = self.settings.estimator.size;
        (self.settings, self.initial, self.optics.pin.depth) = (state.settings, state.initial, state.depth);
        self.settings.estimator.size = size;
    }

    /// Notes that the renderer accepted the settings.
    pub(super) fn accept(&mut self) {
        if self.accepted.settings != self.settings || self.accepted.initial != self.initial {
            self.accepted = self.full_state();
        }
    }

    /// Restores the settings that the renderer accepted last, and shows why it refused the new ones.
    pub(super) fn refuse(&mut self, error: &Error) {
        // If a number is out of range, the message calls it what the panel calls it.
        let own = self.settings.check_as(Called::Label).err();
        self.messages.fail(own.as_ref().unwrap_or(error).to_string());
        self.restore(self.accepted.clone());
    }

    /// The title of the window: the name of the scene.
    pub(super) fn title(&self) -> String {
        format!("{} - thinlens", file_name(&self.settings.estimator.scene.source))
    }

    /// The settings of the picture that is shown.
    pub(super) fn shown(&self) -> &Settings {
        &self.accepted.settings
    }

    /// Opens a file or a built-in scene whose name was typed.
    pub(super) fn open_typed(&mut self, typed: &str) {
        let name = Path::new(typed.trim());
        if builtin(name).is_some() {
            self.open(name);
        } else if !name.as_os_str().is_empty() {
            self.open(&save_as::typed(name));
        }
    }

    /// Opens a scene, a mesh, or a picture with its settings, as soon as the loader is free.
    pub(super) fn open(&mut self, name: &Path) {
        self.messages.close();
        self.to_open = Some(name.to_path_buf());
    }

    /// Shows what was opened.
    pub(super) fn show(&mut self, name: &Path, content: &Content) {
        let settings = content.settings(&self.settings);
        let initial = self.settings.with_scene(settings.estimator.scene.clone());
        self.initial = Settings { samples: settings.samples, ..initial };
        self.image = settings.estimator.aperture.image.clone().or(self.image.take());
        self.settings = settings;
        self.optics.forget_points();
        self.warn();
        self.offer_scene();
        if builtin(name).is_none() {
            self.remember(name);
        }
    }

    /// Shows the scene whose model stands as the settings say.
    pub(super) fn set_stage(&mut self, scene: &SceneRef) {
        if self.settings.estimator.scene != *scene {
            self.settings = self.settings.on_stage(scene.clone());
        }
    }

    /// Says why a file was not opened. An image without settings may be meant as the shape of the aperture.
    pub(super) fn was_not_opened(&mut self, name: &Path, error: &Error) {
        let is_image = PictureFormat::of(name) == Some(PictureFormat::Png);
        if is_image && matches!(error, Error::NoOrigin { .. }) {
            self.offered_image = Some(absolute(name));
            let text = format!(
                "{} has no settings that could be shown. It can be the shape of the aperture.",
                name.display()
            );
            self.messages.ask(text, vec![Offer::UseAsAperture]);
        } else {
            self.messages.fail(error.to_string());
        }
    }

    /// Gives the aperture the shape of the image that was offered.
    pub(super) fn use_image(&mut self) {
        match self.offered_image.take().map(|file| ApertureImage::read(&file)) {
            Some(Ok(image)) => {
                let aperture = &mut self.settings.estimator.aperture;
                let anamorphic = aperture.anamorphic;
                *aperture = Aperture { anamorphic, image: Some(image.clone()), ..Aperture::default() };
                self.image = Some(image);
            }
            Some(Err(error)) => self.messages.fail(error.to_string()),
            None => {}
        }
    }

    /// Adds a file to the front of the recent files.
    pub(super) fn remember(&mut self, file: &Path) {
        let file = absolute(file);
        self.recent.retain(|known| *known != file);
        self.recent.insert(0, file);
        self.recent.truncate(MAX_RECENT);
    }

    /// The file to save to. `None` if the user has to be asked first whether to replace a file.
    pub(super) fn file_for(&mut self, kind: Kind) -> Option<PathBuf> {
        match self.save_as(kind).file() {
            Ok(file) => Some(file),
            Err(file) => {
                self.messages.ask(
                    format!("{} is there already.", file.display()),
                    vec![Offer::Replace(kind), Offer::KeepBoth(kind)],
                );
                None
            }
        }
    }

    /// The name of the file that such a thing is saved to.
    pub(super) fn save_as(&mut self, kind: Kind) -> &mut SaveAs {
        match kind {
            Kind::Picture => &mut self.files.picture,
            Kind::Scene => &mut self.files.scene,
        }
    }

    /// Reports that the picture was saved with this many points per pixel, and chooses a new name for the next one.
    pub(super) fn picture_is_saved(&mut self, file: &Path, samples: u32) {
        self.files.picture.suggest_next();
        self.save_when_done = false;
        let (file, target) = (file.display(), self.settings.samples);
        if samples < target {
            let text = format!("saved {file}, with {samples} of {target} points per pixel");
            self.messages.say_and_offer(text, Offer::SaveWhenDone);
        } else {
            self.messages.say(format!("saved {file}"));
        }
    }

    /// Begins to render the picture to the file that is named. `wake` is called whenever there is news.
    pub(super) fn render_to_file(&mut self, device: &str, wake: impl Fn() + Send + 'static) {
        let file = match self.files.picture.file() {
            Ok(file) => file,
            Err(file) => {
                let there = file.display();
                self.messages.fail(format!("{there} is there already; type another name under Files"));
                return;
            }
        };
        let size = self.output.unwrap_or(self.settings.estimator.size);
        match RenderJob::start(&self.settings, size, device, &file, wake) {
            Ok(job) => self.job = Some(job),
            Err(error) => self.messages.fail(error.to_string()),
        }
    }

    /// Reports what has become of the picture that is being rendered to a file.
    pub(super) fn watch_job(&mut self) {
        let Some(ended) = self.job.as_mut().and_then(RenderJob::poll) else {
            return;
        };
        self.job = None;
        match ended {
            Ok(file) => {
                self.messages.say(format!("rendered {}", file.display()));
                self.remember(&file);
                self.files.picture.suggest_next();
            }
            Err(why) => self.messages.fail(format!("the picture was not rendered: {why}")),
        }
    }

    /// Opens a dialog of the system in which a file is chosen. `wake` is called once it is closed.
    pub(super) fn browse(&mut self, purpose: Purpose, window: &Window, wake: impl Fn() + Send + 'static) {
        let suggested = match purpose {
            Purpose::Open => absolute(&self.settings.estimator.scene.source),
            Purpose::Save(kind) => self.save_as(kind).suggestion(),
        };
        self.dialog = Some(Dialog::open(purpose, &suggested, window, wake));
    }

    /// Opens the file that was chosen in a dialog. Returns what is to be saved, if a file was chosen for that.
    pub(super) fn watch_dialog(&mut self) -> Option<Kind> {
        let (purpose, answer) = self.dialog.as_ref()?.poll()?;
        self.dialog = None;
        match (purpose, answer) {
            (_, Ok(None)) => {}
            (Purpose::Open, Ok(Some(file))) => self.open(&file),
            (Purpose::Save(kind), Ok(Some(file))) => match self.save_as(kind).choose(file) {
                Ok(()) => return Some(kind),
                Err(why) => self.messages.fail(why),
            },
            (_, Err(why)) => {
                log::info!("no dialog: {why}");
                self.messages.fail(
                    "No dialog can be opened here: neither the desktop's portal nor the program zenity answers. Type the path under Files, or drop the file on the window.".into(),
                );
            }
        }
        None
    }

    /// Saves the scene, and reports the file or the error.
    pub(super) fn save_scene(&mut self) {
        let Some(file) = self.file_for(Kind::Scene) else {
            return;
        };
        if let Err(error) = output::save_scene(&self.settings, &file) {
            self.messages.fail(error.to_string());
            return;
        }
        // Settings are described by their difference from the scene file. The file has changed, so it is loaded again.
        let source = self.settings.estimator.scene.source.clone();
        if file == absolute(&source) {
            self.open(&source);
        }
        self.remember(&file);
        self.files.scene.suggest_next();
        self.messages.say(format!("saved {}", file.display()));
    }
}
