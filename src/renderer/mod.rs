//! Owns the film, the scene on the device, and the passes. Knows no window and no file.
//!
//! Work is recorded in tiles whose time is bounded; whole passes are merged into the film.
//! None of that changes the picture: see [`schedule`].

mod film;
mod headless;
pub mod schedule;
mod tally;

pub use tally::Progress;

use crate::error::{Error, Result};
use crate::gpu_types::{
    AccumulatePush, Camera, Counters, ResolvePush, SceneData, TracePush, sampler_constant,
};
use crate::passes::{Accumulate, Resolve, SceneBuffers, Shaders, Trace};
use crate::scene::SceneRef;
use crate::settings::{Estimator, Sampler, Settings, View};
use crate::vulkan::{BindingSet, Buffer, Device, Image, Recording, Residence, SOFTWARE};
use film::Film;
use schedule::{Cursor, MAX_BATCH, Pass, reach};
use std::sync::Arc;
use std::time::Duration;
use tally::{Tally, Work};

/// Small pictures would otherwise record thousands of passes for one submission.
const MAX_TILES_PER_SUBMISSION: u32 = 64;
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
    trace_bindings: Option<BindingSet>,
    shaders: Shaders,
    /// What the passes are compiled for.
    sampler: Sampler,
    accumulate: Accumulate,
    resolve: Resolve,
    counters: Arc<Buffer>,
    tally: Tally,
    settings: Option<Settings>,
    /// Samples per pixel in the film, from whole passes.
    samples: u32,
    /// The pass under way.
    cursor: Option<Cursor>,
    filled_stride: u32,
    needs_clear: bool,
    /// How the picture was resolved, unless the film has changed since.
    resolved: Option<View>,
    blue_first: bool,
    max_batch: u32,
    /// What the scene's loops allow.
    largest_batch: u32,
    device: Arc<Device>,
}

struct LoadedScene {
    scene: SceneRef,
    buffers: SceneBuffers,
    trace: Trace,
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
        let sampler = Sampler::default();
        let size = size_of::<Counters>() as u64;
        Ok(Self {
            scene: None,
            film: None,
            trace_bindings: None,
            shaders,
            sampler,
            accumulate: Accumulate::new(device, shaders.accumulate, sampler_constant(sampler))?,
            resolve: Resolve::new(device, shaders.resolve)?,
            counters: Arc::new(Buffer::new(device, "counters", size, Residence::Device)?),
            tally: Tally::new(device)?,
            settings: None,
            samples: 0,
            cursor: None,
            filled_stride: 1,
            needs_clear: false,
            resolved: None,
            blue_first: false,
            max_batch: MAX_BATCH,
            largest_batch: 1,
            device: Arc::clone(device),
        })
    }

    /// Cuts batches at other sample indices from the next pass on: a power of two.
    pub fn set_max_batch(&mut self, max_batch: u32) {
        self.max_batch = max_batch;
    }

    /// Resolves to b, g, r, a bytes from now on, for a window that wants them, or to r, g, b, a.
    pub fn set_blue_first(&mut self, blue_first: bool) {
        if self.blue_first != blue_first {
            (self.blue_first, self.resolved) = (blue_first, None);
        }
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
        if self.sampler != estimator.sampler {
            self.device.wait_idle()?;
            (self.scene, self.film, self.trace_bindings) = (None, None, None);
            let sampler = sampler_constant(estimator.sampler);
            self.accumulate = Accumulate::new(&self.device, self.shaders.accumulate, sampler)?;
            self.sampler = estimator.sampler;
        }
        if self.scene.as_ref().is_none_or(|loaded| loaded.scene != estimator.scene) {
            self.load_scene(&estimator.scene)?;
        }
        self.largest_batch = self.fit_loops(estimator.max_bounces)?;
        if self.film.as_ref().is_none_or(|film| film.film.extent() != estimator.size) {
            self.device.wait_idle()?;
            (self.film, self.trace_bindings) = (None, None);
            self.film = Some(Film::new(&self.device, estimator.size, &self.accumulate, &self.resolve)?);
        }
        if let (None, Some(loaded), Some(film)) = (&self.trace_bindings, &self.scene, &self.film) {
            self.trace_bindings = Some(loaded.trace.bind(&loaded.buffers, &film.batch, &self.counters)?);
            restart = true;
        }
        if restart {
            self.samples = 0;
            self.cursor = None;
            self.filled_stride = 1;
            self.needs_clear = true;
            self.resolved = None;
            self.tally.restart();
        }
        if self.cursor.is_some_and(|cursor| cursor.pass.end() > settings.samples) {
            self.cursor = None;
        }
        self.settings = Some(settings.clone());
        Ok(())
    }

    /// The batch that the scene's loops allow.
    fn fit_loops(&self, max_bounces: u32) -> Result<u32> {
        let steps = self.scene.as_ref().map_or(0, |loaded| loaded.buffers.most_loop_steps(max_bounces));
        match schedule::largest_batch(steps) {
            Some(batch) => Ok(batch),
            None if self.device.info().kind != SOFTWARE => Ok(1),
            None => Err(Error::OutOfRange(format!(
                "the scene can take {steps} steps a sample, but software devices stop at {}; use fewer planes or \
                 lights, a lower --max-bounces, or a GPU",
                schedule::MAX_LOOP_STEPS
            ))),
        }
    }

    fn load_scene(&mut self, scene: &SceneRef) -> Result<()> {
        self.device.wait_idle()?;
        (self.scene, self.trace_bindings) = (None, None);
        let buffers = SceneBuffers::new(&self.device, &SceneData::new(scene))?;
        let trace = Trace::new(&self.device, self.shaders.trace, sampler_constant(self.sampler), &buffers)?;
        self.tally.forget_scene();
        self.scene = Some(LoadedScene { scene: scene.clone(), buffers, trace });
        Ok(())
    }

    /// Whether the film holds as many samples as wanted.
    pub fn finished(&self) -> bool {
        self.settings.as_ref().is_none_or(|settings| self.samples >= settings.samples)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.tally.progress(self.samples)
    }

    /// Records the next passes and tiles, as many as `pace` allows. `frame` says which of the
    /// frames in flight this is; [`Renderer::collect`] must have been called for its last use.
    ///
    /// # Panics
    /// Before the first [`Renderer::set`].
    pub fn record(&mut self, recording: &mut Recording<'_>, frame: usize, pace: Pace) {
        let settings = self.settings.clone().expect("set() comes first");
        let scene = self.scene.as_ref().expect("set() comes first");
        let most_rays = scene.buffers.most_rays(settings.estimator.max_bounces);
        // Rays are counted in 32 bits a submission.
        let budget = self.tally.work_within(pace.budget).min(u64::from(u32::MAX / most_rays));
        let mut left = budget;

        recording.barrier();
        // A preview shows no more of the tracing image than what it has filled.
        self.record_clear(recording, !pace.preview);
        recording.clear_buffer(&self.counters);
        self.tally.start(recording, frame);
        let mut done = Work::default();
        for _ in 0..MAX_TILES_PER_SUBMISSION {
            if self.samples >= settings.samples {
                break;
            }
            let cursor =
                self.cursor.unwrap_or_else(|| Cursor::start(self.next_pass(&settings, left, pace.preview)));
            // The first lattice of a preview is traced whole: without it there is nothing to show.
            let whole = pace.preview && self.nothing_to_show();
            let Some(work) = self.record_tile(recording, &settings.estimator, cursor, left, whole) else {
                break;
            };
            done.samples += work.samples;
            done.cost += work.cost;
            left = left.saturating_sub(work.cost);
            // The first tile is recorded whatever it costs; for a small rest no other one is.
            if left <= budget / 8 && !(pace.preview && self.nothing_to_show()) {
                break;
            }
        }
        self.tally.stop(recording, frame, done, &self.counters);
    }

    fn nothing_to_show(&self) -> bool {
        self.samples == 0 && self.cursor.is_none_or(Cursor::is_first_lattice)
    }

    fn record_clear(&mut self, recording: &mut Recording<'_>, batch: bool) {
        if let (true, Some(film)) = (self.needs_clear, &mut self.film) {
            film.record_clear(recording, batch);
            self.needs_clear = false;
        }
    }

    /// Records a tile of the pass under way, for about `left` units of work, or `whole`.
    fn record_tile(
        &mut self,
        recording: &mut Recording<'_>,
        estimator: &Estimator,
        cursor: Cursor,
        left: u64,
        whole: bool,
    ) -> Option<Work> {
        let (scene, film, bindings) = match (&self.scene, &self.film, &self.trace_bindings) {
            (Some(scene), Some(film), Some(bindings)) => (scene, film, bindings),
            _ => return None,
        };
        let Cursor { pass, at, accumulating } = cursor;
        let size = if accumulating { estimator.size } else { pass.lattice_size(estimator.size) };
        let (cost, local) = if accumulating {
            (accumulate_cost(estimator.jitter), self.accumulate.local_size())
        } else {
            (f64::from(pass.sample_count), scene.trace.local_size())
        };
        let pixels = (left as f64 / cost) as u64;
        let tile = if whole { size } else { schedule::tile(size, at, pixels, local) };
        let tile_pixels = u64::from(tile[0]) * u64::from(tile[1]);

        let mut lattice = if accumulating { Pass::whole(0, 1, 1) } else { pass }.lattice(estimator.size);
        lattice.origin = [0, 1].map(|axis| lattice.origin[axis] + at[axis] * lattice.stride);
        if tile_pixels > 0 && accumulating {
            let push = AccumulatePush {
                lattice,
                seed: estimator.seed,
                first_sample: pass.first_sample,
                jitter: estimator.jitter,
                reach: i32::try_from(reach(estimator.jitter)).unwrap_or(i32::MAX),
            };
            self.accumulate.record(recording, &film.accumulate, &push, tile);
        } else if tile_pixels > 0 {
            let push = TracePush {
                camera: Camera::new(estimator),
                lattice,
                seed: estimator.seed,
                max_bounces: estimator.max_bounces,
                first_sample: pass.first_sample,
                sample_count: pass.sample_count,
            };
            scene.trace.record(recording, bindings, &push, tile);
        }
        match schedule::after_tile(size, at, tile) {
            Some(at) => self.cursor = Some(Cursor { at, ..cursor }),
            None => {
                recording.barrier();
                self.finish(cursor);
            }
        }
        let samples = if accumulating { 0 } else { tile_pixels * u64::from(pass.sample_count) };
        Some(Work { samples, cost: (tile_pixels as f64 * cost).ceil() as u64 })
    }

    fn next_pass(&self, settings: &Settings, left: u64, preview: bool) -> Pass {
        let estimator = &settings.estimator;
        let [width, height] = estimator.size.map(u64::from);
        match width * height {
            // A cell's texel is the third of four each way.
            pixels if preview && self.samples == 0 && pixels / 4 > left && width.min(height) > 2 => {
                Pass::interleaved(4)
            }
            pixels if preview && self.samples == 0 && pixels > left => Pass::interleaved(2),
            _ if preview && self.samples == 0 => Pass::interleaved(1),
            _ => {
                // A sample that strays must be found again by its index, so it travels alone.
                let wide = reach(estimator.jitter) > 0;
                let max_batch = if wide { 1 } else { self.max_batch.min(self.largest_batch) };
                Pass::whole(self.samples, settings.samples, max_batch)
            }
        }
    }

    /// The last tile of a pass is recorded: what comes after?
    fn finish(&mut self, cursor: Cursor) {
        self.resolved = None;
        self.cursor = None;
        if cursor.accumulating {
            self.samples = cursor.pass.end();
        } else {
            self.filled_stride = cursor.pass.filled_stride();
            self.cursor = Some(cursor.after_tracing());
        }
    }

    /// Records the resolve pass, if the picture is not up to date.
    pub fn record_resolve(&mut self, recording: &mut Recording<'_>) {
        self.record_clear(recording, true);
        let (Some(settings), Some(film)) = (&self.settings, &self.film) else {
            return;
        };
        if self.resolved == Some(settings.view) {
            return;
        }
        let (bindings, preview_stride) = match self.samples {
            0 => (&film.resolve_preview, self.filled_stride),
            _ => (&film.resolve, 1),
        };
        let extent = settings.estimator.size;
        let push = ResolvePush {
            extent,
            preview_stride,
            exposure: settings.view.exposure_stops.exp2(),
            blue_first: self.blue_first.into(),
        };
        recording.barrier();
        // A cell of the preview at the picture's edge may have no texel of its own.
        let has_holes =
            preview_stride > 1 || reach(settings.estimator.jitter) > 0 || self.tally.saw_rejected_samples();
        self.resolve.record(recording, bindings, &push, has_holes);
        recording.barrier();
        self.resolved = Some(settings.view);
    }

    /// Takes in what the device measured and counted while it ran `frame`, whose commands are done.
    ///
    /// # Errors
    /// What Vulkan says: a lost device.
    pub fn collect(&mut self, frame: usize) -> Result<()> {
        let holes_were_known = self.tally.saw_rejected_samples();
        self.tally.collect(frame)?;
        if self.tally.saw_rejected_samples() != holes_were_known {
            self.resolved = None;
        }
        Ok(())
    }

    /// The resolved picture, as [`Renderer::record_resolve`] left it.
    pub fn picture(&self) -> Option<&Image> {
        self.film.as_ref().map(|film| &*film.picture)
    }
}

/// What accumulating a pixel costs, in samples traced: about an eighth for each texel it looks at.
fn accumulate_cost(jitter: f32) -> f64 {
    let across = f64::from(2 * reach(jitter) + 1);
    across * across / 8.0
}
