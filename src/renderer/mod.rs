//! Owns the film, the scene on the device, and the passes. It knows of no window and no file.
//!
//! Work is recorded in tiles, so that the time of a submission is bounded. Batches are merged into the film once they
//! are whole. The picture does not depend on the tiles: see [`schedule`]. Every `Result` can have the errors of
//! [`crate::vulkan`].
//!
//! [`Prepared`] holds the parts that settings need, and can be made on any thread. `Loaded` adds the images and the
//! bindings. [`Renderer`] records the passes.

mod excerpt;
mod film;
mod headless;
mod loaded;
mod pick;
mod prepared;
mod record;
pub mod schedule;
mod tally;
mod tiles;

pub use excerpt::Excerpt;
pub use pick::{LensRay, Picked, Question, Surface};
pub use prepared::{Keys, Prepared, Preparer};
pub use tally::Progress;

use crate::error::Result;
use crate::gpu_types::ResolvePush;
use crate::passes::Shaders;
use crate::settings::Settings;
use crate::vulkan::{Device, Image};
use excerpt::Excerpts;
use loaded::Loaded;
use schedule::{Cursor, Stage, USUAL_BATCH};
use std::sync::Arc;
use std::time::Duration;
use tally::Tally;

/// How much to record at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pace {
    /// About how long the device should work on one submission.
    pub budget: Duration,
    /// Whether a new picture starts with a preview of the whole view, coarse if time is short, so that there is always
    /// something to show.
    pub preview: bool,
}

/// Renders a picture with given settings, step by step.
pub struct Renderer {
    preparer: Arc<Preparer>,
    loaded: Loaded,
    settings: Settings,
    standing: Standing,
    tally: Tally,
    excerpts: Excerpts,
    blue_first: bool,
    usual_batch: u32,
    /// The largest batch that the loops of the scene allow on this device.
    largest_batch: u32,
}

/// The progress of a picture.
struct Standing {
    /// Samples per pixel in the film. Only whole batches count.
    samples: u32,
    /// The position in the current batch, if one has begun.
    cursor: Option<Cursor>,
    /// Which of the two lists holds the active pixels, once there is one.
    list: Option<usize>,
    filled_stride: u32,
    needs_clear: bool,
    /// How the picture was resolved, and whether with holes. `None` if the film has changed since.
    resolved: Option<(ResolvePush, bool)>,
}

impl Standing {
    /// The start of a picture.
    const START: Self =
        Self { samples: 0, cursor: None, list: None, filled_stride: 1, needs_clear: true, resolved: None };
}

impl Renderer {
    /// A renderer for these settings.
    ///
    /// # Errors
    /// As [`Self::set`].
    pub fn new(device: &Arc<Device>, settings: &Settings) -> Result<Self> {
        Self::with_shaders(device, Shaders::default(), settings)
    }

    /// A renderer for these settings that uses these shaders.
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
            excerpts: Excerpts::default(),
            blue_first: false,
            usual_batch: USUAL_BATCH,
        })
    }

    /// Sets the usual number of samples in a batch, a power of two, from the next batch on. Batches are larger once a
    /// pixel has very many samples.
    pub fn set_usual_batch(&mut self, usual_batch: u32) {
        self.usual_batch = usual_batch;
    }

    /// Sets the order of the bytes of [`Self::picture`]: b, g, r, a if true, or else r, g, b, a.
    pub fn set_blue_first(&mut self, blue_first: bool) {
        self.blue_first = blue_first;
    }

    /// Sets what to render from now on. The film starts anew if the estimator has changed or the film has more samples
    /// than wanted. After an error, everything is as before.
    ///
    /// # Errors
    /// [`crate::error::Error::OutOfRange`], [`crate::error::Error::Limit`], or those of
    /// [`crate::vulkan`].
    pub fn set(&mut self, settings: &Settings) -> Result<()> {
        self.set_and_answer(settings, self.loaded.prepared.answers())
    }

    /// Works as [`Self::set`] does. `answers` says whether questions will be asked.
    fn set_and_answer(&mut self, settings: &Settings, answers: bool) -> Result<()> {
        settings.check()?;
        let prepared = self.preparer.prepare(settings, answers, Some(&self.loaded.prepared))?;
        self.load(settings, prepared)
    }

    /// Works as [`Self::set`] does, but uses parts that were prepared for these settings, so it is fast. Parts that do
    /// not fit the settings are made anew.
    ///
    /// # Errors
    /// As [`Self::set`].
    pub fn set_prepared(&mut self, settings: &Settings, prepared: &Prepared) -> Result<()> {
        settings.check()?;
        let prepared = self.preparer.prepare(settings, prepared.answers(), Some(prepared))?;
        self.load(settings, prepared)
    }

    /// The preparer, which another thread can use to make the parts that settings need.
    pub fn preparer(&self) -> Arc<Preparer> {
        Arc::clone(&self.preparer)
    }

    /// The prepared parts in use.
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
        // A batch that is partly merged can neither be undone nor be merged again.
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

    /// The progress of the picture.
    pub fn progress(&self) -> Progress {
        self.tally.progress(self.standing.samples)
    }

    /// Collects what the device measured and counted in `frame`, whose commands must be done.
    pub fn collect(&mut self, frame: usize) -> Result<()> {
        self.tally.collect(frame)
    }

    /// The picture that [`Renderer::record_resolve`] wrote last.
    pub fn picture(&self) -> &Image {
        &self.loaded.images.picture
    }
}
