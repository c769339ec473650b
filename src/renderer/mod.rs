//! Owns the film, the scene on the device, and the passes. Knows no window and no file.
//!
//! Work is recorded in tiles whose time is bounded; whole batches are merged into the film.
//! None of that changes the picture: see [`schedule`]. Every `Result` can have the errors of [`crate::vulkan`].
//!
//! What settings need is [`Prepared`], on any thread; with the images of the film it is `Loaded`; and [`Renderer`]
//! records passes on it.

mod film;
mod headless;
mod loaded;
mod pick;
mod prepared;
mod record;
pub mod schedule;
mod tally;
mod tiles;

pub use pick::{LensRay, Picked, Question, Surface};
pub use prepared::{Keys, Prepared, Preparer};
pub use tally::Progress;

use crate::error::Result;
use crate::gpu_types::ResolvePush;
use crate::passes::Shaders;
use crate::settings::Settings;
use crate::vulkan::{Device, Image};
use loaded::Loaded;
use schedule::{Cursor, MAX_BATCH, Stage};
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
    preparer: Arc<Preparer>,
    loaded: Loaded,
    settings: Settings,
    standing: Standing,
    tally: Tally,
    blue_first: bool,
    max_batch: u32,
    /// The largest batch that the scene's loops allow.
    largest_batch: u32,
}

/// How far a picture is.
struct Standing {
    /// Samples per pixel in the film, from whole batches.
    samples: u32,
    /// The batch under way.
    cursor: Option<Cursor>,
    /// Which of the lists holds the active pixels, once some have stopped.
    list: Option<usize>,
    filled_stride: u32,
    needs_clear: bool,
    /// How the picture was resolved, and whether with holes, unless the film has changed since.
    resolved: Option<(ResolvePush, bool)>,
}

impl Standing {
    /// Nothing is traced yet.
    const START: Self =
        Self { samples: 0, cursor: None, list: None, filled_stride: 1, needs_clear: true, resolved: None };
}

impl Renderer {
    /// A renderer of these settings.
    ///
    /// # Errors
    /// As [`Self::set`].
    pub fn new(device: &Arc<Device>, settings: &Settings) -> Result<Self> {
        Self::with_shaders(device, Shaders::default(), settings)
    }

    /// A renderer of these settings, with these shaders for its passes.
    ///
    /// # Errors
    /// As [`Self::set`].
    pub fn with_shaders(device: &Arc<Device>, shaders: Shaders, settings: &Settings) -> Result<Self> {
        settings.check()?;
        let preparer = Preparer::new(device, shaders)?;
        let prepared = preparer.prepare(settings, false, None)?;
        let mut tally = Tally::new(device)?;
        tally.forget_scene(prepared.scene.has_tree());
        Ok(Self {
            largest_batch: preparer.largest_batch(&prepared.scene, &settings.estimator)?,
            loaded: Loaded::new(&preparer, settings, prepared)?,
            preparer: Arc::new(preparer),
            settings: settings.clone(),
            standing: Standing::START,
            tally,
            blue_first: false,
            max_batch: MAX_BATCH,
        })
    }

    /// Cuts batches at other sample indices from the next one on: a power of two.
    pub fn set_max_batch(&mut self, max_batch: u32) {
        self.max_batch = max_batch;
    }

    /// Whether a window wants b, g, r, a bytes of [`Self::picture`] from now on, or r, g, b, a.
    pub fn set_blue_first(&mut self, blue_first: bool) {
        self.blue_first = blue_first;
    }

    /// What to render from now on. The film starts anew where the estimator changed, or where it
    /// already holds more samples than wanted. After an error it is what it was before.
    ///
    /// # Errors
    /// [`crate::error::Error::OutOfRange`], [`crate::error::Error::Limit`], or those of
    /// [`crate::vulkan`].
    pub fn set(&mut self, settings: &Settings) -> Result<()> {
        self.set_and_answer(settings, self.loaded.prepared.answers())
    }

    /// Does as [`Self::set`]. `answers` says whether questions are asked of the picture.
    fn set_and_answer(&mut self, settings: &Settings, answers: bool) -> Result<()> {
        settings.check()?;
        let prepared = self.preparer.prepare(settings, answers, Some(&self.loaded.prepared))?;
        self.load(settings, prepared)
    }

    /// Does as [`Self::set`] with parts that were prepared for these settings, so that it takes no time. Parts that do not
    /// fit the settings are made anew.
    ///
    /// # Errors
    /// As [`Self::set`].
    pub fn set_prepared(&mut self, settings: &Settings, prepared: &Prepared) -> Result<()> {
        settings.check()?;
        let prepared = self.preparer.prepare(settings, prepared.answers(), Some(prepared))?;
        self.load(settings, prepared)
    }

    /// What makes ready what settings need, in another thread.
    pub fn preparer(&self) -> Arc<Preparer> {
        Arc::clone(&self.preparer)
    }

    /// What is ready.
    pub fn prepared(&self) -> &Prepared {
        &self.loaded.prepared
    }

    fn load(&mut self, settings: &Settings, prepared: Prepared) -> Result<()> {
        let largest_batch = self.preparer.largest_batch(&prepared.scene, &settings.estimator)?;
        let another_scene = !Arc::ptr_eq(&prepared.scene, &self.loaded.prepared.scene);
        if !self.loaded.fits(settings, &prepared) {
            self.loaded.replace(&self.preparer, settings, prepared)?;
        }
        self.largest_batch = largest_batch;
        if another_scene {
            self.tally.forget_scene(self.loaded.prepared.scene.has_tree());
        }
        let last = std::mem::replace(&mut self.settings, settings.clone());
        let too_far = |cursor: &Cursor| cursor.batch.end() > settings.samples;
        // What is half merged can neither be taken back nor be merged again.
        let merges_too_much = |cursor: &Cursor| too_far(cursor) && cursor.stage == Stage::Accumulate;
        if last.estimator != settings.estimator
            || settings.samples < self.standing.samples
            || self.standing.cursor.as_ref().is_some_and(merges_too_much)
        {
            self.standing = Standing::START;
            self.tally.restart();
        }
        if self.standing.cursor.as_ref().is_some_and(too_far) {
            self.standing.cursor = None;
        }
        Ok(())
    }

    /// Whether the film holds as many samples as wanted, or every pixel has stopped.
    pub fn finished(&self) -> bool {
        self.standing.samples >= self.settings.samples || self.progress().active_pixels == Some(0)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.tally.progress(self.standing.samples)
    }

    /// Takes in what the device measured and counted while it ran `frame`, whose commands are done.
    pub fn collect(&mut self, frame: usize) -> Result<()> {
        self.tally.collect(frame)
    }

    /// The resolved picture, as [`Renderer::record_resolve`] left it.
    pub fn picture(&self) -> &Image {
        &self.loaded.images.picture
    }
}
