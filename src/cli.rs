//! The command line, as values. Nothing is rendered here.

use crate::error::Result;
use crate::scene::{self, BUILTINS, SceneRef};
use crate::settings::{DEFAULT_SAMPLES, DeviceChoice, Overlay, Sampler, Settings};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Samples per pixel that the viewer goes for, unless another number is asked for.
const DEFAULT_VIEW_SAMPLES: u32 = 256;

/// Pictures that a device is verified with: the oracle has to render them too.
const PROOF_SIZE: [u32; 2] = [128, 96];
const PROOF_SAMPLES: u32 = 16;

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "thinlens",
    version,
    about = "Renders scenes through a thin lens, so that what lies off the focal plane is blurred",
    after_help = "Try:\n  \
        thinlens                                       the viewer, with sliders for the lens\n  \
        thinlens render -o picture.png                 the default scene to a file\n  \
        thinlens render -o sharp.png --lens-diameter 0 the same through a pinhole\n  \
        thinlens render suffern-boxes -o boxes.exr     linear values and sample counts\n  \
        thinlens render bunny.obj -o bunny.png         a mesh, on a ground, in focus"
)]
pub struct Cli {
    /// Without one, the viewer opens.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Open the viewer (the default); with no display, render to thinlens.png
    View(ViewArgs),
    /// Render a picture to a file, without a window
    Render(RenderArgs),
    /// Prove a device: hold what it renders against the same mathematics in f64, sample by sample
    Verify(VerifyArgs),
    /// Measure a device: throughput, first picture, and how the error falls, for every sampler
    Bench(BenchArgs),
    /// List the built-in scenes
    Scenes,
    /// List the Vulkan devices that --device can name
    Devices,
}

/// `thinlens view`.
#[derive(Debug, Args, Default)]
pub struct ViewArgs {
    /// What to render.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// On which device, and whether it is watched.
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// `thinlens render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// What to render.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// The picture: .png (8-bit sRGB) or .exr (linear f32 R, G, B, and count: samples per pixel)
    #[arg(short, long, value_name = "OUT.png|OUT.exr")]
    pub output: PathBuf,
    /// Also write figures of the rendering, as JSON
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// On which device, and whether it is watched.
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Say nothing but warnings and errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// `thinlens verify`.
#[derive(Debug, Args)]
#[command(
    mut_arg("scene", |scene| scene.help("A built-in scene (see thinlens scenes), .toml or .obj file [default: every built-in one]")),
    mut_arg("samples", |samples| samples.help("Antialiasing points per pixel [default: 16]")),
    mut_arg("size", |size| size.help("Picture size in pixels [default: 128x96]")),
    mut_arg("noise_threshold", |threshold| threshold.hide(true)),
    mut_arg("overlay", |overlay| overlay.hide(true)),
    mut_arg("exposure", |exposure| exposure.hide(true))
)]
pub struct VerifyArgs {
    /// What to render.
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// On which device, and whether it is watched.
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// `thinlens bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Built-in scenes (see thinlens scenes), .toml or .obj files [default: every built-in one]
    scenes: Vec<String>,
    /// Picture size in pixels; the error is measured at 320x240 at most
    #[arg(short, long, value_name = "WxH", value_parser = parse_size, default_value = "640x480")]
    size: [u32; 2],
    /// Antialiasing points per pixel of the pictures that throughput is measured with
    #[arg(short = 'n', long, value_name = "N", allow_negative_numbers = true, default_value_t = DEFAULT_SAMPLES)]
    samples: u32,
    /// How often everything is measured, after a warm-up
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 5)]
    pub runs: u32,
    /// Give the figures as JSON, with spreads: to FILE beside the table, or in place of it
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = "-")]
    pub json: Option<PathBuf>,
    /// On which device, and whether it is watched.
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// Where to render.
#[derive(Debug, Args, Default)]
pub struct DeviceArgs {
    /// Vulkan device, by its index or part of its name (see thinlens devices) [default: the best]
    #[arg(long, value_name = "INDEX|NAME")]
    pub device: Option<String>,
    /// Check every Vulkan call with the Khronos validation layer; any message is a failure
    #[arg(long)]
    pub validation: bool,
}

/// What to render: a scene, and what to change of it.
#[derive(Debug, Args, Default)]
pub struct SettingsArgs {
    /// A built-in scene (see thinlens scenes), .toml or .obj file [default: version-4]
    scene: Option<String>,
    /// Antialiasing points per pixel: more for less noise [default: 64, in the viewer 256]
    #[arg(short = 'n', long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<u32>,
    /// Picture size in pixels [default: the scene's, in the viewer the window's]
    #[arg(short, long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Diameter of the lens, in scene units: wider blurs more, 0 is a pinhole [default: the scene's]
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    lens_diameter: Option<f32>,
    /// Distance of the plane in focus, in scene units along the axis [default: the scene's]
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    focal_distance: Option<f32>,
    /// Width of the square that a pixel's samples fall in: 1 is its own area, 0 one centre ray per
    /// pixel, more, up to 15, reaches into the neighbours [default: 1]
    #[arg(long, value_name = "PX", allow_negative_numbers = true)]
    jitter: Option<f32>,
    /// How many mirror reflections to follow, up to 64 [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    max_bounces: Option<u32>,
    /// How the points are chosen: sobol keeps a pixel's points apart, blue-noise also sets neighbouring
    /// pixels off against each other, random does neither [default: blue-noise]
    #[arg(long, value_name = "blue-noise|sobol|random", value_enum, hide_possible_values = true)]
    sampler: Option<SamplerArg>,
    /// Stops each pixel whose error is below this share of its brightness, 0.02 say, so that the work goes
    /// where the noise is; --samples is then the most that a pixel gets [default: 0, none stops]
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    noise_threshold: Option<f32>,
    /// Chooses other random points [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u32>,
    /// Brightness of a PNG or the window in stops: +1 doubles it, -1 halves it; an EXR stays as it is
    /// [default: 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    exposure: Option<f32>,
    /// Show each pixel's number of samples instead of the picture, in a PNG or the window: black for none,
    /// white for --samples
    #[arg(long, value_name = "count", value_enum, hide_possible_values = true)]
    overlay: Option<OverlayArg>,
}

/// What is shown instead of the picture.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum OverlayArg {
    Count,
}

impl OverlayArg {
    fn plain(self) -> Overlay {
        match self {
            Self::Count => Overlay::Count,
        }
    }
}

/// How sample values are made.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum SamplerArg {
    BlueNoise,
    Sobol,
    Random,
}

impl SamplerArg {
    fn plain(self) -> Sampler {
        match self {
            Self::BlueNoise => Sampler::BlueNoise,
            Self::Sobol => Sampler::Sobol,
            Self::Random => Sampler::Random,
        }
    }
}

impl DeviceArgs {
    /// As a plain value.
    pub fn choice(&self) -> DeviceChoice {
        DeviceChoice { device: self.device.clone(), validation: self.validation }
    }
}

impl BenchArgs {
    /// A picture of each scene that was named, or that is built in.
    ///
    /// # Errors
    /// Of the scene, or [`crate::error::Error::OutOfRange`].
    pub fn pictures(&self) -> Result<Vec<Settings>> {
        let picture = |name: &str| {
            let mut settings = Settings::of_scene(SceneRef::new(scene::load(name)?));
            settings.estimator.size = self.size;
            settings.samples = self.samples;
            settings.check()?;
            Ok(settings)
        };
        if self.scenes.is_empty() {
            return BUILTINS.iter().map(|builtin| picture(builtin.name)).collect();
        }
        self.scenes.iter().map(|name| picture(name)).collect()
    }

    /// Every sampler, by its name.
    pub fn samplers() -> Vec<(String, Sampler)> {
        let name = |sampler: &SamplerArg| {
            let value = sampler.to_possible_value()?;
            Some((value.get_name().to_owned(), sampler.plain()))
        };
        SamplerArg::value_variants().iter().filter_map(name).collect()
    }
}

impl SettingsArgs {
    /// The settings of a picture for a file.
    ///
    /// # Errors
    /// Of the scene, or [`crate::error::Error::OutOfRange`].
    pub fn of_file(&self) -> Result<Settings> {
        self.resolve(DEFAULT_SAMPLES)
    }

    /// The settings that the viewer starts with.
    ///
    /// # Errors
    /// Of the scene, or [`crate::error::Error::OutOfRange`].
    pub fn of_window(&self) -> Result<Settings> {
        self.resolve(DEFAULT_VIEW_SAMPLES)
    }

    /// The settings of small pictures to verify a device with: of the scene that was named, or of
    /// each that is built in.
    ///
    /// # Errors
    /// Of the scene, or [`crate::error::Error::OutOfRange`].
    pub fn of_proof(&self) -> Result<Vec<Settings>> {
        let named = self.scene.as_deref().map(|name| vec![name]);
        let names = named.unwrap_or_else(|| BUILTINS.iter().map(|builtin| builtin.name).collect());
        let proof = |name: &str| {
            let mut settings = self.resolve_scene(name, PROOF_SAMPLES)?;
            settings.estimator.size = self.size.unwrap_or(PROOF_SIZE);
            // The oracle has no noise to go by: it is held against single samples.
            settings.estimator.noise_threshold = 0.0;
            Ok(settings)
        };
        names.into_iter().map(proof).collect()
    }

    /// The scene, as it was named.
    pub fn scene(&self) -> &str {
        self.scene.as_deref().unwrap_or(BUILTINS[0].name)
    }

    fn resolve(&self, samples: u32) -> Result<Settings> {
        self.resolve_scene(self.scene(), samples)
    }

    fn resolve_scene(&self, name: &str, samples: u32) -> Result<Settings> {
        let mut settings = Settings::of_scene(SceneRef::new(scene::load(name)?));
        let estimator = &mut settings.estimator;
        estimator.size = self.size.unwrap_or(estimator.size);
        estimator.lens.diameter = self.lens_diameter.unwrap_or(estimator.lens.diameter);
        estimator.lens.focal_distance = self.focal_distance.unwrap_or(estimator.lens.focal_distance);
        estimator.jitter = self.jitter.unwrap_or(estimator.jitter);
        estimator.max_bounces = self.max_bounces.unwrap_or(estimator.max_bounces);
        estimator.sampler = self.sampler.map_or(estimator.sampler, SamplerArg::plain);
        estimator.seed = self.seed.unwrap_or(estimator.seed);
        estimator.noise_threshold = self.noise_threshold.unwrap_or(estimator.noise_threshold);
        settings.view.exposure_stops = self.exposure.unwrap_or(settings.view.exposure_stops);
        settings.view.overlay = self.overlay.map(OverlayArg::plain);
        settings.samples = self.samples.unwrap_or(samples);
        settings.check()?;
        Ok(settings)
    }
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parse = || {
        let (width, height) = text.split_once(['x', 'X'])?;
        Some([width.parse().ok()?, height.parse().ok()?])
    };
    parse().ok_or_else(|| "a size is WIDTHxHEIGHT in pixels, such as 1280x720".into())
}
