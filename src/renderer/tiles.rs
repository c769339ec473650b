//! Records the work of a submission, tile by tile.

use super::schedule::{self, Cursor, Pass, Stage, reach};
use super::tally::Work;
use super::{Pace, Renderer};
use crate::gpu_types::{AccumulatePush, ApertureBuffer, Brightest, Camera, Counters, SelectPush, TracePush};
use crate::passes::Adaptive;
use crate::settings::{Estimator, Settings};
use crate::vulkan::Recording;

/// Small pictures would otherwise record thousands of passes for one submission.
const MAX_TILES_PER_SUBMISSION: u32 = 64;
/// What choosing a pixel costs, in samples traced: it looks at nine.
const SELECT_COST: f64 = 1.0;

impl Renderer {
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
        self.record_opening(recording, &settings.estimator);
        recording.clear_buffer(&self.counters, size_of::<Counters>() as u64);
        self.tally.start(recording, frame);
        let mut done = Work::default();
        let list_before = self.list;
        for _ in 0..MAX_TILES_PER_SUBMISSION {
            if self.finished() {
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
            // How many pixels go on is known once this is done.
            if self.list != list_before {
                break;
            }
            // The first tile is recorded whatever it costs; for a small rest no other one is.
            if left <= budget / 8 && !(pace.preview && self.nothing_to_show()) {
                break;
            }
        }
        let list = self.list.filter(|list| list_before != Some(*list));
        let list = self.film.as_ref().zip(list).map(|(film, list)| film.adaptive.list(list));
        self.tally.stop(recording, frame, done, &self.counters, list);
    }

    /// Writes the opening's shape, if it has changed.
    pub(super) fn record_opening(&mut self, recording: &mut Recording<'_>, estimator: &Estimator) {
        let shape = ApertureBuffer::new(estimator);
        if self.opening_shape != Some(shape) {
            self.opening.record(recording, &shape);
            self.opening_shape = Some(shape);
        }
    }

    fn nothing_to_show(&self) -> bool {
        self.samples == 0 && self.cursor.is_none_or(Cursor::is_first_lattice)
    }

    pub(super) fn record_clear(&mut self, recording: &mut Recording<'_>, batch: bool) {
        if let (true, Some(film)) = (self.needs_clear, &mut self.film) {
            film.record_clear(recording, batch);
            self.needs_clear = false;
        }
    }

    /// Records a tile of the pass under way, for about `left` units of work, or `whole`.
    pub(super) fn record_tile(
        &mut self,
        recording: &mut Recording<'_>,
        estimator: &Estimator,
        cursor: Cursor,
        left: u64,
        whole: bool,
    ) -> Option<Work> {
        let (Some(passes), Some(scene), Some(film), Some(bindings)) =
            (&self.passes, &self.scene, &self.film, &self.trace_bindings)
        else {
            return None;
        };
        let Cursor { pass, stage, at } = cursor;
        let (cost, local) = match stage {
            Stage::Trace => (f64::from(pass.sample_count), scene.trace.local_size()),
            Stage::Accumulate => (accumulate_cost(estimator.jitter), passes.accumulate.local_size()),
            Stage::Select => (SELECT_COST, passes.select.as_ref()?.local_size()),
        };
        let whole_film = Pass::whole(0, 1, 1);
        let of_stage = if stage == Stage::Trace { pass } else { whole_film };
        let of_picture = of_stage.lattice(estimator.size);
        let [width, height] = of_stage.lattice_size(estimator.size);
        let size = match self.list {
            Some(_) => schedule::listed_size(self.most_active(estimator), local),
            // Whole rows of workgroups, for the last one is not visited last.
            None => [width, height.next_multiple_of(local[1])],
        };
        let pixels = (left as f64 / cost) as u64;
        let tile = if whole { size } else { schedule::tile(size, at, pixels, local) };
        let (lattice, rows) = match self.list {
            Some(_) => (schedule::listed_lattice(estimator.size, at, local), tile[1]),
            None => (of_picture.from_tile(at), schedule::rows_of_pixels(&of_picture, height, at[1], tile[1])),
        };
        let tile_pixels = u64::from(tile[0]) * u64::from(rows);
        let list = self.list.unwrap_or_default();
        if tile_pixels > 0 {
            match stage {
                Stage::Trace => {
                    let push = TracePush {
                        camera: Camera::new(estimator),
                        lattice,
                        seed: estimator.seed,
                        max_bounces: estimator.max_bounces,
                        first_sample: pass.first_sample,
                        sample_count: pass.sample_count,
                    };
                    scene.trace.record(recording, &bindings[list], &push, tile);
                }
                Stage::Accumulate => {
                    let push = AccumulatePush {
                        lattice,
                        seed: estimator.seed,
                        first_sample: pass.first_sample,
                        jitter: estimator.jitter,
                        reach: i32::try_from(reach(estimator.jitter)).unwrap_or(i32::MAX),
                    };
                    passes.accumulate.record(recording, &film.accumulate[list], &push, tile);
                }
                Stage::Select => {
                    if at == [0, 0] {
                        recording.clear_buffer(film.adaptive.list(1 - list), Adaptive::LIST_HEADER);
                        if self.list.is_none() {
                            film.adaptive.record_brightest(recording, &Brightest::new(estimator));
                        }
                    }
                    let [cell, ..] = Brightest::grid(estimator.size);
                    let push = SelectPush { lattice, threshold: estimator.noise_threshold, cell };
                    passes.select.as_ref()?.record(recording, &film.select.as_ref()?[list], &push, tile);
                }
            }
        }
        match schedule::after_tile(size, at, tile) {
            Some(at) => self.cursor = Some(Cursor { at, ..cursor }),
            None => {
                recording.barrier();
                self.finish(cursor, estimator);
            }
        }
        let counted = stage == Stage::Trace && self.list.is_none();
        let samples = if counted { tile_pixels * u64::from(pass.sample_count) } else { 0 };
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
                let longest = self.max_batch.min(self.largest_batch);
                let max_batch = if wide {
                    1
                } else if estimator.is_adaptive() {
                    longest.min(schedule::SELECT_EVERY)
                } else {
                    longest
                };
                Pass::whole(self.samples, settings.samples, max_batch)
            }
        }
    }

    /// How many pixels are still traced, at most.
    fn most_active(&self, estimator: &Estimator) -> u64 {
        let [width, height] = estimator.size.map(u64::from);
        self.progress().active_pixels.unwrap_or(width * height)
    }

    /// The last tile of a stage is recorded: what comes after?
    fn finish(&mut self, cursor: Cursor, estimator: &Estimator) {
        self.resolved = None;
        let end = cursor.pass.end();
        self.cursor = match cursor.stage {
            Stage::Trace => {
                self.filled_stride = cursor.pass.filled_stride();
                Some(cursor.after_tracing())
            }
            Stage::Accumulate => {
                self.samples = end;
                let selects = estimator.is_adaptive() && schedule::selects_at(end);
                selects.then(|| cursor.stage(Stage::Select))
            }
            Stage::Select => {
                self.list = Some(1 - self.list.unwrap_or_default());
                None
            }
        };
    }
}

/// What accumulating a pixel costs, in samples traced: about an eighth for each texel it looks at.
fn accumulate_cost(jitter: f32) -> f64 {
    let across = f64::from(2 * reach(jitter) + 1);
    across * across / 8.0
}
