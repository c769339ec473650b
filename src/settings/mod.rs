//! Everything that a user can set. [`Estimator`] has the settings whose change starts the film anew, and [`View`] the
//! others.

mod arguments;
mod focusing;
pub mod list;
mod options;
pub mod saved_names;
mod scene_file;
mod setting;
mod sweep;

pub use crate::scene::{Unit, metric, rounded};
pub use arguments::quoted;
pub use focusing::{Focusing, Place};
pub use options::Changes;
pub use setting::{
    Access, Called, Choice, Field, Key, Part, Role, Row, Setting, Slider, Value, Widget, size, to_linear,
    to_srgb,
};
pub use sweep::Sweep;

use crate::error::{Error, Result};
use crate::scene::{
    Aperture, Camera, CameraModel, FocalPlane, FullScale, Hole, Integrator, Lens, MAX_BOUNCES, Overlay,
    Preset, SceneRef, Source, Stage, View, in_range,
};
use std::path::Path;

/// The film stores counts in f32, which is exact up to this number.
pub const MAX_SAMPLES: u32 = 1 << 24;
/// The smallest and the largest jitter, in pixels. Accumulation reads `ceil(jitter / 2 - 1 / 2)` pixels in each
/// direction.
pub const JITTERS: [f32; 2] = [0.0, 15.0];
/// The default number of samples per pixel without a window.
pub const DEFAULT_SAMPLES: u32 = 64;
/// The default jitter, with which a sample stays within its pixel.
pub const DEFAULT_JITTER: f32 = 1.0;

/// What is rendered, how it is shown, and the number of samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// A change here starts the film anew.
    pub estimator: Estimator,
    /// A change here does not.
    pub view: View,
    /// The number of samples per pixel to reach.
    pub samples: u32,
}

/// The device to render on.
#[derive(Debug, Clone, Default)]
pub struct DeviceChoice {
    /// The device, by its index or a part of its name. `None` chooses the best one.
    pub device: Option<String>,
    /// Whether the validation layer checks every call. Any message of it is a failure.
    pub validation: bool,
}

/// The settings that change the integral that a pixel estimates.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimator {
    /// The shapes, materials and lights.
    pub scene: SceneRef,
    /// How a lone mesh is shown. [`Settings::restage`] makes the scene so; until then, the scene is as it was.
    pub stage: Stage,
    /// The position and the field of view of the camera.
    pub camera: Camera,
    /// The camera model.
    pub model: CameraModel,
    /// The thin lens.
    pub lens: Lens,
    /// The hole of a camera without a lens.
    pub hole: Hole,
    /// The shape of the aperture of the lens or of the hole.
    pub aperture: Aperture,
    /// How long the shutter is open, in seconds. What moves during this time is blurred.
    pub shutter: f32,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The width of the square around a pixel's centre that its samples fall in, in pixels.
    pub jitter: f32,
    /// What finds the radiance along a ray.
    pub integrator: Integrator,
    /// How often light is scattered on its way from a lamp or the sky to the lens. `whitted` counts mirrors only.
    pub max_bounces: u32,
    /// How often `path` lets light be scattered by surfaces that spread it: all but smooth mirrors, metals and glass.
    pub diffuse_bounces: u32,
    /// The most luminance of what a path finds after its first surface, to 11 bits; 0 for no limit. It takes away bright dots, and
    /// light.
    pub clamp: f32,
    /// How sample values are made.
    pub sampler: Sampler,
    /// The seed of the sample values.
    pub seed: u32,
    /// The threshold of adaptive sampling; 0 turns it off. A pixel stops when two relative errors are below the
    /// threshold in the pixel and in all its neighbours: the standard error of the mean luminance, and the possible
    /// loss by things that no sample has hit. Both are relative to the mean luminance, but at least to 0.05. See
    /// `shaders/core/adaptive.glsl`.
    pub noise_threshold: f32,
    /// Whether the film keeps second moments, so that its error can be shown. Adaptive films always do.
    pub keeps_moments: bool,
}

impl Estimator {
    /// Whether the film keeps second moments.
    pub fn has_moments(&self) -> bool {
        self.keeps_moments || self.is_adaptive()
    }

    /// Whether sampling is adaptive.
    pub fn is_adaptive(&self) -> bool {
        self.noise_threshold > 0.0
    }

    /// The camera with its film where it stands when the lens is in focus.
    pub fn focused_camera(&self) -> Camera {
        match self.model {
            CameraModel::ThinLens => self.camera.focused(&self.lens),
            CameraModel::Pinhole | CameraModel::Hole => self.camera,
        }
    }

    /// The lens, which is not tilted where a pinhole or a hole stands in its place.
    pub fn lens_in_use(&self) -> Lens {
        match self.model {
            CameraModel::ThinLens => self.lens,
            CameraModel::Pinhole | CameraModel::Hole => Lens { tilt_degrees: 0.0, ..self.lens },
        }
    }

    /// One over the Abbe number of the glass, or 0 for a lens without colour errors and where there is no lens.
    pub fn dispersion(&self) -> f64 {
        let has_errors = self.model == CameraModel::ThinLens && self.lens.abbe_number > 0;
        if has_errors { f64::from(self.lens.abbe_number).recip() } else { 0.0 }
    }

    /// Where the lens is in focus.
    pub fn focal_plane(&self) -> FocalPlane {
        self.focused_camera().focal_plane(&self.lens_in_use())
    }

    /// The f-number of the lens when it is focused at infinity, which is the one engraved on a lens. Infinite if the
    /// diameter is 0.
    pub fn f_number(&self) -> f64 {
        self.camera.f_number(self.lens.diameter)
    }

    /// Whether the picture is turned by half a turn, as it falls on the film behind a hole.
    pub fn is_upside_down(&self) -> bool {
        self.model == CameraModel::Hole && !self.hole.upright
    }

    /// A warning if f32 is too coarse for this picture. Devices compute with f32 from the middle of the scene, and its
    /// steps are visible if they are larger than a quarter of a pixel.
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

    /// Puts a well-known lens on the camera.
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
    /// Independent random numbers. The error falls with the square root of the number of samples.
    Random,
    /// The Owen-scrambled Sobol sequence in four dimensions, for film and lens together. The samples of a pixel are
    /// spread evenly on both. B. Burley, JCGT 9(4), 2020.
    Sobol,
    /// The Sobol sequence, arranged so that the errors of neighbouring pixels are opposed and the eye averages them.
    /// The effect is strongest with the first samples, and still there with 16. The samples are arranged as in E.
    /// Heitz, L. Belcour, V. Ostromoukhov, D. Coeurjolly and J.-C. Iehl, "A Low-Discrepancy Sampler that Distributes
    /// Monte Carlo Errors as a Blue Noise in Screen Space", SIGGRAPH Talks 2019, but with masks on one sequence: I.
    /// Georgiev and M. Fajardo, "Blue-noise Dithered Sampling", SIGGRAPH Talks 2016.
    #[default]
    BlueNoise,
}

impl Sampler {
    /// Every sampler, by its name.
    pub const NAMES: [(&'static str, Self); 3] =
        [("blue-noise", Self::BlueNoise), ("sobol", Self::Sobol), ("random", Self::Random)];
}

impl Settings {
    /// The settings that the scene itself gives.
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
                integrator: scene.integrator,
                max_bounces: scene.max_bounces,
                diffuse_bounces: MAX_BOUNCES,
                clamp: 0.0,
                jitter: DEFAULT_JITTER,
                sampler: Sampler::default(),
                seed: 0,
                noise_threshold: 0.0,
                keeps_moments: false,
                stage: scene.stage().copied().unwrap_or_default(),
                scene,
            },
            view,
            samples: DEFAULT_SAMPLES,
        };
        settings.show(view.overlay);
        settings
    }

    /// The files that these settings were read from, each with its description for messages.
    pub fn files(&self) -> Vec<(&'static str, &Path)> {
        let Estimator { scene, aperture, .. } = &self.estimator;
        let of_scene = scene.files.iter().map(|file| ("a file of the scene", file.as_path()));
        let image = aperture.image.as_ref().map(|image| ("the aperture image", image.file.as_path()));
        of_scene.chain(image).collect()
    }

    /// The settings that the scene itself gives, sampled as these settings are.
    pub fn of_scene_alone(&self) -> Self {
        let mut settings = Self::of_scene(self.estimator.scene.clone());
        settings.estimator.size = self.estimator.size;
        settings.samples = self.samples;
        settings
    }

    /// The settings for another scene. The size and everything about sampling stay as they are, and so does an overlay
    /// if the scene has none of its own.
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

    /// Makes the scene anew if its model is to be shown in another way than it is. What differs from the scene's own
    /// settings stays as it is, and everything else follows the new scene.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a scene without a model, or [`Error::Mesh`] if the model cannot be shown like this.
    pub fn restage(&mut self) -> Result<()> {
        let Estimator { scene, stage, .. } = &self.estimator;
        if *stage == scene.stage().copied().unwrap_or_default() {
            return Ok(());
        }
        for setting in list::own().filter(|setting| setting.is_of_model()) {
            setting.check(&setting.get(self), Called::Flag)?;
        }
        if stage.light_direction.as_vec3() == glam::Vec3::ZERO {
            let name = list::setting("light-direction").name(Called::Flag);
            return Err(Error::OutOfRange(format!("{name} must not be zero")));
        }
        let Some(new) = scene.with_stage(stage)? else {
            let name = scene.source.display();
            return Err(Error::OutOfRange(format!(
                "{name} is no mesh, so it cannot be shown like this: the options of a model are for an .obj that is \
                 opened by itself, and a scene file says the same in its tables"
            )));
        };
        *self = self.on_stage(new);
        Ok(())
    }

    /// Whether only colours and lights of the scene are to be made anew.
    pub fn needs_colors(&self) -> bool {
        let Estimator { scene, stage, .. } = &self.estimator;
        scene.stage().is_some_and(|now| now != stage) && scene.keeps_shapes(stage)
    }

    /// The settings for the same scene on another stage.
    pub fn on_stage(&self, scene: SceneRef) -> Self {
        let plain = Self::of_scene(self.estimator.scene.clone());
        let mut new = Self::of_scene(scene);
        for setting in list::own() {
            let value = setting.get(self);
            match &setting.access {
                // The image is in memory already.
                Access::Image(field) => (field.set)(&mut new, (field.get)(self)),
                _ if value != setting.get(&plain) => {
                    setting.set(&mut new, &value).expect("only an image can fail to be read");
                }
                _ => {}
            }
        }
        new.estimator.keeps_moments = self.estimator.keeps_moments;
        new
    }

    /// Shows an overlay, or none. The overlay of the error needs moments, so the film keeps them from then on.
    pub fn show(&mut self, overlay: Option<Overlay>) {
        self.view.overlay = overlay;
        self.estimator.keeps_moments = needs_moments(overlay);
    }

    /// The end of the scale of an overlay, in samples, pixels, or as a fraction.
    pub fn overlay_scale(&self, overlay: Overlay) -> f32 {
        match overlay.entry().full_scale {
            FullScale::Samples => self.samples as f32,
            FullScale::Number(number) => number,
            FullScale::HeightOver(part) => self.estimator.size[1] as f32 / part,
            FullScale::Tolerance => self.tolerance_pixels() as f32,
        }
    }

    /// The largest circle of confusion that counts as sharp, in pixels of the picture.
    pub fn tolerance_pixels(&self) -> f64 {
        self.estimator.camera.tolerance_pixels(self.view.tolerance, self.estimator.size[1])
    }

    /// The length in millimetres on the film of so many pixels of the picture.
    pub fn mm_of_pixels(&self, pixels: f64) -> f64 {
        pixels * self.estimator.camera.mm_per_pixel(self.estimator.size[1])
    }

    /// The depths between which the lens shows everything sharp, in scene units. The far one may be infinite.
    pub fn depth_of_field(&self) -> [f64; 2] {
        let Estimator { camera, lens, size, .. } = &self.estimator;
        camera.depth_of_field(lens, self.tolerance_pixels(), size[1])
    }

    /// The hyperfocal distance of the lens, in scene units.
    pub fn hyperfocal_distance(&self) -> f64 {
        let Estimator { camera, lens, size, .. } = &self.estimator;
        camera.hyperfocal_distance(lens, self.tolerance_pixels(), size[1])
    }

    /// The brightness of the picture relative to the scene with its own lens, shutter and film. It is proportional to
    /// the shutter time and to the speed of the film. Unless the exposure is locked, it is also proportional to the
    /// inverse square of the f-number of the focused lens, and to the area of the aperture relative to that of a disc.
    /// A pinhole would let in no light, so it is treated as if the exposure were locked.
    pub fn exposure(&self) -> f32 {
        let (estimator, scene) = (&self.estimator, &*self.estimator.scene);
        let mut light =
            f64::from(estimator.shutter / scene.shutter) * f64::from(self.view.iso / scene.view.iso);
        if !self.view.exposure_lock {
            let f_numbers = match estimator.model {
                CameraModel::ThinLens => [
                    scene.camera.focused(&scene.lens).f_number(scene.lens.diameter),
                    estimator.focused_camera().f_number(estimator.lens.diameter),
                ],
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
                light *= estimator.aperture.relative_area() / scene.aperture.relative_area();
            }
        }
        self.view.exposure_stops.exp2() * light as f32
    }

    /// Checks that every number is in its range, and that the settings are consistent.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the option, the value and the range.
    pub fn check(&self) -> Result<()> {
        self.check_as(Called::Flag)
    }

    /// Works as [`Self::check`] does, but errors call the settings what the user calls them.
    ///
    /// # Errors
    /// As [`Settings::check`].
    pub fn check_as(&self, called: Called) -> Result<()> {
        let out_of_range = |message: String| Err(Error::OutOfRange(message));
        for setting in list::own() {
            setting.check(&setting.get(self), called)?;
        }
        let Estimator { scene, integrator, camera, model, lens, aperture, jitter, .. } = &self.estimator;
        integrator.can_render(scene).or_else(|reason| {
            let name = list::setting("integrator").name(called);
            out_of_range(format!("{name} {} {reason}", name_of(&Integrator::NAMES, integrator)))
        })?;
        if needs_moments(self.view.overlay) && !self.estimator.has_moments() {
            return out_of_range("the error is not known where no moments are kept".into());
        }
        let names = |flags: [&str; 3]| flags.map(|flag| list::setting(flag).name(called));
        camera
            .validate(|| names(["eye", "look-at", "up"]))
            .or_else(|reason| out_of_range(format!("the camera has no view: {reason}")))?;
        if *model == CameraModel::ThinLens {
            let distance = || list::setting("focal-distance").name(called);
            camera.can_focus(lens).or_else(|reason| out_of_range(format!("{} {reason}", distance())))?;
        }
        aperture.validate(|| names(["blades", "cats-eye", "aperture-image"])).or_else(out_of_range)?;
        // With a wide jitter, chance may land more samples than this in a pixel. 2^16 is 16 standard deviations, which
        // never happens.
        let most = if *jitter > DEFAULT_JITTER { MAX_SAMPLES - (1 << 16) } else { MAX_SAMPLES };
        let samples = || list::setting("samples").name(called);
        in_range(self.samples, [1, most]).or_else(|reason| out_of_range(format!("{} {reason}", samples())))
    }
}

fn needs_moments(overlay: Option<Overlay>) -> bool {
    overlay.is_some_and(|overlay| overlay.entry().source == Source::Moments)
}

/// The name of a value on the command line and in scene files.
fn name_of<T: PartialEq>(names: &[(&'static str, T)], value: &T) -> &'static str {
    names.iter().find(|(_, named)| named == value).map_or("", |(name, _)| name)
}

/// The value with this name.
fn named<T: Copy>(names: &[(&'static str, T)], name: &str) -> Option<T> {
    names.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}
