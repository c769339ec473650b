//! The order in which the samples of the pixels are traced. It is computed without a device and without a clock.
//!
//! A batch is a range of samples of every pixel of a lattice. Batches are cut at fixed sample indices, so that the same
//! samples are averaged in the same groups however the work is divided into tiles.

use crate::gpu_types::Lattice;
use crate::interface::{GROUP_SIZE, LISTED_ROW_GROUPS, PREVIEW_SITE, PREVIEW_STRIDE};

/// Samples per pixel in a batch, after the first batches of a picture.
pub const USUAL_BATCH: u32 = 64;

/// A batch is at least this part of the samples that a pixel has. If the film had many more samples than a batch, a
/// batch would change its mean by less than an f32 can tell, and rounding would decide where the mean goes.
const LEAST_PART: u32 = 1024;

/// No batch grows beyond this many samples, so that a row of workgroups stays a short submission.
pub const LARGEST_BATCH: u32 = 4096;

/// Where the first batches end. The first ones are short so that there is something to see soon. Later ones are longer,
/// because every batch has a fixed cost.
const FIRST_CUTS: [u32; 5] = [1, 4, 16, 32, USUAL_BATCH];

/// In an adaptive picture, active pixels are selected each time after this many samples per pixel, but for the first
/// time after twice as many: fewer samples could all miss a small feature.
pub const SELECT_EVERY: u32 = 16;

/// Whether active pixels are selected after this many samples.
pub fn selects_at(samples: u32) -> bool {
    samples >= 2 * SELECT_EVERY && samples.is_multiple_of(SELECT_EVERY)
}

/// The number of listed pixels in a row of invocations, when the list of active pixels is traced.
const LISTED_ROW: u32 = LISTED_ROW_GROUPS * GROUP_SIZE;

/// The columns and rows of invocations that trace a list of this many active pixels.
pub fn listed_size(pixels: u64) -> [u32; 2] {
    let rows = pixels.div_ceil(u64::from(LISTED_ROW * GROUP_SIZE));
    [LISTED_ROW, u32::try_from(rows).unwrap_or(u32::MAX) * GROUP_SIZE]
}

/// The lattice of a dispatch over the list, from the tile's column and row on.
pub fn listed_lattice(size: [u32; 2], at: [u32; 2]) -> Lattice {
    let origin = [at[1] * LISTED_ROW + at[0] * GROUP_SIZE, 0];
    Lattice { extent: size, origin, stride: 0, first_row: 0, row_step: 1, row_count: 1 }
}

/// The largest batch, a power of two, whose loops take at most `most` steps, if each sample takes `steps`. `None` if
/// one sample takes too many already.
pub fn largest_batch(steps: u64, most: u64) -> Option<u32> {
    power_of_two_within(u32::try_from(most / (steps + 1)).ok()?).map(|batch| batch.min(LARGEST_BATCH))
}

/// The largest power of two that is not larger than the number.
fn power_of_two_within(number: u32) -> Option<u32> {
    number.checked_ilog2().map(|power| 1 << power)
}

/// The order in which the pixels of a cell of 4 x 4 pixels get their first sample in a preview. The first four are
/// every second pixel on both axes.
const PHASES_OF_16: [[u32; 2]; 16] = [
    [2, 2],
    [0, 0],
    [2, 0],
    [0, 2],
    [1, 1],
    [3, 3],
    [3, 1],
    [1, 3],
    [1, 0],
    [3, 2],
    [3, 0],
    [1, 2],
    [0, 1],
    [2, 3],
    [2, 1],
    [0, 3],
];
const _: () =
    assert!(PHASES_OF_16[0][0] == PREVIEW_SITE && PHASES_OF_16[0][1] == PREVIEW_SITE && PREVIEW_STRIDE == 4);
/// The order in which the pixels of a cell of 2 x 2 are traced.
const PHASES_OF_4: [[u32; 2]; 4] = [[0, 0], [1, 1], [1, 0], [0, 1]];

/// Samples `first_sample .. first_sample + sample_count` of every pixel of one lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Batch {
    /// Index of the first sample.
    pub first_sample: u32,
    /// The number of samples.
    pub sample_count: u32,
    /// The distance between neighbouring pixels of the lattice.
    pub stride: u32,
    /// The number of the lattice among the `stride * stride` ones, in their order.
    pub phase: u32,
}

/// The stages of a batch. Each is done tile by tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The batch is traced.
    Trace,
    /// The batch is merged into the film, if it was the last lattice of its samples.
    Accumulate,
    /// The active pixels are listed.
    Select,
}

/// A position in the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cursor {
    /// The current batch.
    pub batch: Batch,
    /// The current stage of the batch.
    pub stage: Stage,
    /// The column and row where the next tile starts: in the lattice while tracing, otherwise in the film. Once there
    /// is a list of active pixels, in the list (see [`listed_size`]).
    pub at: [u32; 2],
}

impl Cursor {
    /// The start of a batch.
    pub fn start(batch: Batch) -> Self {
        Self { batch, stage: Stage::Trace, at: [0, 0] }
    }

    /// The position after the batch is traced.
    pub fn after_tracing(self) -> Self {
        match self.batch.next_phase() {
            Some(next) => Self::start(next),
            None => self.stage(Stage::Accumulate),
        }
    }

    /// The start of another stage of the batch.
    pub fn stage(self, stage: Stage) -> Self {
        Self { stage, ..Self::start(self.batch) }
    }

    /// Whether the first lattice of the samples is still being traced.
    pub fn is_first_lattice(self) -> bool {
        self.batch.phase == 0 && self.stage == Stage::Trace
    }
}

impl Batch {
    /// The batch of every pixel that starts at `first_sample`. Batches end at 1, 4, 16, 32 and 64 samples, as far as
    /// `usual_batch`, then at every multiple of `usual_batch`, and at `target`. A picture of very many samples has larger
    /// batches, up to `largest`. Both are powers of two.
    pub fn whole(first_sample: u32, target: u32, usual_batch: u32, largest: u32) -> Self {
        let early = FIRST_CUTS.into_iter().find(|cut| *cut > first_sample && *cut <= usual_batch);
        let least = power_of_two_within(first_sample / LEAST_PART).unwrap_or(1);
        let step = least.clamp(usual_batch, largest);
        let cut = early.unwrap_or_else(|| (first_sample / step + 1).saturating_mul(step));
        Self { first_sample, sample_count: cut.min(target) - first_sample, stride: 1, phase: 0 }
    }

    /// The first sample of the first lattice with this stride (1, 2 or 4).
    pub fn interleaved(stride: u32) -> Self {
        Self { first_sample: 0, sample_count: 1, stride, phase: 0 }
    }

    /// The same samples of the next lattice, if there is one.
    pub fn next_phase(self) -> Option<Self> {
        let phase = self.phase + 1;
        (phase < self.stride * self.stride).then_some(Self { phase, ..self })
    }

    /// The number of samples in the film after this batch, if it is the last lattice.
    pub fn end(self) -> u32 {
        self.first_sample + self.sample_count
    }

    /// The stride of the finest lattice that is filled once this batch is traced. A preview can show this lattice.
    pub fn filled_stride(self) -> u32 {
        match (self.stride, self.phase) {
            (4, 0..3) => 4,
            (4, 3..15) => 2,
            (2, 0..3) => 2,
            _ => 1,
        }
    }

    /// The pixels of the lattice in a picture of this size.
    pub fn lattice(self, size: [u32; 2]) -> Lattice {
        let origin = match self.stride {
            4 => PHASES_OF_16[self.phase as usize],
            2 => PHASES_OF_4[self.phase as usize],
            _ => [0, 0],
        };
        let stride = self.stride;
        let row_count = size[1].saturating_sub(origin[1]).div_ceil(stride * GROUP_SIZE).max(1);
        Lattice { extent: size, origin, stride, first_row: 0, row_step: row_step(row_count), row_count }
    }

    /// The number of columns and rows of the lattice.
    pub fn lattice_size(self, size: [u32; 2]) -> [u32; 2] {
        let origin = self.lattice(size).origin;
        [0, 1].map(|axis| size[axis].saturating_sub(origin[axis]).div_ceil(self.stride))
    }
}

/// The step from one visited row of workgroups to the next, so that consecutive visits are spread over the whole
/// picture. It is about the golden section of the number of rows, and has no divisor in common with it.
fn row_step(count: u32) -> u32 {
    let near = (0.618_034 * f64::from(count)).round() as u32;
    let common_divisor = |mut a: u32, mut b: u32| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let around = (0..count).flat_map(|off| [near.saturating_sub(off), near + off]);
    around.into_iter().find(|step| *step > 0 && common_divisor(*step, count) == 1).unwrap_or(1)
}

/// The number of rows of pixels in a tile of `rows` rows that starts at the row `from` in the order of visits, in a
/// lattice with `height` rows. The last row of workgroups may have fewer rows of pixels, whenever it is visited.
pub fn rows_of_pixels(lattice: &Lattice, height: u32, from: u32, rows: u32) -> u32 {
    let visits = from / GROUP_SIZE..(from + rows).div_ceil(GROUP_SIZE).min(lattice.row_count);
    let missing = height.next_multiple_of(GROUP_SIZE) - height;
    let shorter = visits.clone().any(|visit| lattice.visited_row(visit) == lattice.row_count - 1);
    (visits.len() as u32 * GROUP_SIZE).saturating_sub(if shorter { missing } else { 0 })
}

/// The columns and rows of the tile that starts at `at`, in a lattice of `size`: as many whole rows as `pixels` allows,
/// or else a part of a row of workgroups. Tiles are cut at multiples of the size of a workgroup, and have at least one
/// workgroup.
pub fn tile(size: [u32; 2], at: [u32; 2], pixels: u64) -> [u32; 2] {
    let whole = |count: u64| u32::try_from(count).unwrap_or(u32::MAX) / GROUP_SIZE * GROUP_SIZE;
    let left = [0, 1].map(|axis| size[axis].saturating_sub(at[axis]));
    let rows = whole(pixels / u64::from(size[0].max(1)));
    if at[0] == 0 && rows > 0 {
        return [left[0], rows.min(left[1])];
    }
    let columns = whole(pixels / u64::from(GROUP_SIZE)).max(GROUP_SIZE);
    [columns.min(left[0]), GROUP_SIZE.min(left[1])]
}

/// Where the next tile starts, after one at `at` with `done` columns and rows. `None` if the lattice is done.
pub fn after_tile(size: [u32; 2], at: [u32; 2], done: [u32; 2]) -> Option<[u32; 2]> {
    let next = if at[0] + done[0] < size[0] { [at[0] + done[0], at[1]] } else { [0, at[1] + done[1]] };
    (done[1] > 0 && next[1] < size[1]).then_some(next)
}

/// The largest distance in pixels between the pixel of a sample and the pixel that it lands in.
pub fn reach(jitter: f32) -> u32 {
    // Jitter is checked to be small, so the cast is exact.
    (0.5 * jitter - 0.5).ceil().max(0.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    /// Catches a batch that straddles a cut: then 64 samples would not equal 32 and 32 more.
    #[test]
    fn batches_are_cut_at_fixed_sample_indices() {
        let cuts = |target, usual_batch| {
            let (mut cuts, mut at) = (Vec::new(), 0);
            while at < target {
                at = Batch::whole(at, target, usual_batch, LARGEST_BATCH).end();
                cuts.push(at);
            }
            cuts
        };
        assert_eq!(cuts(200, USUAL_BATCH), [1, 4, 16, 32, 64, 128, 192, 200]);
        assert_eq!(cuts(70, 16), [1, 4, 16, 32, 48, 64, 70]);
        assert_eq!(cuts(3, 16), [1, 3]);
        assert_eq!(cuts(9, 2), [1, 2, 4, 6, 8, 9]);
        assert_eq!(cuts(3, 1), [1, 2, 3]);
        // From a count that an earlier, lower target left behind.
        assert_eq!(Batch::whole(20, 64, 16, 64).end(), 32);
        assert_eq!(Batch::whole(70, 200, USUAL_BATCH, USUAL_BATCH).end(), 128);
    }

    /// Catches a batch that is too small a part of the film for an f32, or one that a device cannot trace.
    #[test]
    fn batches_grow_with_the_samples_of_a_pixel() {
        let end = |first, largest| Batch::whole(first, u32::MAX, USUAL_BATCH, largest).end() - first;
        assert_eq!(end(65_536, LARGEST_BATCH), 64);
        assert_eq!(end(131_072, LARGEST_BATCH), 128);
        assert_eq!(end(1_048_576, LARGEST_BATCH), 1024);
        assert_eq!(end(1_048_576, 256), 256);
        assert_eq!(end(1 << 30, LARGEST_BATCH), LARGEST_BATCH);
        assert_eq!(end(u32::MAX - 1, LARGEST_BATCH), 1);
        // From a count that is no multiple of the batch.
        assert_eq!(end(1_048_577, LARGEST_BATCH), 1023);
        // With jitter over several pixels, there is one sample in a batch.
        assert_eq!(Batch::whole(1_048_576, u32::MAX, 1, 1).end(), 1_048_577);
    }

    /// Catches a phase listed twice: one pixel would be sampled twice and another never.
    #[test]
    fn phases_cover_every_pixel_once() {
        for stride in [1, 2, 4] {
            for size in [[1, 1], [7, 5], [16, 16], [13, 2]] {
                let mut seen = HashSet::new();
                let mut next = Some(Batch::interleaved(stride));
                while let Some(batch) = next {
                    let (lattice, [columns, rows]) = (batch.lattice(size), batch.lattice_size(size));
                    for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
                        let pixel = [lattice.origin[0] + stride * x, lattice.origin[1] + stride * y];
                        assert!(pixel[0] < size[0] && pixel[1] < size[1]);
                        assert!(seen.insert(pixel), "{pixel:?} twice");
                    }
                    next = batch.next_phase();
                }
                assert_eq!(seen.len(), (size[0] * size[1]) as usize);
            }
        }
    }

    /// Catches a preview that looks for a lattice before it is filled, and shows black.
    #[test]
    fn a_filled_stride_is_filled() {
        for stride in [2, 4] {
            let mut seen = HashSet::new();
            let mut next = Some(Batch::interleaved(stride));
            while let Some(batch) = next {
                seen.insert(batch.lattice([8, 8]).origin);
                let filled = batch.filled_stride();
                let site = if filled == 4 { 2 } else { 0 };
                for (x, y) in (0..stride).flat_map(|y| (0..stride).map(move |x| (x, y))) {
                    let cell = |at: u32| (at / filled * filled + site) % stride;
                    assert!(filled == 1 || seen.contains(&[cell(x), cell(y)]), "{batch:?}");
                }
                next = batch.next_phase();
            }
        }
    }

    /// Catches tiles that overlap, leave gaps, or are larger than they may be.
    #[test]
    fn tiles_cover_a_lattice_once_and_keep_to_their_size() {
        for size in [[0, 0], [1, 1], [8, 8], [37, 51], [200, 17]] {
            for pixels in [0, 1, 64, 500, 1 << 40] {
                let mut seen = HashSet::new();
                let mut next = Some([0, 0]);
                while let Some(at) = next {
                    let [columns, rows] = tile(size, at, pixels);
                    assert!(u64::from(columns) * u64::from(rows) <= pixels.max(64));
                    for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
                        assert!(seen.insert([at[0] + x, at[1] + y]), "{at:?} of {size:?}");
                    }
                    next = after_tile(size, at, [columns, rows]);
                }
                assert_eq!(seen.len(), (size[0] * size[1]) as usize, "{size:?}, {pixels} pixels");
            }
        }
    }

    /// Catches a row of workgroups that is visited twice or never, runs of visits that leave out a part of the
    /// picture, and tiles whose pixels are counted wrong.
    #[test]
    fn rows_are_visited_once_and_everywhere() {
        for height in [1, 8, 9, 48, 63, 719, 720, 2160, 16384] {
            let lattice = Batch::interleaved(1).lattice([64, height]);
            let count = lattice.row_count;
            let visited: HashSet<_> = (0..count).map(|visit| lattice.visited_row(visit)).collect();
            assert_eq!(visited.len(), count as usize, "{height}");
            // Of a sixteenth of the visits, some are in each quarter of the picture.
            let run = count / 16;
            if run >= 8 {
                for from in [0, count / 2, count - run] {
                    let quarters: HashSet<_> =
                        (from..from + run).map(|visit| 4 * lattice.visited_row(visit) / count).collect();
                    assert_eq!(quarters.len(), 4, "{height}, from {from}");
                }
            }
            let padded = height.next_multiple_of(GROUP_SIZE);
            for rows in [8, 16, 40] {
                let tiles = (0..padded).step_by(rows as usize);
                let sum: u32 =
                    tiles.map(|from| rows_of_pixels(&lattice, height, from, rows.min(padded - from))).sum();
                assert_eq!(sum, height, "{height} in tiles of {rows}");
            }
        }
    }

    /// Catches a batch that lavapipe would cut short.
    #[test]
    fn batches_stay_within_the_loop_limit() {
        for steps in [1, 2, 413, 4000, 30_000, 65_534] {
            let batch = u64::from(largest_batch(steps, 65_535).expect("one sample fits"));
            assert!(batch * (steps + 1) <= 65_535);
            assert!(2 * batch * (steps + 1) > 65_535 || batch == u64::from(LARGEST_BATCH));
        }
        assert_eq!(largest_batch(65_535, 65_535), None);
    }

    /// Catches a reach that is one short: samples would vanish between pixels.
    #[test]
    fn reach_covers_the_jitter() {
        for (jitter, expected) in [(0.0, 0), (1.0, 0), (1.01, 1), (2.0, 1), (3.0, 1), (3.1, 2), (15.0, 7)] {
            assert_eq!(reach(jitter), expected, "jitter {jitter}");
        }
    }
}
