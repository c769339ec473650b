//! Measures a device: how many samples and rays a second, how soon there is a picture, how long a
//! submission keeps the device busy, and how the error falls with samples and with seconds.
//!
//! Everything is measured several times after a warm-up, and given as a median with quartiles and extremes. Rates are
//! given by wall-clock time, and by the device's own clock.

mod convergence;
mod measure;
mod report;
mod statistics;

pub use convergence::{ERROR_SAMPLES, rmse};
pub use report::{Change, Convergence, Report, SceneReport, Submissions};
pub use statistics::Spread;

use crate::error::{Error, Result};
use crate::output::say;
use crate::pending_file::{PendingFile, keep_apart};
use crate::renderer::Renderer;
use crate::settings::{DeviceChoice, Sampler, Settings};
use crate::vulkan::{Device, Instance};
use std::path::{Path, PathBuf};

/// The largest number of runs.
pub const MAX_RUNS: u32 = 1000;

/// What to measure.
#[derive(Debug, Clone)]
pub struct Job {
    /// A picture of each scene; throughput is measured at its size and number of samples.
    pub pictures: Vec<Settings>,
    /// How often everything is measured.
    pub runs: u32,
    /// On which device.
    pub device: DeviceChoice,
    /// The file that the figures go to as JSON, if any; `-` for standard output, in place of the table.
    pub json: Option<PathBuf>,
}

/// The noise threshold of the adaptive variant: the error of about 150 samples a pixel in the default scene.
const NOISE_THRESHOLD: f32 = 0.05;

/// A way to render that is compared with the others: what it changes of the settings.
pub(crate) struct Variant {
    name: String,
    change: Box<dyn Fn(&mut Settings)>,
}

/// The ways to compare.
fn variants() -> Vec<Variant> {
    let of_sampler = |(name, sampler): (&str, Sampler)| {
        let change = move |settings: &mut Settings| settings.estimator.sampler = sampler;
        Variant { name: name.into(), change: Box::new(change) }
    };
    let adaptive = |settings: &mut Settings| settings.estimator.noise_threshold = NOISE_THRESHOLD;
    let adaptive = Variant { name: "adaptive".into(), change: Box::new(adaptive) };
    Sampler::NAMES.into_iter().map(of_sampler).chain([adaptive]).collect()
}

/// Measures, and prints or writes the figures.
///
/// # Errors
/// Those of loading and rendering, and [`Error::Validation`] if the layer had something to say.
pub fn run(job: &Job) -> Result<()> {
    if !(1..=MAX_RUNS).contains(&job.runs) {
        return Err(Error::OutOfRange(format!("runs is {}, but must be from 1 to {MAX_RUNS}", job.runs)));
    }
    let table = job.json.as_deref() != Some(Path::new("-"));
    let output = job.json.as_deref().filter(|_| table);
    for picture in &job.pictures {
        keep_apart(output.map(|path| ("--json", path)).as_slice(), &picture.files())?;
    }
    let file = output.map(PendingFile::create).transpose()?;
    let instance = Instance::new(job.device.validation, None)?;
    let device = Device::open(&instance, job.device.device.as_deref(), None)?;
    device.keep_pipelines();
    let mut report = Report::new(device.info(), job.runs);
    if table {
        say(&report.heading())?;
    }
    let variants = variants();
    for picture in &job.pictures {
        eprintln!("measuring {} ...", picture.estimator.scene.name);
        let mut renderer = Renderer::new(&device, picture)?;
        let scene = measure::scene(&mut renderer, picture, &variants, job)?;
        if table {
            say(&scene.table())?;
        }
        report.scenes.push(scene);
    }
    match file {
        Some(file) => file.write(report.json().as_bytes())?,
        None if !table => say(report.json().trim_end())?,
        None => {}
    }
    drop(device);
    instance.check_validation()
}
