//! Owns the film, the scene on the device, and the passes. Knows no window and no file.
//!
//! Work is recorded in tiles of rows whose time is bounded; whole passes are merged into the film.
//! None of that changes the picture: see [`schedule`].

mod film;
pub mod schedule;
mod tally;

pub use tally::Progress;

use crate::error::Result;
use crate::gpu_types::{AccumulatePush, Camera, Counters, ResolvePush, SceneData, TracePush};
use crate::passes::{Accumulate, Resolve, SceneBuffers, Trace};
use crate::scene::SceneRef;
use crate::settings::{Estimator, Settings, View};
use crate::vulkan::{BindingSet, Buffer, Commands, Device, Image, Recording, Residence};
use film::Film;
use schedule::{MAX_BATCH, Pass, reach};
use std::sync::Arc;
use std::time::Duration;
use tally::Tally;

/// Small pictures would otherwise record thousands of passes for one submission.
const MAX_PASSES_PER_SUBMISSION: u32 = 64;
/// How long a headless submission works: far below what desktop drivers kill a dispatch for.
const HEADLESS_BUDGET: Duration = Duration::from_millis(100);

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
    accumulate: Accumulate,
    resolve: Resolve,
    counters: Arc<Buffer>,
    tally: Tally,
    settings: Option<Settings>,
    /// Samples per pixel in the film, from whole passes.
    samples: u32,
    /// The pass under way, and how many of the lattice's rows are traced.
    cursor: Option<(Pass, u32)>,
    filled_stride: u32,
    needs_clear: bool,
    resolved: Option<(View, u32)>,
    max_batch: u32,
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
        let size = size_of::<Counters>() as u64;
        Ok(Self {
            scene: None,
            film: None,
            trace_bindings: None,
            accumulate: Accumulate::new(device)?,
            resolve: Resolve::new(device)?,
            counters: Arc::new(Buffer::new(device, "counters", size, Residence::Device)?),
            tally: Tally::new(device)?,
            settings: None,
            samples: 0,
            cursor: None,
            filled_stride: 1,
            needs_clear: false,
            resolved: None,
            max_batch: MAX_BATCH,
            device: Arc::clone(device),
        })
    }

    /// Cuts batches at other sample indices from the next picture on: a power of two, at most 16
    /// unless for measuring.
    pub fn set_max_batch(&mut self, max_batch: u32) {
        self.max_batch = max_batch;
    }

    /// What to render from now on. The film starts anew where the estimator changed, or where it
    /// already holds more samples than wanted.
    ///
    /// # Errors
    /// [`crate::error::Error::OutOfRange`], [`crate::error::Error::DeviceMemory`], or what Vulkan
    /// says.
    pub fn set(&mut self, settings: &Settings) -> Result<()> {
        settings.check()?;
        let last = self.settings.as_ref();
        let restart =
            last.is_none_or(|last| last.estimator != settings.estimator) || settings.samples < self.samples;
        let estimator = &settings.estimator;
        if self.scene.as_ref().is_none_or(|loaded| loaded.scene != estimator.scene) {
            self.load_scene(&estimator.scene)?;
        }
        if self.film.as_ref().is_none_or(|film| film.film.extent() != estimator.size) {
            self.device.wait_idle()?;
            (self.film, self.trace_bindings) = (None, None);
            self.film = Some(Film::new(&self.device, estimator.size, &self.accumulate, &self.resolve)?);
        }
        if let (None, Some(loaded), Some(film)) = (&self.trace_bindings, &self.scene, &self.film) {
            self.trace_bindings = Some(loaded.trace.bind(&loaded.buffers, &film.batch, &self.counters)?);
        }
        if restart {
            self.samples = 0;
            self.cursor = None;
            self.filled_stride = 1;
            self.needs_clear = true;
            self.resolved = None;
            self.tally.restart();
        }
        if self.cursor.is_some_and(|(pass, _)| pass.end() > settings.samples) {
            self.cursor = None;
        }
        self.settings = Some(settings.clone());
        Ok(())
    }

    fn load_scene(&mut self, scene: &SceneRef) -> Result<()> {
        self.device.wait_idle()?;
        (self.scene, self.trace_bindings) = (None, None);
        let buffers = SceneBuffers::new(&self.device, &SceneData::new(scene))?;
        let trace = Trace::new(&self.device, &buffers)?;
        self.tally.forget_rate();
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
        let most_rays = (1 + settings.estimator.max_bounces).saturating_mul(1 + scene.buffers.light_count());
        // Rays are counted in 32 bits a submission.
        let mut left = self.tally.pixel_samples_within(pace.budget).min(u64::from(u32::MAX / most_rays));

        recording.barrier();
        if self.needs_clear {
            self.film.as_mut().expect("set() comes first").record_clear(recording);
            self.needs_clear = false;
        }
        recording.clear_buffer(&self.counters);
        self.tally.start(recording, frame);
        let mut traced = 0;
        for _ in 0..MAX_PASSES_PER_SUBMISSION {
            if self.samples >= settings.samples {
                break;
            }
            let must = traced == 0 || (pace.preview && self.film_is_empty());
            let Some(pixel_samples) = self.record_tile(recording, &settings, left, must, pace.preview) else {
                break;
            };
            traced += pixel_samples;
            left = left.saturating_sub(pixel_samples);
        }
        self.tally.stop(recording, frame, traced, &self.counters);
    }

    fn film_is_empty(&self) -> bool {
        self.samples == 0 && self.cursor.is_none_or(|(pass, _)| pass.phase == 0)
    }

    /// Records rows of the pass under way, or of the next one: as many as `left` pixel samples
    /// allow. None if that is not even one row of workgroups and nothing `must` be recorded.
    fn record_tile(
        &mut self,
        recording: &mut Recording<'_>,
        settings: &Settings,
        left: u64,
        must: bool,
        preview: bool,
    ) -> Option<u64> {
        let estimator = &settings.estimator;
        let (pass, row) = match self.cursor {
            Some(cursor) => cursor,
            None => (self.next_pass(settings, left, preview), 0),
        };
        let [columns, all_rows] = pass.lattice_size(estimator.size);
        let (scene, film, bindings) = match (&self.scene, &self.film, &self.trace_bindings) {
            (Some(scene), Some(film), Some(bindings)) => (scene, film, bindings),
            _ => return None,
        };

        // The first lattice of a preview is traced whole: without it there is nothing to show.
        let whole = preview && self.film_is_empty();
        let per_row = u64::from(columns) * u64::from(pass.sample_count);
        let granularity = scene.trace.row_granularity();
        let affordable = u32::try_from(left / per_row.max(1)).unwrap_or(u32::MAX);
        let affordable = affordable / granularity * granularity;
        if affordable == 0 && !must {
            return None;
        }
        let rows = if whole { all_rows } else { affordable.max(granularity).min(all_rows - row) };

        if rows > 0 && columns > 0 {
            let mut tile = pass.lattice(estimator.size);
            tile.origin[1] += row * pass.stride;
            let push = TracePush {
                camera: Camera::new(estimator),
                lattice: tile,
                seed: estimator.seed,
                max_bounces: estimator.max_bounces,
                first_sample: pass.first_sample,
                sample_count: pass.sample_count,
            };
            scene.trace.record(recording, bindings, &push, [columns, rows]);
        }
        if row + rows < all_rows {
            self.cursor = Some((pass, row + rows));
        } else {
            recording.barrier();
            let push = accumulate_push(estimator, pass);
            self.accumulate.record(recording, &film.accumulate, &push, [columns, all_rows]);
            recording.barrier();
            self.finish(pass);
        }
        Some(per_row * u64::from(rows))
    }

    fn next_pass(&self, settings: &Settings, left: u64, preview: bool) -> Pass {
        let estimator = &settings.estimator;
        let wide = reach(estimator.jitter) > 0;
        if self.samples > 0 || !(wide || preview) {
            let max_batch = if wide { 1 } else { self.max_batch };
            return Pass::whole(self.samples, settings.samples, max_batch);
        }
        // Where samples stray, the order of merging follows the phases, so they are always the same.
        let [width, height] = estimator.size.map(u64::from);
        let stride = match width * height {
            _ if wide => 4,
            pixels if pixels <= left => 1,
            pixels if pixels / 4 <= left => 2,
            _ => 4,
        };
        Pass::interleaved(stride)
    }

    fn finish(&mut self, pass: Pass) {
        self.resolved = None;
        self.filled_stride = pass.filled_stride();
        match pass.next_phase() {
            Some(next) => self.cursor = Some((next, 0)),
            None => {
                self.cursor = None;
                self.samples = pass.end();
            }
        }
    }

    /// Records the resolve pass, if the picture is not up to date.
    pub fn record_resolve(&mut self, recording: &mut Recording<'_>) {
        let (Some(settings), Some(film)) = (&self.settings, &mut self.film) else {
            return;
        };
        if self.needs_clear {
            film.record_clear(recording);
            self.needs_clear = false;
        }
        let state = (settings.view, self.filled_stride);
        if self.resolved == Some(state) {
            return;
        }
        let push = ResolvePush {
            extent: settings.estimator.size,
            preview_stride: self.filled_stride,
            exposure: settings.view.exposure_stops.exp2(),
        };
        recording.barrier();
        self.resolve.record(recording, &film.resolve, &push);
        recording.barrier();
        self.resolved = Some(state);
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

    /// Renders until the target is reached. `on_progress` is called after every submission.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn render(&mut self, on_progress: impl FnMut(&Progress)) -> Result<()> {
        let pace = Pace { budget: HEADLESS_BUDGET, preview: false };
        self.render_at(pace, on_progress)
    }

    /// Likewise, at another pace.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn render_at(&mut self, pace: Pace, mut on_progress: impl FnMut(&Progress)) -> Result<()> {
        let mut commands = Commands::new(&self.device)?;
        while !self.finished() {
            let mut recording = commands.begin()?;
            self.record(&mut recording, 0, pace);
            recording.submit()?;
            commands.wait()?;
            self.collect(0)?;
            on_progress(&self.progress());
        }
        Ok(())
    }

    /// The film: mean r, g, b and count of each pixel, row by row from the top left.
    ///
    /// # Errors
    /// [`crate::error::Error::DeviceMemory`], or what Vulkan says.
    pub fn read_film(&mut self) -> Result<Vec<[f32; 4]>> {
        let bytes = self.read_image(|film| &film.film)?;
        Ok(bytemuck::allocation::pod_collect_to_vec(&bytes))
    }

    /// The picture: r, g, b, 255 of each pixel, sRGB, row by row from the top left.
    ///
    /// # Errors
    /// [`crate::error::Error::DeviceMemory`], or what Vulkan says.
    pub fn read_picture(&mut self) -> Result<Vec<u8>> {
        self.read_image(|film| &film.picture)
    }

    fn read_image(&mut self, choose: impl Fn(&Film) -> &Image) -> Result<Vec<u8>> {
        let size = self.film.as_ref().map_or(0, |film| choose(film).byte_len());
        let buffer = Buffer::new(&self.device, "read-back", size, Residence::Host)?;
        let mut commands = Commands::new(&self.device)?;
        let mut recording = commands.begin()?;
        recording.barrier();
        self.record_resolve(&mut recording);
        if let Some(film) = &self.film {
            recording.copy_image(choose(film), &buffer);
        }
        recording.submit()?;
        commands.wait()?;
        Ok(buffer.bytes()[..usize::try_from(size).unwrap_or(0)].to_vec())
    }
}

fn accumulate_push(estimator: &Estimator, pass: Pass) -> AccumulatePush {
    AccumulatePush {
        lattice: pass.lattice(estimator.size),
        seed: estimator.seed,
        first_sample: pass.first_sample,
        jitter: estimator.jitter,
        reach: i32::try_from(reach(estimator.jitter)).unwrap_or(i32::MAX),
    }
}
