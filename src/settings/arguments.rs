//! Settings as the arguments of the command line that renders them: for people to copy, and for pictures to
//! carry.

use super::{Sampler, Settings};
use crate::scene::{BUILTINS, CameraModel, Overlay};
use glam::DVec3;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

impl Settings {
    /// What follows `thinlens render` to get this picture again, but for where to: the scene as it was named,
    /// size and samples, and what is not as the scene has it. Numbers have as many digits as they need to come
    /// back the same.
    pub fn arguments(&self) -> Vec<OsString> {
        self.arguments_with(Path::to_path_buf)
    }

    /// Likewise, to be used in another folder: files have whole paths.
    pub fn arguments_from_anywhere(&self) -> Vec<OsString> {
        self.arguments_with(|file| std::path::absolute(file).unwrap_or_else(|_| file.to_path_buf()))
    }

    fn arguments_with(&self, named: impl Fn(&Path) -> PathBuf) -> Vec<OsString> {
        let (estimator, view) = (&self.estimator, &self.view);
        let scene = &*estimator.scene;
        let plain = Self::of_scene(estimator.scene.clone());
        let mut list = Arguments(vec![scene_argument(&scene.source, &named)]);
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
            let image = aperture.image.as_ref().map_or("none".into(), |image| named(&image.file));
            let mut argument = OsString::from("--aperture-image=");
            argument.push(image);
            list.0.push(argument);
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
        let words: Vec<String> = self.arguments().iter().map(|word| quoted(word)).collect();
        format!("thinlens render {} -o {output}", words.join(" "))
    }
}

struct Arguments(Vec<OsString>);

impl Arguments {
    fn push(&mut self, name: &str, value: impl std::fmt::Display) {
        self.0.push(format!("--{name}={value}").into());
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

/// A scene as an argument. A name that begins with a dash would be taken for an option.
fn scene_argument(source: &Path, named: impl Fn(&Path) -> PathBuf) -> OsString {
    let builtin = BUILTINS.iter().any(|builtin| source == Path::new(builtin.name));
    let path = if builtin { source.to_path_buf() } else { named(source) };
    let dash = path.as_os_str().as_encoded_bytes().starts_with(b"-");
    if dash { Path::new(".").join(path).into() } else { path.into() }
}

/// A word as a shell reads it. Bytes that are no text are written as bash, zsh and POSIX's shell of 2024 do.
pub fn quoted(word: &OsStr) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=,:+".contains(letter);
    match word.to_str() {
        Some(text) if text.chars().all(plain) && !text.is_empty() => text.into(),
        Some(text) if !text.chars().any(char::is_control) => format!("'{}'", text.replace('\'', r"'\''")),
        _ => {
            let bytes = |bytes: &[u8]| bytes.iter().map(|byte| format!("\\x{byte:02x}")).collect::<String>();
            let letter = |letter: char| match letter {
                '\'' | '\\' => format!("\\{letter}"),
                control if control.is_control() => bytes(control.encode_utf8(&mut [0; 4]).as_bytes()),
                plain => plain.into(),
            };
            let chunks = word.as_encoded_bytes().utf8_chunks();
            let text = chunks
                .map(|chunk| chunk.valid().chars().map(letter).collect::<String>() + &bytes(chunk.invalid()));
            format!("$'{}'", text.collect::<String>())
        }
    }
}

/// What a value is called on the command line and in scene files.
pub(super) fn name_of<T: PartialEq>(names: &[(&'static str, T)], value: &T) -> &'static str {
    names.iter().find(|(_, named)| named == value).map_or("", |(name, _)| name)
}
