//! Measuring one scene.

use super::convergence::{self, REFERENCE_SAMPLES};
use super::report::{Change, SceneReport, Submissions, VariantReport};
use super::{Job, MAX_RUNS, Spread, Variant};
use crate::error::Result;
use crate::renderer::Renderer;
use crate::settings::{DeviceChoice, Settings};
use crate::vulkan::{Device, Instance};
use std::time::{Duration, Instant};

/// The error is measured on pictures no larger than this, for the reference picture takes more time than all else.
const ERROR_SIZE: [u32; 2] = [320, 240];

/// All figures of a scene.
pub(super) fn scene(
    renderer: &mut Renderer,
    picture: &Settings,
    variants: &[Variant],
    job: &Job,
) -> Result<SceneReport> {
    let mut small = picture.clone();
    small.estimator.size = [0, 1].map(|axis| picture.estimator.size[axis].min(ERROR_SIZE[axis]));
    let reference = convergence::reference(renderer, &small)?;
    let figures = |variant: &Variant| {
        let of = |settings: &Settings| {
            let mut settings = settings.clone();
            (variant.change)(&mut settings);
            settings
        };
        let mut report = throughput(renderer, &of(picture), job.runs)?;
        report.variant.clone_from(&variant.name);
        report.convergence = convergence::converge(renderer, &of(&small), &reference, job.runs)?;
        Ok(report)
    };
    Ok(SceneReport {
        scene: picture.estimator.scene.name.clone(),
        size: picture.estimator.size,
        samples: picture.samples,
        variants: variants.iter().map(figures).collect::<Result<_>>()?,
        first_picture: Change {
            from_start: Spread::of(&from_start(picture, &job.device, job.runs)?),
            from_change: Spread::of(&from_change(renderer, picture, job.runs)?),
        },
        error_size: small.estimator.size,
        reference_samples: REFERENCE_SAMPLES,
    })
}

/// Whole pictures, one after another, each with a seed of its own.
fn throughput(renderer: &mut Renderer, picture: &Settings, runs: u32) -> Result<VariantReport> {
    let (mut samples, mut device_samples, mut rays) = (Vec::new(), Vec::new(), Vec::new());
    let mut submissions = Vec::new();
    let mut settings = picture.clone();
    for run in 0..=runs {
        settings.estimator.seed = run;
        renderer.set(&settings)?;
        let (mut before, mut times) = (Duration::ZERO, Vec::new());
        let started = Instant::now();
        renderer.render(|progress| {
            times.push((progress.device_time - before).as_secs_f64());
            before = progress.device_time;
        })?;
        let seconds = started.elapsed().as_secs_f64();
        // The first picture is a warm-up: drivers compile late, and the size of submissions has not settled.
        if run > 0 {
            let progress = renderer.progress();
            samples.push(progress.traced as f64 / seconds / 1e6);
            device_samples.push(progress.traced as f64 / progress.device_time.as_secs_f64() / 1e6);
            rays.push(progress.rays as f64 / seconds / 1e6);
            submissions.append(&mut times);
        }
    }
    Ok(VariantReport {
        variant: String::new(),
        msamples_per_second: Spread::of(&samples),
        msamples_per_device_second: Spread::of(&device_samples),
        mrays_per_second: Spread::of(&rays),
        submissions: Submissions { count: submissions.len(), device_seconds: Spread::of(&submissions) },
        convergence: Vec::new(),
    })
}

/// A picture of one sample per pixel, resolved and read back, and how long it took.
fn first_picture(renderer: &mut Renderer, picture: &Settings, started: Instant) -> Result<f64> {
    let mut settings = picture.clone();
    settings.samples = 1;
    renderer.set(&settings)?;
    renderer.render(|_| ())?;
    renderer.read_picture()?;
    Ok(started.elapsed().as_secs_f64())
}

/// The times to a first picture from the start: no instance, no device and no pipelines yet.
fn from_start(picture: &Settings, choice: &DeviceChoice, runs: u32) -> Result<Vec<f64>> {
    let time = |_| {
        let started = Instant::now();
        let instance = Instance::new(choice.validation, None)?;
        let device = Device::open(&instance, choice.device.as_deref(), None)?;
        device.keep_pipelines();
        let mut renderer = Renderer::new(&device, picture)?;
        let seconds = first_picture(&mut renderer, picture, started)?;
        drop((renderer, device));
        instance.check_validation()?;
        Ok(seconds)
    };
    let times = (0..=runs).map(time).collect::<Result<Vec<_>>>()?;
    Ok(times[1..].to_vec())
}

/// The times to a first picture after a change of the focal distance.
fn from_change(renderer: &mut Renderer, picture: &Settings, runs: u32) -> Result<Vec<f64>> {
    let mut settings = picture.clone();
    let mut time = |run: u32| {
        let distance = picture.estimator.lens.focal_distance;
        settings.estimator.lens.focal_distance = distance * (1.0 - 1e-3 * (run + 1) as f32 / MAX_RUNS as f32);
        first_picture(renderer, &settings, Instant::now())
    };
    let times = (0..=runs).map(&mut time).collect::<Result<Vec<_>>>()?;
    Ok(times[1..].to_vec())
}
