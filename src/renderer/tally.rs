//! What was counted and measured on the device.

use crate::error::Result;
use crate::gpu_types::Counters;
use crate::passes::Adaptive;
use crate::vulkan::{Buffer, Device, FRAMES_IN_FLIGHT, Recording, Residence, Timer};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What a unit of work takes is assumed until a submission was measured: slow enough for a software device, in a
/// scene without a tree and in one with it.
const UNMEASURED_NANOSECONDS: [f64; 2] = [50.0, 400.0];

/// How many of the last submissions say how fast the device is: one that met little says nothing of the next.
const MEASUREMENTS: usize = 4;

/// How far a picture is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Progress {
    /// Samples per pixel in the film, from whole passes.
    pub samples: u32,
    /// Samples traced for this picture, over all pixels.
    pub traced: u64,
    /// Rays traced for them, shadow rays among them.
    pub rays: u64,
    /// Samples that were not finite, and so not averaged in.
    pub rejected_samples: u64,
    /// How long the device worked on them.
    pub device_time: Duration,
    /// The longest that it worked on one submission.
    pub longest_submission: Duration,
    /// How many pixels are still traced, at most: of an adaptive picture, once some have stopped.
    pub active_pixels: Option<u64>,
}

/// What a submission does.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Work {
    /// Samples it traces, but for those of listed pixels.
    pub(super) samples: u64,
    /// What it costs, all told, in samples traced.
    pub(super) cost: u64,
}

/// Counters and clocks of the frames in flight, and their sums.
pub(super) struct Tally {
    frames: Vec<Frame>,
    sum: Progress,
    /// What a unit of work took in the last submissions, the last one first.
    nanoseconds_per_unit: Vec<f64>,
    /// See [`UNMEASURED_NANOSECONDS`].
    unmeasured: f64,
    /// Told apart by number, so that frames in flight do not count for a later picture.
    picture: u64,
    /// Whether a sample of this scene was rejected, in any picture.
    saw_rejected_samples: bool,
}

struct Frame {
    timer: Timer,
    counters: Buffer,
    /// The number of active pixels.
    active: Buffer,
    pending: Option<Pending>,
}

/// A submission under way.
struct Pending {
    picture: u64,
    work: Work,
    started: Instant,
    /// Whether it lists the active pixels anew.
    lists: bool,
}

impl Tally {
    pub(super) fn new(device: &Arc<Device>) -> Result<Self> {
        let frame = || {
            Ok(Frame {
                timer: Timer::new(device)?,
                counters: Buffer::new(
                    device,
                    "counters read-back",
                    size_of::<Counters>() as u64,
                    Residence::Staging,
                )?,
                active: Buffer::new(
                    device,
                    "active pixels read-back",
                    Adaptive::LIST_HEADER,
                    Residence::Staging,
                )?,
                pending: None,
            })
        };
        Ok(Self {
            frames: (0..FRAMES_IN_FLIGHT).map(|_| frame()).collect::<Result<_>>()?,
            sum: Progress::default(),
            nanoseconds_per_unit: Vec::new(),
            unmeasured: UNMEASURED_NANOSECONDS[0],
            picture: 0,
            saw_rejected_samples: false,
        })
    }

    pub(super) fn restart(&mut self) {
        self.sum = Progress::default();
        self.picture += 1;
    }

    /// Another scene: what was measured says nothing of it.
    pub(super) fn forget_scene(&mut self, has_tree: bool) {
        self.nanoseconds_per_unit.clear();
        self.unmeasured = UNMEASURED_NANOSECONDS[usize::from(has_tree)];
        self.saw_rejected_samples = false;
    }

    /// How much the device can do in this time, in samples traced, by the worst of the last measurements.
    pub(super) fn work_within(&self, budget: Duration) -> u64 {
        let worst = self.nanoseconds_per_unit.iter().copied().reduce(f64::max);
        (budget.as_nanos() as f64 / worst.unwrap_or(self.unmeasured)) as u64
    }

    pub(super) fn start(&self, recording: &mut Recording<'_>, frame: usize) {
        recording.start(&self.frames[frame].timer);
    }

    /// `list`: of the active pixels, if the submission has made it.
    pub(super) fn stop(
        &mut self,
        recording: &mut Recording<'_>,
        frame: usize,
        work: Work,
        counters: &Buffer,
        list: Option<&Buffer>,
    ) {
        let frame = &mut self.frames[frame];
        recording.stop(&frame.timer);
        recording.barrier();
        recording.copy_buffer(counters, &frame.counters, size_of::<Counters>() as u64);
        if let Some(list) = list {
            recording.copy_buffer(list, &frame.active, Adaptive::LIST_HEADER);
        }
        frame.pending =
            Some(Pending { picture: self.picture, work, started: Instant::now(), lists: list.is_some() });
    }

    pub(super) fn collect(&mut self, frame: usize) -> Result<()> {
        let frame = &mut self.frames[frame];
        let Some(Pending { picture, work, started, lists }) = frame.pending.take() else {
            return Ok(());
        };
        // Without a clock on the queue, the host's has to do.
        let elapsed = frame.timer.elapsed()?.unwrap_or_else(|| started.elapsed());
        if work.cost > 0 {
            // A clock that reads too little must not lead to a dispatch of seconds.
            let least = self.nanoseconds_per_unit.first().unwrap_or(&self.unmeasured) / 8.0;
            let measured = elapsed.as_nanos() as f64 / work.cost as f64;
            self.nanoseconds_per_unit.insert(0, measured.max(least));
            self.nanoseconds_per_unit.truncate(MEASUREMENTS);
        }
        let counters = Counters::from_bytes(frame.counters.bytes());
        self.saw_rejected_samples |= counters.rejected_samples > 0;
        if picture == self.picture {
            self.sum.traced += work.samples + u64::from(counters.listed_samples);
            self.sum.rays += u64::from(counters.rays);
            self.sum.rejected_samples += u64::from(counters.rejected_samples);
            self.sum.device_time += elapsed;
            self.sum.longest_submission = self.sum.longest_submission.max(elapsed);
            if lists {
                let count = bytemuck::pod_read_unaligned::<u32>(&frame.active.bytes()[..4]);
                self.sum.active_pixels = Some(count.into());
            }
        }
        Ok(())
    }

    /// Whether pixels can have fewer samples than were traced for them.
    pub(super) fn saw_rejected_samples(&self) -> bool {
        self.saw_rejected_samples
    }

    pub(super) fn progress(&self, samples: u32) -> Progress {
        Progress { samples, ..self.sum }
    }
}
