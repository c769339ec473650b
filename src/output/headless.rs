//! Renders settings to a file.

use super::progress::ProgressDisplay;
use super::{PictureFormat, Stats, say, write_exr, write_png};
use crate::error::{Error, Result};
use crate::pending_file::PendingFile;
use crate::renderer::Renderer;
use crate::settings::{DeviceChoice, Settings};
use crate::vulkan::{Device, Instance};
use std::path::PathBuf;
use std::sync::Arc;

/// A picture to render to a file.
#[derive(Debug, Clone)]
pub struct Job {
    /// What to render.
    pub settings: Settings,
    /// Where to: `.png` for 8-bit sRGB, `.exr` for linear values and counts.
    pub output: PathBuf,
    /// Where to write [`Stats`], if anywhere.
    pub stats: Option<PathBuf>,
    /// Where to render.
    pub device: DeviceChoice,
    /// Whether to say nothing unless it fails.
    pub quiet: bool,
}

/// Renders, and writes the file.
///
/// # Errors
/// Whatever keeps it from it; [`Error::Validation`] if the layer had something to say.
pub fn render(job: &Job) -> Result<()> {
    job.settings.check()?;
    let format = PictureFormat::of(&job.output).ok_or_else(|| Error::UnknownFormat(job.output.clone()))?;
    if job.stats.as_ref() == Some(&job.output) {
        return Err(Error::OutOfRange("--output and --stats name the same file; give each its own".into()));
    }
    let instance = Instance::new(job.device.validation, None)?;
    // What went wrong first is the better reason.
    render_on(&instance, job, format)?;
    instance.check_validation()
}

/// With no display: renders the scene to `thinlens.png` instead, and says so.
///
/// # Errors
/// As [`render`].
pub fn render_instead(settings: Settings, scene: &str, device: DeviceChoice, why: &str) -> Result<()> {
    eprintln!("no display for the viewer ({why}); rendering the scene to a file instead");
    let output = std::env::current_dir().unwrap_or_default().join("thinlens.png");
    render(&Job { settings, output: output.clone(), stats: None, device, quiet: false })?;
    say(&format!("the picture is {}", output.display()))?;
    let program = std::env::args().next().unwrap_or_else(|| "thinlens".into());
    say(&format!("next, try: {program} render {scene} --lens-diameter 0 -o pinhole.png"))
}

fn render_on(instance: &Arc<Instance>, job: &Job, format: PictureFormat) -> Result<()> {
    let output = PendingFile::create(&job.output)?;
    let stats_output = job.stats.as_deref().map(PendingFile::create).transpose()?;
    let device = Device::open(instance, job.device.device.as_deref(), None)?;
    device.keep_pipelines();
    let size @ [width, height] = job.settings.estimator.size;
    let mut renderer = Renderer::new(&device)?;
    renderer.set(&job.settings)?;

    let pixels = u64::from(width) * u64::from(height);
    let mut display = ProgressDisplay::new(job.settings.samples, pixels, job.quiet);
    renderer.render(|progress| display.show(progress.samples, progress.traced))?;
    let seconds = display.finish().as_secs_f64();

    match format {
        PictureFormat::Png => write_png(output, size, &renderer.read_picture()?)?,
        PictureFormat::Exr => write_exr(output, size, &renderer.read_film()?)?,
    }
    let progress = renderer.progress();
    let stats = Stats {
        scene: job.settings.estimator.scene.name.clone(),
        width,
        height,
        samples_per_pixel: progress.samples,
        mean_samples_per_pixel: progress.traced as f64 / pixels as f64,
        samples: progress.traced,
        rays: progress.rays,
        rejected_samples: progress.rejected_samples,
        seconds,
        msamples_per_second: progress.traced as f64 / seconds / 1e6,
        device: device.info().name.clone(),
        driver: device.info().driver.clone(),
    };
    if let Some(file) = stats_output {
        stats.write(file)?;
    }
    if stats.rejected_samples > 0 {
        eprintln!(
            "thinlens: {} of {} samples were not finite and are left out; look at the scene for huge values",
            stats.rejected_samples, stats.samples
        );
    }
    if !job.quiet {
        let samples = if job.settings.estimator.is_adaptive() {
            format!(
                "{:.1} samples per pixel, {} at most",
                stats.mean_samples_per_pixel, stats.samples_per_pixel
            )
        } else {
            format!("{} samples per pixel", stats.samples_per_pixel)
        };
        say(&format!(
            "{}: {width}x{height}, {samples}, {seconds:.2} s, {:.1} M samples/s on {}",
            job.output.display(),
            stats.msamples_per_second,
            stats.device,
        ))?;
    }
    Ok(())
}
