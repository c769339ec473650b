//! What to render, on the command line: a scene, and what to change of it.

use super::parse_size;
use crate::error::Result;
use crate::scene::{self, ApertureImage, BUILTINS, CameraModel, SceneRef};
use crate::settings::{DEFAULT_SAMPLES, Overlay, PRESETS, Preset, Sampler, Settings};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Samples per pixel that the viewer goes for, unless another number is asked for.
const DEFAULT_VIEW_SAMPLES: u32 = 256;

/// Pictures that a device is verified with: the oracle has to render them too.
const PROOF_SIZE: [u32; 2] = [128, 96];
const PROOF_SAMPLES: u32 = 16;

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
    /// The same by its f-number, which is the film's distance behind the lens over the diameter
    #[arg(long, value_name = "N", allow_negative_numbers = true, conflicts_with = "lens_diameter")]
    f_number: Option<f64>,
    /// A known lens: pinhole; a 50 mm lens, which sets the field of view too; or the human eye, by the
    /// width of its pupil. Other options change it further
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(PRESETS.map(|preset| preset.name)))]
    preset: Option<String>,
    /// What forms the picture: a thin lens, an ideal pinhole that leaves everything sharp, or a real hole
    /// in a box, without a lens [default: the scene's]
    #[arg(long, value_name = "thin-lens|pinhole|hole", value_enum, hide_possible_values = true)]
    camera: Option<CameraArg>,
    /// Diameter of the hole, with --camera hole, in scene units [default: the scene's, or 0.3 mm]
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    hole_diameter: Option<f32>,
    /// Turn the picture of a hole upright: on the film it is upside down
    #[arg(long)]
    upright: bool,
    /// The opening's shape: an iris of so many blades, 3 to 16; 0 is a disc [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    blades: Option<u32>,
    /// Turns the iris, anticlockwise, in degrees [default: the scene's]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    blade_rotation: Option<f32>,
    /// How far the blades' edges are bent: 0 a polygon, 1 a disc [default: the scene's]
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    roundness: Option<f32>,
    /// The opening's height over its width, 0.1 to 10; the longer is the diameter [default: the scene's]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    anamorphic: Option<f32>,
    /// The shape of a PNG: light comes in where it is bright
    #[arg(long, value_name = "FILE.png")]
    aperture_image: Option<PathBuf>,
    /// Optical vignetting: how far the lens's front rim is off its centre, seen from the picture's corner,
    /// in diameters, up to 1; highlights turn into cat's eyes there, and the corners darken [default: the
    /// scene's]
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    cats_eye: Option<f32>,
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
    /// How long the shutter is open, in seconds, as 0.01 or 1/100: longer is brighter, and what moves is
    /// blurred more [default: the scene's, or 1/60]
    #[arg(long, value_name = "SECONDS", value_parser = parse_shutter)]
    shutter: Option<f32>,
    /// The film's speed: higher is brighter [default: the scene's, or 100]
    #[arg(long, value_name = "ISO", allow_negative_numbers = true)]
    iso: Option<f32>,
    /// Let the brightness change with the aperture, as film does; else it stays as the scene's lens makes
    /// it
    #[arg(long)]
    unlock_exposure: bool,
    /// Brightness of a PNG or the window in stops: +1 doubles it, -1 halves it; an EXR stays as it is
    /// [default: 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    exposure: Option<f32>,
    /// Show, in a PNG or the window, instead of the picture: circle-of-confusion (blue in front of the focal
    /// plane, orange behind), depth, samples (count) or error of each pixel; or the picture with what is
    /// sharp marked (focus-peaking), or what the focal plane cuts (focal-plane)
    #[arg(
        long,
        value_name = "focus-peaking|focal-plane|circle-of-confusion|depth|count|error",
        value_enum,
        hide_possible_values = true
    )]
    overlay: Option<OverlayArg>,
    /// How wide a circle of confusion may be that counts as sharp, in pixels [default: 1]
    #[arg(long, value_name = "PX", allow_negative_numbers = true)]
    tolerance: Option<f32>,
}

/// What is shown instead of the picture.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum OverlayArg {
    FocusPeaking,
    FocalPlane,
    CircleOfConfusion,
    Depth,
    Count,
    Error,
}

impl OverlayArg {
    fn plain(self) -> Overlay {
        match self {
            Self::FocusPeaking => Overlay::FocusPeaking,
            Self::FocalPlane => Overlay::FocalPlane,
            Self::CircleOfConfusion => Overlay::Blur,
            Self::Depth => Overlay::Depth,
            Self::Count => Overlay::Count,
            Self::Error => Overlay::Error,
        }
    }
}

/// What forms the picture.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum CameraArg {
    ThinLens,
    Pinhole,
    Hole,
}

impl CameraArg {
    fn plain(self) -> CameraModel {
        match self {
            Self::ThinLens => CameraModel::ThinLens,
            Self::Pinhole => CameraModel::Pinhole,
            Self::Hole => CameraModel::Hole,
        }
    }
}

/// How sample values are made.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum SamplerArg {
    BlueNoise,
    Sobol,
    Random,
}

impl SamplerArg {
    pub(super) fn plain(self) -> Sampler {
        match self {
            Self::BlueNoise => Sampler::BlueNoise,
            Self::Sobol => Sampler::Sobol,
            Self::Random => Sampler::Random,
        }
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
        if let Some(preset) = self.preset.as_deref().and_then(Preset::named) {
            preset.apply(estimator);
        }
        estimator.model = self.camera.map_or(estimator.model, CameraArg::plain);
        estimator.lens.diameter = self.lens_diameter.unwrap_or(estimator.lens.diameter);
        if let Some(f_number) = self.f_number {
            estimator.set_f_number(f_number)?;
        }
        estimator.hole.diameter = self.hole_diameter.unwrap_or(estimator.hole.diameter);
        estimator.hole.upright |= self.upright;
        let aperture = &mut estimator.aperture;
        aperture.blades = self.blades.unwrap_or(aperture.blades);
        aperture.rotation_degrees = self.blade_rotation.unwrap_or(aperture.rotation_degrees);
        aperture.roundness = self.roundness.unwrap_or(aperture.roundness);
        aperture.anamorphic = self.anamorphic.unwrap_or(aperture.anamorphic);
        aperture.cats_eye = self.cats_eye.unwrap_or(aperture.cats_eye);
        estimator.shutter = self.shutter.unwrap_or(estimator.shutter);
        settings.view.iso = self.iso.unwrap_or(settings.view.iso);
        settings.view.exposure_lock = !self.unlock_exposure;
        if let Some(path) = &self.aperture_image {
            aperture.image = Some(ApertureImage::read(path)?);
        }
        estimator.lens.focal_distance = self.focal_distance.unwrap_or(estimator.lens.focal_distance);
        estimator.jitter = self.jitter.unwrap_or(estimator.jitter);
        estimator.max_bounces = self.max_bounces.unwrap_or(estimator.max_bounces);
        estimator.sampler = self.sampler.map_or(estimator.sampler, SamplerArg::plain);
        estimator.seed = self.seed.unwrap_or(estimator.seed);
        estimator.noise_threshold = self.noise_threshold.unwrap_or(estimator.noise_threshold);
        settings.view.exposure_stops = self.exposure.unwrap_or(settings.view.exposure_stops);
        settings.show(self.overlay.map(OverlayArg::plain));
        settings.view.tolerance = self.tolerance.unwrap_or(settings.view.tolerance);
        settings.samples = self.samples.unwrap_or(samples);
        settings.check()?;
        Ok(settings)
    }
}

fn parse_shutter(text: &str) -> Result<f32, String> {
    let seconds = match text.split_once('/') {
        Some((over, under)) => over.parse().ok().zip(under.parse().ok()).map(|(a, b): (f32, f32)| a / b),
        None => text.parse().ok(),
    };
    seconds.ok_or_else(|| "a shutter time is in seconds, such as 0.01 or 1/100".into())
}
