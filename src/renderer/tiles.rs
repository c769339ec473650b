//! Chooses the next tile to record, and what comes after it.

use super::Renderer;
use super::schedule::{self, Batch, Cursor, Stage, reach};
use super::tally::Work;
use crate::gpu_types::Lattice;
use crate::interface::GROUP_SIZE;
use crate::settings::Estimator;

/// The cost of the select pass for a pixel, which reads nine texels. The unit is the cost of tracing a sample.
const SELECT_COST: f64 = 1.0;

/// The part of a stage of a batch that one dispatch does.
pub(super) struct Tile {
    pub(super) cursor: Cursor,
    /// The pixels of the tile.
    pub(super) lattice: Lattice,
    /// Columns and rows of invocations.
    pub(super) size: [u32; 2],
    pub(super) pixels: u64,
    pub(super) work: Work,
    /// Where the next tile of the stage starts, if there is one.
    pub(super) next: Option<[u32; 2]>,
}

impl Renderer {
    pub(super) fn nothing_to_show(&self) -> bool {
        self.standing.samples == 0 && self.standing.cursor.is_none_or(Cursor::is_first_lattice)
    }

    /// The position in the current batch, or the start of the next batch.
    pub(super) fn next_cursor(&self, left: u64, preview: bool) -> Cursor {
        self.standing.cursor.unwrap_or_else(|| Cursor::start(self.next_batch(left, preview)))
    }

    /// The tile that starts at a cursor, with about `left` units of work, or with the whole rest of the stage if
    /// `whole`.
    pub(super) fn tile(&self, cursor: Cursor, left: u64, whole: bool) -> Tile {
        let estimator = &self.settings.estimator;
        let Cursor { batch, stage, at } = cursor;
        let cost = match stage {
            Stage::Trace => f64::from(batch.sample_count),
            Stage::Accumulate => accumulate_cost(estimator.jitter),
            Stage::Select => SELECT_COST,
        };
        let of_stage = if stage == Stage::Trace { batch } else { Batch::interleaved(1) };
        let of_picture = of_stage.lattice(estimator.size);
        let [width, height] = of_stage.lattice_size(estimator.size);
        let is_listed = self.standing.list.is_some();
        let area = if is_listed {
            schedule::listed_size(self.max_active_pixels(estimator))
        } else {
            // The area has whole rows of workgroups, because the last row of the picture is not visited last.
            [width, height.next_multiple_of(GROUP_SIZE)]
        };
        let size = if whole { area } else { schedule::tile(area, at, (left as f64 / cost) as u64) };
        let (lattice, rows) = if is_listed {
            (schedule::listed_lattice(estimator.size, at), size[1])
        } else {
            (of_picture.from_tile(at), schedule::rows_of_pixels(&of_picture, height, at[1], size[1]))
        };
        let pixels = u64::from(size[0]) * u64::from(rows);
        // The device itself counts the samples of listed pixels.
        let counted = stage == Stage::Trace && !is_listed;
        let work = Work {
            samples: if counted { pixels * u64::from(batch.sample_count) } else { 0 },
            cost: (pixels as f64 * cost).ceil() as u64,
        };
        Tile { cursor, lattice, size, pixels, work, next: schedule::after_tile(area, at, size) }
    }

    /// Moves to what follows a tile that was recorded.
    pub(super) fn advance(&mut self, tile: &Tile) {
        let Cursor { batch, stage, .. } = tile.cursor;
        let standing = &mut self.standing;
        if let Some(at) = tile.next {
            standing.cursor = Some(Cursor { at, ..tile.cursor });
            return;
        }
        standing.resolved = None;
        standing.cursor = match stage {
            Stage::Trace => {
                standing.filled_stride = batch.filled_stride();
                Some(tile.cursor.after_tracing())
            }
            Stage::Accumulate => {
                standing.samples = batch.end();
                let selects = self.settings.estimator.is_adaptive() && schedule::selects_at(batch.end());
                selects.then(|| tile.cursor.stage(Stage::Select))
            }
            Stage::Select => {
                standing.list = Some(1 - standing.list.unwrap_or_default());
                None
            }
        };
    }

    fn next_batch(&self, left: u64, preview: bool) -> Batch {
        let estimator = &self.settings.estimator;
        let [width, height] = estimator.size.map(u64::from);
        if preview && self.standing.samples == 0 {
            return match width * height {
                // In a cell of 4 x 4 pixels, the pixel that is traced first is the third one on both axes.
                pixels if pixels / 4 > left && width.min(height) > 2 => Batch::interleaved(4),
                pixels if pixels > left => Batch::interleaved(2),
                _ => Batch::interleaved(1),
            };
        }
        // A sample that lands in a neighbouring pixel is found by its index, so there is one sample in a batch.
        let largest = if reach(estimator.jitter) > 0 { 1 } else { self.largest_batch };
        let usual = if estimator.is_adaptive() {
            self.usual_batch.min(schedule::SELECT_EVERY)
        } else {
            self.usual_batch
        };
        Batch::whole(self.standing.samples, self.settings.samples, usual.min(largest), largest)
    }

    /// The largest possible number of pixels that are still traced.
    fn max_active_pixels(&self, estimator: &Estimator) -> u64 {
        let [width, height] = estimator.size.map(u64::from);
        self.progress().active_pixels.unwrap_or(width * height)
    }
}

/// The cost of accumulating a pixel: about an eighth of that of tracing a sample, for each texel that is read.
fn accumulate_cost(jitter: f32) -> f64 {
    let across = f64::from(2 * reach(jitter) + 1);
    across * across / 8.0
}
