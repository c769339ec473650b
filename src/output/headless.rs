//! Renders settings to a file.

use super::progress::ProgressDisplay;
use super::{PictureFormat, Stats, say, write_picture};
use crate::error::{Error, Result};
use crate::pending_file::{PendingFile, keep_apart};
use crate::renderer::{Question, Renderer};
use crate::settings::{DeviceChoice, Focusing, Place, Settings, quoted};
use crate::vulkan::{Device, Instance};
use std::path::PathBuf;
use std::sync::Arc;

/// A picture to render to a file.
#[derive(Debug, Clone)]
pub struct Job {
    /// What to render.
    pub settings: Settings,
    /// The picture that the settings are from, if they are from one.
    pub from: Option<PathBuf>,
    /// What the lens follows from, in place of the lens of the settings.
    pub focusing: Option<Focusing>,
    /// The file: `.png` for 8-bit sRGB, `.exr` for linear values and counts.
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
/// Those of rendering and of writing, and [`Error::Validation`] if the layer had something to say.
pub fn render(job: &Job) -> Result<()> {
    let format = PictureFormat::of(&job.output).ok_or_else(|| Error::UnknownFormat(job.output.clone()))?;
    let files = job.settings.files();
    let mut outputs = vec![("--output", job.output.as_path())];
    outputs.extend(job.stats.as_deref().map(|stats| ("--stats", stats)));
    keep_apart(&outputs, &files)?;
    // The picture that the settings are from may be written anew, but the figures may not replace it.
    let from = job.from.as_deref().map(|from| ("the picture of --from", from));
    keep_apart(&outputs[1..], from.as_slice())?;
    let instance = Instance::new(job.device.validation, None)?;
    // An error of rendering came first, so it is the better reason.
    render_on(&instance, job, format)?;
    instance.check_validation()
}

/// With no display: renders the scene to `thinlens.png` instead, and says so.
///
/// # Errors
/// As [`render`].
pub fn render_instead(settings: Settings, device: DeviceChoice, why: &str) -> Result<()> {
    eprintln!("no display for the viewer ({why}); rendering the scene to a file instead");
    let output = std::env::current_dir().unwrap_or_default().join("thinlens.png");
    let scene = settings.arguments().swap_remove(0);
    let job = Job {
        settings,
        from: None,
        focusing: None,
        output: output.clone(),
        stats: None,
        device,
        quiet: false,
    };
    render(&job)?;
    say(&format!("the picture is {}", output.display()))?;
    let program = std::env::args_os().next().unwrap_or_else(|| "thinlens".into());
    let [program, scene] = [program, scene].map(|word| quoted(&word));
    say(&format!("next, try: {program} render {scene} --lens-diameter 0 -o pinhole.png"))
}

/// Where a place of the picture is, in pixels from the upper left corner. `what` is what is there.
pub(super) fn position(what: &str, settings: &Settings, place: Place) -> Result<[f32; 2]> {
    let [width, height] = settings.estimator.size.map(|extent| extent as f32);
    let [x, y] = match place {
        Place::Centre => [0.5 * width, 0.5 * height],
        Place::At(position) => position,
    };
    if !(0.0..width).contains(&x) || !(0.0..height).contains(&y) {
        return Err(Error::OutOfRange(format!(
            "{what} is at {x},{y}, but must be within the picture's {width}x{height} pixels"
        )));
    }
    Ok([x, y])
}

/// The settings with the lens that was asked for.
fn focus(renderer: &mut Renderer, settings: &Settings, focusing: Focusing) -> Result<Settings> {
    settings.focused(focusing, |place| {
        let position @ [x, y] = position("the place to focus on", settings, place)?;
        match renderer.pick(Question::at(position))?.and_then(|picked| picked.surface) {
            Some(surface) if matches!(focusing, Focusing::On(_)) => surface.focal_distance.ok_or_else(|| {
                Error::NoLens(format!(
                    "no focal distance makes the picture of this tilted lens sharp at {x},{y}; tilt the lens less, or \
                     focus on another place"
                ))
            }),
            Some(surface) => Ok(surface.depth),
            None if matches!(focusing, Focusing::On(_)) => Err(Error::NothingToFocusOn { x, y }),
            None => Ok(f64::INFINITY),
        }
    })
}

fn render_on(instance: &Arc<Instance>, job: &Job, format: PictureFormat) -> Result<()> {
    let output = PendingFile::create(&job.output)?;
    let stats_output = job.stats.as_deref().map(PendingFile::create).transpose()?;
    let device = Device::open(instance, job.device.device.as_deref(), None)?;
    device.keep_pipelines();
    let [width, height] = job.settings.estimator.size;
    let mut renderer = Renderer::new(&device, &job.settings)?;
    let mut settings = job.settings.clone();
    if let Some(focusing) = job.focusing {
        settings = focus(&mut renderer, &settings, focusing)?;
        renderer.set(&settings)?;
    }
    if let Some(warning) = settings.estimator.too_coarse() {
        log::warn!("{warning}");
    }

    let pixels = u64::from(width) * u64::from(height);
    let mut display = ProgressDisplay::new(settings.samples, pixels, job.quiet);
    renderer.render(|progress| display.show(progress.samples, progress.traced))?;
    let seconds = display.finish().as_secs_f64();

    write_picture(&mut renderer, &settings, format, output)?;
    let progress = renderer.progress();
    let stats = Stats {
        scene: settings.estimator.scene.name.clone(),
        width,
        height,
        lens_diameter: settings.estimator.lens.diameter,
        focal_distance: settings.estimator.lens.focal_distance,
        samples_per_pixel: progress.samples,
        mean_samples_per_pixel: progress.traced as f64 / pixels as f64,
        samples: progress.traced,
        rays: progress.rays,
        rejected_samples: progress.rejected_samples,
        seconds,
        msamples_per_second: progress.traced as f64 / seconds / 1e6,
        longest_submission_seconds: progress.longest_submission.as_secs_f64(),
        device: device.info().name.clone(),
        driver: device.info().driver.clone(),
    };
    if let Some(file) = stats_output {
        stats.write(file)?;
    }
    if stats.rejected_samples > 0 {
        eprintln!(
            "thinlens: {} of {} samples are left out, for their light was not finite or their ray took more than \
             1024 steps through the scene; look there for huge values, and for many things at one place",
            stats.rejected_samples, stats.samples
        );
    }
    if !job.quiet {
        let samples = if settings.estimator.is_adaptive() {
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
