//! Everything a user can set, in the two halves that decide when the film starts anew.

mod arguments;
pub mod list;
mod options;
pub mod saved_names;
mod scene_file;
mod setting;
mod sweep;

pub use arguments::quoted;
pub use options::Changes;
pub use setting::{
    Access, Called, Choice, Field, Key, Part, Role, Row, Setting, Slider, Value, Widget, size,
};
pub use sweep::Sweep;

use crate::error::{Error, Result};
use crate::scene::{
    Aperture, Camera, CameraModel, FullScale, Hole, Lens, Overlay, Preset, SceneRef, Source, View, in_range,
};
use std::path::Path;

/// The film's count is held in f32, which is exact up to here.
pub const MAX_SAMPLES: u32 = 1 << 24;
/// The narrowest and widest jitter, in pixels. Accumulation looks at `ceil(jitter / 2 - 1 / 2)` pixels around.
pub const JITTERS: [f32; 2] = [0.0, 15.0];
/// Samples per pixel of a headless picture, unless another number is asked for.
pub const DEFAULT_SAMPLES: u32 = 64;
/// Jitter in pixels across: a sample stays within its pixel.
pub const DEFAULT_JITTER: f32 = 1.0;

/// What is rendered, how it is shown, and how far.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// A change here starts the film anew.
    pub estimator: Estimator,
    /// A change here does not.
    pub view: View,
    /// The number of samples per pixel to reach.
    pub samples: u32,
}

/// A place of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// Its middle.
    Centre,
    /// In pixels from its upper left corner.
    At([f32; 2]),
}

/// Where to render.
#[derive(Debug, Clone, Default)]
pub struct DeviceChoice {
    /// The device, by index or part of its name; none for the best.
    pub device: Option<String>,
    /// Whether the validation layer watches; any message of it is a failure.
    pub validation: bool,
}

/// Whatever changes the integral that a pixel estimates.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimator {
    /// Shapes, materials, lights.
    pub scene: SceneRef,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What forms the picture.
    pub model: CameraModel,
    /// The thin lens.
    pub lens: Lens,
    /// The hole of a camera without a lens.
    pub hole: Hole,
    /// The shape of either.
    pub aperture: Aperture,
    /// How long the shutter is open, in seconds: what moves meanwhile is blurred.
    pub shutter: f32,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Width of the square around a pixel's centre that its samples fall in, in pixels.
    pub jitter: f32,
    /// How many reflections are followed.
    pub max_bounces: u32,
    /// How sample values are made.
    pub sampler: Sampler,
    /// Chooses the sample values.
    pub seed: u32,
    /// Where not 0, a pixel stops once the standard error of its mean luminance, as a share of it or of
    /// 0.05, whichever is more, is below this in every pixel around it, and so is what they can lose of things
    /// that their samples have not met: see `shaders/core/adaptive.glsl`.
    pub noise_threshold: f32,
    /// Whether the film keeps second moments, so that its error can be looked at. Adaptive ones always do.
    pub keeps_moments: bool,
}

impl Estimator {
    /// Whether the film has second moments.
    pub fn has_moments(&self) -> bool {
        self.keeps_moments || self.is_adaptive()
    }

    /// Whether pixels stop by themselves.
    pub fn is_adaptive(&self) -> bool {
        self.noise_threshold > 0.0
    }

    /// The f-number of the lens; infinite where its diameter is 0.
    pub fn f_number(&self) -> f64 {
        self.camera.f_number(self.lens.diameter)
    }

    /// What to warn of where f32 is too coarse for the picture: a device computes with it, seen from the middle of
    /// the scene, and its steps would be seen where they are larger than a quarter of a pixel.
    pub fn too_coarse(&self) -> Option<String> {
        let camera = &self.camera;
        let from_middle = camera.eye.distance(self.scene.middle());
        let seen = match self.model {
            CameraModel::ThinLens => f64::from(self.lens.focal_distance),
            CameraModel::Pinhole | CameraModel::Hole => camera.eye.distance(camera.look_at),
        };
        let pixel = seen / camera.view_distance_pixels(self.size[1]);
        let step = from_middle.max(seen) * f64::from(f32::EPSILON);
        (step > 0.25 * pixel).then(|| {
            format!(
                "places are known to {step:.1e} only, {from_middle:.1e} from the middle of the scene, but a pixel is \
                 {pixel:.1e} wide where it is sharp: edges and shadows will be ragged; put things nearer together, or \
                 the camera nearer to them"
            )
        })
    }

    /// Puts a lens that people know in front of the camera.
    pub fn take_preset(&mut self, preset: &Preset) {
        preset.apply(&mut self.camera, &mut self.model, &mut self.lens);
    }

    /// Gives the lens this f-number.
    pub fn set_f_number(&mut self, f_number: f64) {
        self.lens.diameter = self.camera.diameter_of_f_number(f_number) as f32;
    }
}

/// How sample values are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sampler {
    /// Independent random numbers: error falls with the square root of their number.
    Random,
    /// The Sobol sequence, Owen-scrambled, four dimensions for film and lens together: a pixel's samples
    /// keep apart from each other on both. B. Burley, JCGT 9(4), 2020.
    Sobol,
    /// The Sobol sequence, with the errors of neighbouring pixels opposed to each other, so that the eye averages them: most
    /// with the first samples, and still a little with 16. The samples are arranged as E. Heitz, L. Belcour, V. Ostromoukhov, D. Coeurjolly and J.-C. Iehl
    /// do, "A Low-Discrepancy Sampler that Distributes Monte Carlo Errors as a Blue Noise in Screen
    /// Space", SIGGRAPH Talks 2019, but by masks on one sequence: I. Georgiev and M. Fajardo, "Blue-noise
    /// Dithered Sampling", SIGGRAPH Talks 2016.
    #[default]
    BlueNoise,
}

impl Sampler {
    /// Every sampler, by its name.
    pub const NAMES: [(&'static str, Self); 3] =
        [("blue-noise", Self::BlueNoise), ("sobol", Self::Sobol), ("random", Self::Random)];
}

impl Settings {
    /// The settings that a scene was composed for.
    pub fn of_scene(scene: SceneRef) -> Self {
        let view = scene.view;
        let mut settings = Self {
            estimator: Estimator {
                camera: scene.camera,
                model: scene.model,
                lens: scene.lens,
                hole: scene.hole,
                aperture: scene.aperture.clone(),
                shutter: scene.shutter,
                size: scene.size,
                max_bounces: scene.max_bounces,
                jitter: DEFAULT_JITTER,
                sampler: Sampler::default(),
                seed: 0,
                noise_threshold: 0.0,
                keeps_moments: false,
                scene,
            },
            view,
            samples: DEFAULT_SAMPLES,
        };
        settings.show(view.overlay);
        settings
    }

    /// The files that it is made from, each with what it is called in a message.
    pub fn files(&self) -> Vec<(&'static str, &Path)> {
        let Estimator { scene, aperture, .. } = &self.estimator;
        let of_scene = scene.files.iter().map(|file| ("a file of the scene", file.as_path()));
        let image = aperture.image.as_ref().map(|image| ("the aperture image", image.file.as_path()));
        of_scene.chain(image).collect()
    }

    /// What the scene was composed for, as it is sampled here.
    pub fn of_scene_alone(&self) -> Self {
        let mut settings = Self::of_scene(self.estimator.scene.clone());
        settings.estimator.size = self.estimator.size;
        settings.samples = self.samples;
        settings
    }

    /// The settings of another scene. What is no part of scenes stays: the size, how it is sampled, and an overlay,
    /// unless the scene has its own.
    #[must_use]
    pub fn with_scene(&self, scene: SceneRef) -> Self {
        let mut settings = Self::of_scene(scene);
        settings.estimator.size = self.estimator.size;
        for setting in list::own().filter(|setting| setting.is_of_sampling()) {
            setting.set(&mut settings, &setting.get(self)).expect("no image says how a scene is sampled");
        }
        if settings.view.overlay.is_none() {
            settings.view.tolerance = self.view.tolerance;
            settings.show(self.view.overlay);
        }
        settings
    }

    /// Shows an overlay, or none. An error needs moments, which the film then keeps from its start.
    pub fn show(&mut self, overlay: Option<Overlay>) {
        self.view.overlay = overlay;
        self.estimator.keeps_moments = needs_moments(overlay);
    }

    /// Where the scale of an overlay ends: samples, share, or pixels.
    pub fn overlay_scale(&self, overlay: Overlay) -> f32 {
        match overlay.entry().full_scale {
            FullScale::Samples => self.samples as f32,
            FullScale::Number(number) => number,
            FullScale::HeightOver(part) => self.estimator.size[1] as f32 / part,
            FullScale::Tolerance => self.view.tolerance,
        }
    }

    /// How often as bright the picture is shown: relative to the scene with its own lens, shutter and film.
    /// The light that comes in goes with the time, and with the opening's area, unless the exposure is locked or
    /// there is a pinhole, through which none would: with the inverse square of the f-number, and with the share
    /// of a disc that the opening's shape leaves open.
    pub fn exposure(&self) -> f32 {
        let (estimator, scene) = (&self.estimator, &*self.estimator.scene);
        let mut light =
            f64::from(estimator.shutter / scene.shutter) * f64::from(self.view.iso / scene.view.iso);
        if !self.view.exposure_lock {
            let f_numbers = match estimator.model {
                CameraModel::ThinLens => [scene.camera.f_number(scene.lens.diameter), estimator.f_number()],
                CameraModel::Pinhole => [1.0; 2],
                CameraModel::Hole => [
                    scene.camera.f_number(scene.hole.diameter),
                    estimator.camera.f_number(estimator.hole.diameter),
                ],
            };
            let [of_scene, now] = f_numbers;
            if of_scene.is_finite() && now.is_finite() {
                light *= (of_scene / now).powi(2);
            }
            if estimator.model != CameraModel::Pinhole {
                light *= estimator.aperture.open_share() / scene.aperture.open_share();
            }
        }
        self.view.exposure_stops.exp2() * light as f32
    }

    /// Checks that every number is in its range, and that settings that belong together fit each other.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], naming the option, the value and the range.
    pub fn check(&self) -> Result<()> {
        self.check_as(Called::Flag)
    }

    /// Checks as [`Self::check`] does. Errors name the settings as the user called them.
    ///
    /// # Errors
    /// As [`Settings::check`].
    pub fn check_as(&self, called: Called) -> Result<()> {
        let out_of_range = |message: String| Err(Error::OutOfRange(message));
        for setting in list::own() {
            setting.check(&setting.get(self), called)?;
        }
        let Estimator { camera, aperture, jitter, .. } = &self.estimator;
        if needs_moments(self.view.overlay) && !self.estimator.has_moments() {
            return out_of_range("the error is not known where no moments are kept".into());
        }
        let names = |flags: [&str; 3]| flags.map(|flag| list::setting(flag).name(called));
        let [eye, look_at, up] = &names(["eye", "look-at", "up"]);
        camera
            .validate([eye, look_at, up])
            .or_else(|reason| out_of_range(format!("the camera has no view: {reason}")))?;
        let [blades, cats_eye, image] = &names(["blades", "cats-eye", "aperture-image"]);
        aperture.validate([blades, cats_eye, image]).or_else(out_of_range)?;
        // Chance lands more than its share in a pixel: by 16 standard deviations, never that many.
        let most = if *jitter > DEFAULT_JITTER { MAX_SAMPLES - (1 << 16) } else { MAX_SAMPLES };
        let samples = || list::setting("samples").name(called);
        in_range(self.samples, [1, most]).or_else(|reason| out_of_range(format!("{} {reason}", samples())))
    }
}

fn needs_moments(overlay: Option<Overlay>) -> bool {
    overlay.is_some_and(|overlay| overlay.entry().source == Source::Moments)
}

/// What a value is called on the command line and in scene files.
fn name_of<T: PartialEq>(names: &[(&'static str, T)], value: &T) -> &'static str {
    names.iter().find(|(_, named)| named == value).map_or("", |(name, _)| name)
}

/// The value of this name.
fn named<T: Copy>(names: &[(&'static str, T)], name: &str) -> Option<T> {
    names.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}
