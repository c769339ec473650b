//! Settings as the arguments of the command line that renders them: for people to copy, and for pictures to
//! carry.

use super::{Sampler, Settings};
use crate::scene::{CameraModel, Overlay};
use glam::DVec3;

impl Settings {
    /// What follows `thinlens render` to get this picture again, but for where to: the scene as it was named,
    /// size and samples, and what is not as the scene has it. Numbers have as many digits as they need to come
    /// back the same.
    pub fn arguments(&self) -> Vec<String> {
        let (estimator, view) = (&self.estimator, &self.view);
        let scene = &*estimator.scene;
        let plain = Self::of_scene(estimator.scene.clone());
        let mut list = Arguments(vec![scene.source.clone()]);
        let [width, height] = estimator.size;
        list.push("size", format!("{width}x{height}"));
        list.push("samples", self.samples);

        let (camera, of_scene) = (&estimator.camera, &scene.camera);
        list.vector("eye", camera.eye, of_scene.eye);
        list.vector("look-at", camera.look_at, of_scene.look_at);
        list.vector("up", camera.up, of_scene.up);
        list.change("vfov", camera.vfov_degrees(), of_scene.vfov_degrees());
        list.change("metres-per-unit", camera.metres_per_unit, of_scene.metres_per_unit);

        let model = |model| name_of(&CameraModel::NAMES, &model);
        list.change("camera", model(estimator.model), model(scene.model));
        list.change("lens-diameter", estimator.lens.diameter, scene.lens.diameter);
        list.change("focal-distance", estimator.lens.focal_distance, scene.lens.focal_distance);
        list.change("hole-diameter", estimator.hole.diameter, scene.hole.diameter);
        list.change("upright", estimator.hole.upright, scene.hole.upright);

        let (aperture, of_scene) = (&estimator.aperture, &scene.aperture);
        list.change("blades", aperture.blades, of_scene.blades);
        list.change("blade-rotation", aperture.rotation_degrees, of_scene.rotation_degrees);
        list.change("roundness", aperture.roundness, of_scene.roundness);
        list.change("anamorphic", aperture.anamorphic, of_scene.anamorphic);
        list.change("cats-eye", aperture.cats_eye, of_scene.cats_eye);
        if aperture.image != of_scene.image {
            list.push("aperture-image", aperture.image.as_ref().map_or("none", |image| &image.file));
        }

        list.change("shutter", estimator.shutter, scene.shutter);
        list.change("iso", view.iso, plain.view.iso);
        list.change("exposure-lock", view.exposure_lock, plain.view.exposure_lock);
        list.change("exposure", view.exposure_stops, plain.view.exposure_stops);
        let overlay = |shown: Option<Overlay>| shown.map_or("none", |shown| name_of(&Overlay::NAMES, &shown));
        list.change("overlay", overlay(view.overlay), overlay(plain.view.overlay));
        list.change("tolerance", view.tolerance, plain.view.tolerance);

        list.change("jitter", estimator.jitter, plain.estimator.jitter);
        list.change("max-bounces", estimator.max_bounces, scene.max_bounces);
        let sampler = |sampler| name_of(&Sampler::NAMES, &sampler);
        list.change("sampler", sampler(estimator.sampler), sampler(plain.estimator.sampler));
        list.change("noise-threshold", estimator.noise_threshold, plain.estimator.noise_threshold);
        list.change("seed", estimator.seed, plain.estimator.seed);
        list.0
    }

    /// The same as a line for a shell.
    pub fn command_line(&self, output: &str) -> String {
        let quoted = |word: &String| {
            let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=,:+".contains(letter);
            if word.chars().all(plain) && !word.is_empty() {
                word.clone()
            } else {
                format!("'{}'", word.replace('\'', r"'\''"))
            }
        };
        let words: Vec<String> = self.arguments().iter().map(quoted).collect();
        format!("thinlens render {} -o {output}", words.join(" "))
    }
}

struct Arguments(Vec<String>);

impl Arguments {
    fn push(&mut self, name: &str, value: impl std::fmt::Display) {
        self.0.push(format!("--{name}={value}"));
    }

    fn change<T: PartialEq + std::fmt::Display>(&mut self, name: &str, value: T, of_scene: T) {
        if value != of_scene {
            self.push(name, value);
        }
    }

    fn vector(&mut self, name: &str, value: DVec3, of_scene: DVec3) {
        if value != of_scene {
            self.push(name, format!("{},{},{}", value.x, value.y, value.z));
        }
    }
}

/// What a value is called on the command line and in scene files.
pub(super) fn name_of<T: PartialEq>(names: &[(&'static str, T)], value: &T) -> &'static str {
    names.iter().find(|(_, named)| named == value).map_or("", |(name, _)| name)
}
