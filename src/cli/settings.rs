//! What to render, on the command line: a scene, and what to change of it.

use super::parse_size;
use crate::error::Result;
use crate::scene::{self, ApertureImage, BUILTINS, CameraModel, Overlay, PRESETS, Preset, SceneRef};
use crate::settings::{DEFAULT_SAMPLES, Sampler, Settings};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use glam::DVec3;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Samples per pixel that the viewer goes for, unless another number is asked for.
const DEFAULT_VIEW_SAMPLES: u32 = 256;

/// Pictures that a device is verified with: the oracle has to render them too.
const PROOF_SIZE: [u32; 2] = [128, 96];
const PROOF_SAMPLES: u32 = 16;

/// What to render: a scene, and what to change of it.
#[derive(Debug, Args, Default, PartialEq)]
pub struct SettingsArgs {
    /// A built-in scene (see thinlens scenes), .toml or .obj file [default: version-4]
    scene: Option<PathBuf>,
    /// Antialiasing points per pixel: more for less noise [default: 64, in the viewer 256]
    #[arg(short = 'n', long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<u32>,
    /// Picture size in pixels [default: the scene's, in the viewer the window's]
    #[arg(short, long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Where the lens centre is [default: the scene's]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    eye: Option<DVec3>,
    /// A point that the camera looks at [default: the scene's]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    look_at: Option<DVec3>,
    /// Which way is roughly up [default: the scene's]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    up: Option<DVec3>,
    /// Field of view from the lower to the upper edge, in degrees [default: the scene's]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    vfov: Option<f64>,
    /// Length of a scene unit in metres: it ties the scene to millimetres of film and lens [default: the
    /// scene's]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    metres_per_unit: Option<f64>,
    /// Diameter of the lens, in scene units: wider blurs more, 0 is a pinhole [default: the scene's]
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    lens_diameter: Option<f32>,
    /// The same by its f-number, which is the film's distance behind the lens over the diameter
    #[arg(long, value_name = "N", allow_negative_numbers = true, conflicts_with = "lens_diameter")]
    f_number: Option<f64>,
    /// A known lens: pinhole; a 50 mm lens, which sets the field of view too; or the human eye, by the
    /// width of its pupil. The film of a 50 mm lens stays where it is for infinity, so near by it frames wider
    /// than a lens that is screwed out: at 0.5 m as one of 45.5 mm would. Other options change it further
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(PRESETS.map(|preset| preset.name)))]
    preset: Option<String>,
    /// What forms the picture: a thin lens, an ideal pinhole that leaves everything sharp, or a real hole
    /// in a box, without a lens [default: the scene's]
    #[arg(long, value_name = "thin-lens|pinhole|hole", value_parser = one_of(&CameraModel::NAMES), hide_possible_values = true)]
    camera: Option<CameraModel>,
    /// Diameter of the hole, with --camera hole, in scene units [default: the scene's, or 0.3 mm]
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    hole_diameter: Option<f32>,
    /// Turn the picture of a hole upright: on the film it is upside down
    #[arg(long, value_name = "true|false", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    upright: Option<bool>,
    /// The opening's shape: an iris of so many blades, 3 to 16; 0 is a disc. The blades' corners lie on the rim
    /// of the lens's diameter: 5 let in 76% of a disc's light, 8 90% [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    blades: Option<u32>,
    /// Turns the iris anticlockwise, in degrees, seen from behind the camera; at 0 the middle of a blade's edge
    /// is at the right [default: the scene's]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    blade_rotation: Option<f32>,
    /// How far the blades' edges are bent: 0 a polygon, 1 a disc [default: the scene's]
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    roundness: Option<f32>,
    /// The opening's height over its width, 0.1 to 10; the longer is the diameter [default: the scene's]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    anamorphic: Option<f32>,
    /// The shape of a PNG: light comes in where it is bright; none takes the scene's away
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
    #[arg(long, value_name = "blue-noise|sobol|random", value_parser = one_of(&Sampler::NAMES), hide_possible_values = true)]
    sampler: Option<Sampler>,
    /// Stops each pixel whose error is below this share of its brightness, 0.02 say, so that the work goes
    /// where the noise is; more than 0.2 counts as 0.2. Pixels that a lamp or mirror image may reach go on until
    /// they can lose 2% of their brightness at most by not having met it. --samples is then the most that a
    /// pixel gets [default: 0, none stops]
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
    /// Whether the brightness stays as the scene's lens makes it; else it changes with the aperture, as on
    /// film [default: the scene's, or true]
    #[arg(long, value_name = "true|false", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    exposure_lock: Option<bool>,
    /// Brightness of a PNG or the window in stops: +1 doubles it, -1 halves it; an EXR stays as it is
    /// [default: the scene's, or 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    exposure: Option<f32>,
    /// Show, in a PNG or the window, instead of the picture: circle-of-confusion (blue in front of the focal
    /// plane, orange behind), depth, samples (count) or error of each pixel; or the picture with what is
    /// sharp marked (focus-peaking), or what the focal plane cuts (focal-plane) [default: the scene's, or none]
    #[arg(
        long,
        value_name = "focus-peaking|focal-plane|circle-of-confusion|depth|count|error|none",
        value_parser = one_of(&OVERLAYS),
        hide_possible_values = true
    )]
    overlay: Option<Shown>,
    /// How wide a circle of confusion may be that counts as sharp, in pixels [default: the scene's, or 1]
    #[arg(long, value_name = "PX", allow_negative_numbers = true)]
    tolerance: Option<f32>,
}

impl SettingsArgs {
    /// The settings of a picture for a file.
    ///
    /// # Errors
    /// Of the scene, or [`crate::error::Error::OutOfRange`].
    pub fn of_file(&self) -> Result<Settings> {
        self.resolve(DEFAULT_SAMPLES)
    }

    /// The settings of a picture for a file that starts from another one's arguments.
    ///
    /// # Errors
    /// Of either, or of the scene.
    pub fn of_picture(&self, arguments: &[OsString]) -> Result<Settings> {
        let mut settings = super::settings_of_arguments(arguments)?;
        self.apply(&mut settings)?;
        Ok(settings)
    }

    /// Whether nothing was named.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
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
        let names = named.unwrap_or_else(|| BUILTINS.iter().map(|builtin| Path::new(builtin.name)).collect());
        let proof = |name: &Path| {
            let mut settings = self.resolve_scene(name, PROOF_SAMPLES)?;
            settings.estimator.size = self.size.unwrap_or(PROOF_SIZE);
            // The oracle has no noise to go by: it is held against single samples.
            settings.estimator.noise_threshold = 0.0;
            Ok(settings)
        };
        names.into_iter().map(proof).collect()
    }

    /// The scene, as it was named.
    pub fn scene(&self) -> &Path {
        self.scene.as_deref().unwrap_or(Path::new(BUILTINS[0].name))
    }

    fn resolve(&self, samples: u32) -> Result<Settings> {
        self.resolve_scene(self.scene(), samples)
    }

    fn resolve_scene(&self, name: &Path, samples: u32) -> Result<Settings> {
        let mut settings = Settings::of_scene(SceneRef::new(scene::load(name)?));
        settings.samples = samples;
        self.apply(&mut settings)?;
        Ok(settings)
    }

    /// Changes what was named, and leaves the rest.
    ///
    /// # Errors
    /// [`crate::error::Error::OutOfRange`], or of an image.
    pub fn apply(&self, settings: &mut Settings) -> Result<()> {
        let Settings { estimator, view, samples } = settings;
        set(&mut estimator.size, self.size);
        set(samples, self.samples);
        let camera = &mut estimator.camera;
        set(&mut camera.eye, self.eye);
        set(&mut camera.look_at, self.look_at);
        set(&mut camera.up, self.up);
        set(&mut camera.metres_per_unit, self.metres_per_unit);
        // What else is named changes the preset.
        if let Some(preset) = self.preset.as_deref().and_then(Preset::named) {
            estimator.take_preset(preset);
        }
        set(&mut estimator.camera.vfov_radians, self.vfov.map(f64::to_radians));
        set(&mut estimator.model, self.camera);
        set(&mut estimator.lens.diameter, self.lens_diameter);
        if let Some(f_number) = self.f_number {
            estimator.set_f_number(f_number)?;
        }
        set(&mut estimator.lens.focal_distance, self.focal_distance);
        set(&mut estimator.hole.diameter, self.hole_diameter);
        set(&mut estimator.hole.upright, self.upright);

        let aperture = &mut estimator.aperture;
        set(&mut aperture.blades, self.blades);
        set(&mut aperture.rotation_degrees, self.blade_rotation);
        set(&mut aperture.roundness, self.roundness);
        set(&mut aperture.anamorphic, self.anamorphic);
        set(&mut aperture.cats_eye, self.cats_eye);
        if let Some(path) = &self.aperture_image {
            let none = path.as_os_str() == "none";
            aperture.image = if none { None } else { Some(ApertureImage::read(path)?) };
        }

        set(&mut estimator.jitter, self.jitter);
        set(&mut estimator.max_bounces, self.max_bounces);
        set(&mut estimator.sampler, self.sampler);
        set(&mut estimator.seed, self.seed);
        set(&mut estimator.noise_threshold, self.noise_threshold);
        set(&mut estimator.shutter, self.shutter);
        set(&mut view.iso, self.iso);
        set(&mut view.exposure_lock, self.exposure_lock);
        set(&mut view.exposure_stops, self.exposure);
        set(&mut view.tolerance, self.tolerance);
        if let Some(Shown(overlay)) = self.overlay {
            settings.show(overlay);
        }
        settings.check()
    }
}

fn set<T>(value: &mut T, wanted: Option<T>) {
    if let Some(wanted) = wanted {
        *value = wanted;
    }
}

/// An overlay or none, as a value of its own: clap takes an `Option` for an option that may be missing.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shown(Option<Overlay>);

const OVERLAYS: [(&str, Shown); 7] = {
    let names = Overlay::NAMES;
    let mut overlays = [("none", Shown(None)); 7];
    let mut i = 0;
    while i < names.len() {
        overlays[i] = (names[i].0, Shown(Some(names[i].1)));
        i += 1;
    }
    overlays
};

/// One of these, by its name.
fn one_of<T: Copy + Send + Sync + 'static>(
    names: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    let values = PossibleValuesParser::new(names.iter().map(|(name, _)| *name));
    values.try_map(|text| {
        names.iter().find(|(name, _)| *name == text).map(|(_, value)| *value).ok_or("no such name")
    })
}

fn parse_vector(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    let vector = numbers.ok().and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
    vector.map(DVec3::from_array).ok_or_else(|| "a place or direction is X,Y,Z, such as 0,1.5,-10".into())
}

fn parse_shutter(text: &str) -> Result<f32, String> {
    let seconds = match text.split_once('/') {
        Some((over, under)) => over.parse().ok().zip(under.parse().ok()).map(|(a, b): (f32, f32)| a / b),
        None => text.parse().ok(),
    };
    seconds.ok_or_else(|| "a shutter time is in seconds, such as 0.01 or 1/100".into())
}
