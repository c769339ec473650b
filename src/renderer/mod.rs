//! Owns the film, the scene on the device, and the passes. Knows no window and no file.
//!
//! Work is recorded in tiles whose time is bounded; whole passes are merged into the film.
//! None of that changes the picture: see [`schedule`].

mod depth;
mod film;
mod headless;
mod pick;
pub mod schedule;
mod tally;
mod tiles;

pub use pick::{LensRay, Picked, Question, Surface};
pub use tally::Progress;

use crate::error::{Error, Result};
use crate::gpu_types::{
    ApertureBuffer, Counters, OverlayScale, ResolvePush, SceneData, aperture_constant, aperture_sums,
    film_constants, lens_constants,
};
use crate::passes::{
    Accumulate, BlueNoiseTile, Geometry, Opening, Pick, Resolve, SceneBuffers, Select, Shaders, Trace,
};
use crate::scene::{ApertureImage, SceneRef};
use crate::settings::{Estimator, Settings};
use crate::vulkan::{BindingSet, Buffer, Device, FRAMES_IN_FLIGHT, Image, Recording, Residence};
use depth::Seen;
use film::Film;
use pick::Asked;
use schedule::{Cursor, MAX_BATCH, Stage, reach};
use std::sync::Arc;
use std::time::Duration;
use tally::Tally;

/// How much to record at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pace {
    /// About how long the device should work.
    pub budget: Duration,
    /// Whether a new picture starts with the whole view, coarsely where time is short, so that
    /// there is always something to show.
    pub preview: bool,
}

/// Renders settings to a film, as far as it is asked to.
pub struct Renderer {
    scene: Option<LoadedScene>,
    film: Option<Film>,
    /// By the list of active pixels that is read.
    trace_bindings: Option<[BindingSet; 2]>,
    shaders: Shaders,
    passes: Option<EstimatorPasses>,
    tile: BlueNoiseTile,
    opening: Opening,
    opening_image: Option<ApertureImage>,
    /// What was recorded last.
    opening_shape: Option<ApertureBuffer>,
    resolve: Resolve,
    counters: Arc<Buffer>,
    tally: Tally,
    settings: Option<Settings>,
    /// Samples per pixel in the film, from whole passes.
    samples: u32,
    /// The pass under way.
    cursor: Option<Cursor>,
    /// Which of the film's lists holds the active pixels, once some have stopped.
    list: Option<usize>,
    filled_stride: u32,
    needs_clear: bool,
    /// How the picture was resolved, and whether with holes, unless the film has changed since.
    resolved: Option<(ResolvePush, bool)>,
    /// What the depth of the film is of, once it has some.
    seen: Option<Seen>,
    blue_first: bool,
    /// By the frame in flight that will answer.
    questions: [Option<Asked>; FRAMES_IN_FLIGHT],
    max_batch: u32,
    /// What the scene's loops allow.
    largest_batch: u32,
    device: Arc<Device>,
}

/// The passes that are compiled for an estimator.
struct EstimatorPasses {
    /// For which: see [`film_constants`].
    constants: [(u32, u32); 2],
    accumulate: Accumulate,
    /// Whether the film has second moments.
    has_moments: bool,
    /// Of adaptive ones.
    select: Option<Select>,
}

struct LoadedScene {
    scene: SceneRef,
    buffers: SceneBuffers,
    trace: Trace,
    /// For which it is compiled: see [`aperture_constant`].
    aperture: (u32, u32),
    /// Whether anything moves, and for how long the shutter is open.
    moves: bool,
    shutter: f32,
    /// Once something was asked of it.
    pick: Option<Pick>,
    /// Once an overlay was shown that needs it.
    geometry: Option<Geometry>,
}

impl Renderer {
    /// A renderer with nothing to render yet.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        Self::with_shaders(device, Shaders::default())
    }

    /// Likewise, with these shaders for its passes.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn with_shaders(device: &Arc<Device>, shaders: Shaders) -> Result<Self> {
        let size = size_of::<Counters>() as u64;
        Ok(Self {
            scene: None,
            film: None,
            trace_bindings: None,
            shaders,
            passes: None,
            tile: BlueNoiseTile::new(device)?,
            opening: Opening::new(device, &[])?,
            opening_image: None,
            opening_shape: None,
            resolve: Resolve::new(device, shaders.resolve)?,
            counters: Arc::new(Buffer::new(device, "counters", size, Residence::Device)?),
            tally: Tally::new(device)?,
            settings: None,
            samples: 0,
            cursor: None,
            list: None,
            filled_stride: 1,
            needs_clear: false,
            resolved: None,
            seen: None,
            blue_first: false,
            questions: pick::none_asked(),
            max_batch: MAX_BATCH,
            largest_batch: 1,
            device: Arc::clone(device),
        })
    }

    /// Cuts batches at other sample indices from the next pass on: a power of two.
    pub fn set_max_batch(&mut self, max_batch: u32) {
        self.max_batch = max_batch;
    }

    /// Whether a window wants b, g, r, a bytes of [`Self::picture`] from now on, or r, g, b, a.
    pub fn set_blue_first(&mut self, blue_first: bool) {
        self.blue_first = blue_first;
    }

    /// What to render from now on. The film starts anew where the estimator changed, or where it
    /// already holds more samples than wanted.
    ///
    /// # Errors
    /// [`crate::error::Error::OutOfRange`], [`crate::error::Error::Memory`], or what Vulkan
    /// says.
    pub fn set(&mut self, settings: &Settings) -> Result<()> {
        settings.check()?;
        let last = self.settings.as_ref();
        let mut restart =
            last.is_none_or(|last| last.estimator != settings.estimator) || settings.samples < self.samples;
        let estimator = &settings.estimator;
        let constants = film_constants(estimator);
        let compiled = |passes: &EstimatorPasses| {
            passes.constants == constants && passes.select.is_some() == estimator.is_adaptive()
        };
        if !self.passes.as_ref().is_some_and(compiled) {
            self.device.wait_idle()?;
            (self.scene, self.film, self.trace_bindings) = (None, None, None);
            self.passes = Some(self.compile_passes(constants, estimator)?);
        }
        // The tree holds all that its shapes pass while the shutter is open.
        let fits = |loaded: &LoadedScene| {
            loaded.scene == estimator.scene && (!loaded.moves || loaded.shutter == estimator.shutter)
        };
        if !self.scene.as_ref().is_some_and(fits) {
            self.load_scene(estimator)?;
        }
        if let Some(loaded) = &self.scene {
            self.largest_batch = self.fit_loops(&loaded.buffers, estimator.max_bounces)?;
        }
        self.fit_opening(estimator)?;
        let fits = self.film.as_ref().is_some_and(|film| film.film.extent() == estimator.size);
        if let (false, Some(passes)) = (fits, &self.passes) {
            self.device.wait_idle()?;
            (self.film, self.trace_bindings) = (None, None);
            self.film = Some(Film::new(&self.device, estimator.size, passes, &self.resolve)?);
        }
        self.fit_overlay(settings)?;
        if let (None, Some(loaded), Some(film)) = (&self.trace_bindings, &self.scene, &self.film) {
            let (scene, batch, adaptive) = (&loaded.buffers, &film.batch, &film.adaptive);
            let bind = |list| loaded.trace.bind(scene, &self.opening, batch, &self.counters, adaptive, list);
            self.trace_bindings = Some([bind(0)?, bind(1)?]);
            restart = true;
        }
        let too_far = |cursor: &Cursor| cursor.pass.end() > settings.samples;
        // What is half merged can neither be taken back nor be merged again.
        restart |= self.cursor.is_some_and(|cursor| too_far(&cursor) && cursor.stage == Stage::Accumulate);
        if restart {
            self.samples = 0;
            self.cursor = None;
            self.list = None;
            self.filled_stride = 1;
            self.needs_clear = true;
            self.resolved = None;
            self.tally.restart();
        }
        if self.cursor.as_ref().is_some_and(too_far) {
            self.cursor = None;
        }
        self.settings = Some(settings.clone());
        Ok(())
    }

    /// The batch that the scene's loops allow.
    fn fit_loops(&self, scene: &SceneBuffers, max_bounces: u32) -> Result<u32> {
        let steps = scene.most_loop_steps(max_bounces);
        let Some(most) = self.device.traits().max_loop_steps else {
            return Ok(MAX_BATCH);
        };
        schedule::largest_batch(steps, most).ok_or_else(|| {
            Error::OutOfRange(format!(
                "the scene can take {steps} steps a sample, but software devices stop at {most}: {}; use fewer of \
                 these, or a GPU",
                scene.most_steps_in_words(max_bounces)
            ))
        })
    }

    fn compile_passes(&self, constants: [(u32, u32); 2], estimator: &Estimator) -> Result<EstimatorPasses> {
        let accumulate = Accumulate::new(&self.device, self.shaders.accumulate, &constants, &self.tile)?;
        let select = estimator
            .is_adaptive()
            .then(|| Select::new(&self.device, self.shaders.select, &constants))
            .transpose()?;
        Ok(EstimatorPasses { constants, accumulate, has_moments: estimator.has_moments(), select })
    }

    /// Makes the trace pass and what it binds fit the aperture.
    fn fit_opening(&mut self, estimator: &Estimator) -> Result<()> {
        let image = &estimator.aperture.image;
        if *image != self.opening_image {
            self.device.wait_idle()?;
            self.trace_bindings = None;
            self.opening =
                Opening::new(&self.device, &image.as_ref().map(aperture_sums).unwrap_or_default())?;
            (self.opening_image, self.opening_shape) = (image.clone(), None);
            if let Some(loaded) = &mut self.scene {
                loaded.pick = None;
            }
            self.questions = pick::none_asked();
        }
        let aperture = aperture_constant(estimator);
        if let Some(loaded) = self.scene.as_mut().filter(|loaded| loaded.aperture != aperture) {
            self.device.wait_idle()?;
            self.trace_bindings = None;
            let (shader, constants) = (self.shaders.trace, lens_constants(estimator));
            loaded.trace = Trace::new(&self.device, shader, &constants, &loaded.buffers, &self.tile)?;
            (loaded.aperture, loaded.pick) = (aperture, None);
            // What the last pick was asked, another one cannot answer.
            self.questions = pick::none_asked();
        }
        Ok(())
    }

    fn load_scene(&mut self, estimator: &Estimator) -> Result<()> {
        self.device.wait_idle()?;
        (self.scene, self.trace_bindings) = (None, None);
        self.questions = pick::none_asked();
        let (scene, shutter, aperture) =
            (estimator.scene.clone(), estimator.shutter, aperture_constant(estimator));
        let data = SceneData::new(&scene, shutter);
        let buffers = SceneBuffers::new(&self.device, &data)?;
        // A scene that is refused may also be one that the driver cannot compile the pass for.
        self.fit_loops(&buffers, estimator.max_bounces)?;
        let (shader, constants) = (self.shaders.trace, lens_constants(estimator));
        let trace = Trace::new(&self.device, shader, &constants, &buffers, &self.tile)?;
        self.tally.forget_scene(data.tree_depth > 0);
        let moves = data.moves;
        self.scene =
            Some(LoadedScene { scene, buffers, trace, aperture, moves, shutter, pick: None, geometry: None });
        Ok(())
    }

    /// Whether the film holds as many samples as wanted, or every pixel has stopped.
    pub fn finished(&self) -> bool {
        self.settings.as_ref().is_none_or(|settings| self.samples >= settings.samples)
            || self.progress().active_pixels == Some(0)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.tally.progress(self.samples)
    }

    /// Records the resolve pass, if the picture is not up to date.
    pub fn record_resolve(&mut self, recording: &mut Recording<'_>) {
        self.record_resolve_as(recording, self.blue_first);
    }

    fn record_resolve_as(&mut self, recording: &mut Recording<'_>, blue_first: bool) {
        self.record_clear(recording, true);
        self.record_depth(recording);
        let (Some(settings), Some(film)) = (&self.settings, &self.film) else {
            return;
        };
        let (bindings, preview_stride) = match self.samples {
            0 => (&film.resolve_preview, self.filled_stride),
            _ => (&film.resolve, 1),
        };
        let extent = settings.estimator.size;
        let exposure = settings.exposure();
        let overlay = OverlayScale::new(settings);
        let push = ResolvePush { extent, preview_stride, exposure, overlay, blue_first: blue_first.into() };
        let has_holes = reach(settings.estimator.jitter) > 0 || self.tally.saw_rejected_samples();
        if self.resolved == Some((push, has_holes)) {
            return;
        }
        let has_moments = settings.estimator.has_moments();
        recording.barrier();
        self.resolve.record(recording, bindings, &push, has_holes, has_moments);
        recording.barrier();
        self.resolved = Some((push, has_holes));
    }

    /// Takes in what the device measured and counted while it ran `frame`, whose commands are done.
    ///
    /// # Errors
    /// What Vulkan says: a lost device.
    pub fn collect(&mut self, frame: usize) -> Result<()> {
        self.tally.collect(frame)
    }

    /// The resolved picture, as [`Renderer::record_resolve`] left it.
    pub fn picture(&self) -> Option<&Image> {
        self.film.as_ref().map(|film| &*film.picture)
    }
}
