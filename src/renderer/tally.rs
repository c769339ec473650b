//! What the device counts and how long it takes.

use crate::error::Result;
use crate::gpu_types::Counters;
use crate::passes::AdaptiveBuffers;
use crate::vulkan::{Buffer, Device, FRAMES_IN_FLIGHT, Recording, Residence, Timer};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The assumed time of a unit of work until a submission has been measured, for scenes without and with a tree. It is
/// long enough for a software device.
const UNMEASURED_NANOSECONDS: [f64; 2] = [50.0, 400.0];

/// The speed of the device is the lowest of this many submissions: one submission may have covered an easy part of the
/// picture.
const MEASUREMENTS: usize = 4;

/// The progress of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Progress {
    /// Samples per pixel in the film. Only whole batches count.
    pub samples: u32,
    /// Samples traced for this picture, over all pixels.
    pub traced: u64,
    /// Rays traced for these samples, including shadow rays.
    pub rays: u64,
    /// Samples that were left out because they were not finite.
    pub rejected_samples: u64,
    /// How long the device worked on this picture.
    pub device_time: Duration,
    /// The longest time that the device worked on one submission.
    pub longest_submission: Duration,
    /// The largest possible number of active pixels, in an adaptive picture once they have been listed.
    pub active_pixels: Option<u64>,
}

/// The amount of work in a submission.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Work {
    /// The samples that it traces, without those of listed pixels.
    pub(super) samples: u64,
    /// The cost of everything in it. The unit is the cost of tracing a sample.
    pub(super) cost: u64,
}

/// Counters and clocks of the frames in flight, and their sums.
pub(super) struct Tally {
    frames: Vec<Frame>,
    sum: Progress,
    /// The time of a unit of work in each of the last submissions, the latest first.
    nanoseconds_per_unit: Vec<f64>,
    /// The assumed time of a unit of work: see [`UNMEASURED_NANOSECONDS`].
    unmeasured: f64,
    /// The number of the picture, so that frames in flight do not count for the next picture.
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

/// A submission that is not done yet.
struct Pending {
    picture: u64,
    work: Work,
    started: Instant,
    /// Whether it makes a new list of active pixels.
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
                    AdaptiveBuffers::LIST_HEADER,
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

    /// Forgets the measurements, because they do not apply to another scene.
    pub(super) fn forget_scene(&mut self, has_tree: bool) {
        self.nanoseconds_per_unit.clear();
        self.unmeasured = UNMEASURED_NANOSECONDS[usize::from(has_tree)];
        self.saw_rejected_samples = false;
    }

    /// The amount of work that the device can do in this time, by the slowest of the last measurements. The unit is the
    /// cost of tracing a sample.
    pub(super) fn work_within(&self, budget: Duration) -> u64 {
        let worst = self.nanoseconds_per_unit.iter().copied().reduce(f64::max);
        (budget.as_nanos() as f64 / worst.unwrap_or(self.unmeasured)) as u64
    }

    pub(super) fn start(&self, recording: &mut Recording<'_>, frame: usize) {
        recording.start(&self.frames[frame].timer);
    }

    /// Ends the measurement. `list` is the new list of active pixels, if the submission makes one.
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
            recording.copy_buffer(list, &frame.active, AdaptiveBuffers::LIST_HEADER);
        }
        frame.pending =
            Some(Pending { picture: self.picture, work, started: Instant::now(), lists: list.is_some() });
    }

    pub(super) fn collect(&mut self, frame: usize) -> Result<()> {
        let frame = &mut self.frames[frame];
        let Some(Pending { picture, work, started, lists }) = frame.pending.take() else {
            return Ok(());
        };
        // A queue without timestamps is measured with the clock of the host.
        let elapsed = frame.timer.elapsed()?.unwrap_or_else(|| started.elapsed());
        if work.cost > 0 {
            // If the measured time is far too short, the next dispatch must not take seconds.
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

    /// Whether some pixels may have fewer samples than were traced for them.
    pub(super) fn saw_rejected_samples(&self) -> bool {
        self.saw_rejected_samples
    }

    pub(super) fn progress(&self, samples: u32) -> Progress {
        Progress { samples, ..self.sum }
    }
}
