//! A sheet of pictures of one scene through several lenses.

use super::progress::ProgressDisplay;
use super::sheet::Sheet;
use super::{PictureFormat, say, write_png};
use crate::error::{Error, Result};
use crate::pending_file::{PendingFile, keep_apart};
use crate::renderer::Renderer;
use crate::settings::{DeviceChoice, Settings, Sweep};
use crate::vulkan::{Device, Instance};
use std::path::PathBuf;
use std::sync::Arc;

/// A sheet to render.
#[derive(Debug, Clone)]
pub struct SweepJob {
    /// The settings that its pictures have in common.
    pub settings: Settings,
    /// What differs from picture to picture.
    pub sweep: Sweep,
    /// Pictures in a row. If none is given, about as many as there are rows.
    pub columns: Option<u32>,
    /// The file, a `.png`.
    pub output: PathBuf,
    /// Where to render.
    pub device: DeviceChoice,
    /// Whether to say nothing unless it fails.
    pub quiet: bool,
}

/// Renders a sheet, and writes the file.
///
/// # Errors
/// Those of rendering and of writing, and [`Error::Validation`] if the layer had something to say.
pub fn sweep(job: &SweepJob) -> Result<()> {
    if PictureFormat::of(&job.output) != Some(PictureFormat::Png) {
        return Err(Error::OutOfRange(format!(
            "a sheet is a .png, for it has letters on it; {} is not",
            job.output.display()
        )));
    }
    keep_apart(&[("--output", &job.output)], &job.settings.files())?;
    let pictures = job.sweep.pictures(&job.settings)?;
    let sheet = Sheet::new(job.settings.estimator.size, pictures.len() as u32, job.columns)?;
    let instance = Instance::new(job.device.validation, None)?;
    // An error of rendering came first, so it is the better reason.
    sweep_on(&instance, job, &pictures, sheet)?;
    instance.check_validation()
}

fn sweep_on(instance: &Arc<Instance>, job: &SweepJob, pictures: &[Settings], mut sheet: Sheet) -> Result<()> {
    let output = PendingFile::create(&job.output)?;
    let device = Device::open(instance, job.device.device.as_deref(), None)?;
    device.keep_pipelines();
    let mut renderer = Renderer::new(&device, &pictures[0])?;
    let [width, height] = job.settings.estimator.size;
    let pixels = u64::from(width) * u64::from(height);
    let samples = job.settings.samples;
    let mut display = ProgressDisplay::new(samples * pictures.len() as u32, pixels, job.quiet);
    let mut traced = 0;
    for (index, picture) in pictures.iter().enumerate() {
        let index = index as u32;
        renderer.set(picture)?;
        renderer.render(|progress| {
            display.show(index * samples + progress.samples, traced + progress.traced);
        })?;
        traced += renderer.progress().traced;
        sheet.place(index, &renderer.read_picture()?, &job.sweep.labels(picture));
    }
    let seconds = display.finish().as_secs_f64();
    write_png(output, sheet.size(), sheet.rgba(), None)?;
    if job.quiet {
        return Ok(());
    }
    let [sheet_width, sheet_height] = sheet.size();
    say(&format!(
        "{}: {sheet_width}x{sheet_height}, {} pictures of {width}x{height}, {seconds:.2} s on {}",
        job.output.display(),
        pictures.len(),
        device.info().name,
    ))
}
