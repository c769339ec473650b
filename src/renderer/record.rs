//! Records the passes in the order in which data flows through them.

use super::film::Seen;
use super::loaded::Loaded;
use super::prepared::{most_bounces, samples_lights};
use super::schedule::{Stage, reach};
use super::tally::Work;
use super::tiles::Tile;
use super::{Pace, Renderer};
use crate::gpu_types::{
    AccumulatePush, ApertureBuffer, Brightest, Camera, Counters, GeometryPush, OverlayScale, ResolvePush,
    SelectPush, TracePush, limits,
};
use crate::passes::AdaptiveBuffers;
use crate::vulkan::Recording;

/// The most tiles in one submission. Without this limit, a small picture would need thousands.
const MAX_TILES_PER_SUBMISSION: u32 = 64;

impl Renderer {
    /// Records the next tiles, as many as `pace` allows. `frame` is the number of the frame in flight;
    /// [`Renderer::collect`] must have been called for its last use.
    pub fn record(&mut self, recording: &mut Recording<'_>, frame: usize, pace: Pace) {
        recording.barrier();
        // A preview shows only the part of the tracing image that has been filled.
        self.record_clear(recording, !pace.preview);
        self.record_aperture(recording);
        recording.clear_buffer(&self.preparer.counters, size_of::<Counters>() as u64);
        self.tally.start(recording, frame);
        let list_before = self.standing.list;
        let done = self.record_tiles(recording, pace);
        let list = self.standing.list.filter(|list| list_before != Some(*list));
        let list = list.map(|list| self.loaded.images.adaptive.list(list));
        self.tally.stop(recording, frame, done, &self.preparer.counters, list);
    }

    fn record_tiles(&mut self, recording: &mut Recording<'_>, pace: Pace) -> Work {
        // The rays of a submission are counted in 32 bits.
        let scene = &self.loaded.prepared.scene;
        let estimator = &self.settings.estimator;
        let max_rays = scene.max_rays(samples_lights(estimator), most_bounces(scene, estimator));
        let budget = self.tally.work_within(pace.budget).min(u64::from(u32::MAX / max_rays));
        let mut left = budget;
        let mut done = Work::default();
        let list_before = self.standing.list;
        for _ in 0..MAX_TILES_PER_SUBMISSION {
            if self.finished() {
                break;
            }
            let cursor = self.next_cursor(left, pace.preview);
            // The first lattice of a preview is traced whole, because without it there is nothing to show.
            let tile = self.tile(cursor, left, pace.preview && self.nothing_to_show());
            self.record_tile(recording, &tile);
            done.samples += tile.work.samples;
            done.cost += tile.work.cost;
            left = left.saturating_sub(tile.work.cost);
            // The number of active pixels is known only once this submission is done.
            if self.standing.list != list_before {
                break;
            }
            // The first tile is recorded whatever it costs. Another tile is not worth it for a small rest of the
            // budget.
            if left <= budget / 8 && !(pace.preview && self.nothing_to_show()) {
                break;
            }
        }
        done
    }

    /// Records the pass for a tile.
    pub(super) fn record_tile(&mut self, recording: &mut Recording<'_>, tile: &Tile) {
        let Loaded { passes, images, .. } = &self.loaded;
        let estimator = &self.settings.estimator;
        let Tile { cursor, lattice, size, .. } = *tile;
        let batch = cursor.batch;
        let list = self.standing.list.unwrap_or_default();
        match cursor.stage {
            _ if tile.pixels == 0 => {}
            // From the scene, through the aperture, to the tracing image.
            Stage::Trace => {
                let push = TracePush {
                    camera: Camera::new(estimator),
                    lattice,
                    seed: estimator.seed,
                    limits: limits(estimator),
                    first_sample: batch.first_sample,
                    sample_count: batch.sample_count,
                };
                passes.trace.pass.record(recording, &passes.trace.by_list[list], &push, size);
            }
            // From the tracing image to the film.
            Stage::Accumulate => {
                let push = AccumulatePush {
                    lattice,
                    seed: estimator.seed,
                    first_sample: batch.first_sample,
                    jitter: estimator.jitter,
                    reach: i32::try_from(reach(estimator.jitter)).unwrap_or(i32::MAX),
                };
                passes.accumulate.pass.record(recording, &passes.accumulate.by_list[list], &push, size);
            }
            // From the film to the list of active pixels.
            Stage::Select => {
                if cursor.at == [0, 0] {
                    recording.clear_buffer(images.adaptive.list(1 - list), AdaptiveBuffers::LIST_HEADER);
                    if self.standing.list.is_none() {
                        images.adaptive.record_brightest(recording, &Brightest::new(estimator));
                    }
                }
                let [cell, ..] = Brightest::grid(estimator.size);
                let push = SelectPush { lattice, threshold: estimator.noise_threshold, cell };
                if let Some(select) = &passes.select {
                    select.pass.record(recording, &select.by_list[list], &push, size);
                }
            }
        }
        if tile.next.is_none() {
            recording.barrier();
        }
        self.advance(tile);
    }

    /// Records the resolve pass, if the picture is not up to date.
    pub fn record_resolve(&mut self, recording: &mut Recording<'_>) {
        self.record_resolve_as(recording, self.blue_first);
    }

    pub(super) fn record_resolve_as(&mut self, recording: &mut Recording<'_>, blue_first: bool) {
        self.record_clear(recording, true);
        self.record_surfaces(recording);
        let resolve = &self.loaded.passes.resolve;
        let (bindings, preview_stride) = match self.standing.samples {
            0 => (&resolve.preview, self.standing.filled_stride),
            _ => (&resolve.film, 1),
        };
        let push = ResolvePush {
            extent: self.settings.estimator.size,
            preview_stride,
            exposure: self.settings.exposure(),
            overlay: OverlayScale::new(&self.settings),
            blue_first: blue_first.into(),
        };
        let has_holes = reach(self.settings.estimator.jitter) > 0 || self.tally.saw_rejected_samples();
        if self.standing.resolved == Some((push, has_holes)) {
            return;
        }
        let pass = match &resolve.overlay {
            Some(overlay) => overlay,
            None if has_holes => &resolve.with_holes,
            None => &resolve.without_holes,
        };
        recording.barrier();
        pass.record(recording, bindings, &push);
        recording.barrier();
        self.standing.resolved = Some((push, has_holes));
    }

    /// Records the geometry pass, if an overlay needs it and the surface image is not up to date.
    fn record_surfaces(&mut self, recording: &mut Recording<'_>) {
        let Loaded { passes, surfaces, .. } = &mut self.loaded;
        let estimator = &self.settings.estimator;
        surfaces.record_layout(recording);
        if let Some((geometry, bindings)) = &passes.geometry
            && surfaces.goes_to(Seen::new(estimator))
        {
            recording.barrier();
            geometry.record(recording, bindings, GeometryPush::new(estimator));
            recording.barrier();
        }
    }

    /// Records the upload of the shape of the aperture.
    pub(super) fn record_aperture(&self, recording: &mut Recording<'_>) {
        let shape = ApertureBuffer::new(&self.settings.estimator);
        self.loaded.prepared.aperture.record(recording, &shape);
    }

    pub(super) fn record_clear(&mut self, recording: &mut Recording<'_>, traced: bool) {
        if std::mem::take(&mut self.standing.needs_clear) {
            self.loaded.images.record_clear(recording, traced);
        }
    }
}
