//! Converts settings to the arguments of a command line that renders them, and back. Users copy them, and saved
//! pictures store them.

use super::setting::NONE;
use super::{Changes, Settings, Value, list};
use crate::error::{Error, Result};
use crate::scene::{self, BUILTINS, SceneRef, Stage};
use clap::{Arg, Args};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

impl Settings {
    /// The arguments after `thinlens render`, without `-o`, that render this picture again: the name of the scene, the
    /// size, the samples, and every setting that differs from the scene's.
    pub fn arguments(&self) -> Vec<OsString> {
        self.arguments_with(Path::to_path_buf)
    }

    /// The arguments that [`Self::arguments`] returns, but with absolute paths, so that they work in every folder.
    pub fn arguments_from_anywhere(&self) -> Vec<OsString> {
        self.arguments_with(|file| std::path::absolute(file).unwrap_or_else(|_| file.to_path_buf()))
    }

    fn arguments_with(&self, named: impl Fn(&Path) -> PathBuf) -> Vec<OsString> {
        let scene = &self.estimator.scene;
        let mut plain = Self::of_scene(scene.clone());
        plain.estimator.stage = Stage::default();
        let mut arguments = vec![scene_argument(&scene.source, &named)];
        for setting in list::own() {
            let value = setting.get(self);
            // Size and samples are always written, because their defaults depend on where the picture is rendered.
            let always = ["size", "samples"].contains(&setting.flag);
            if always || value != setting.get(&plain) {
                let mut argument = OsString::from(format!("--{}=", setting.flag));
                argument.push(text(&value, &named));
                arguments.push(argument);
            }
        }
        arguments
    }

    /// The settings that such arguments describe.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if an argument does not parse, or the errors of loading the scene.
    pub fn of_arguments(arguments: &[OsString]) -> Result<Self> {
        let command = Changes::augment_args(clap::Command::new("picture").no_binary_name(true));
        let command = command.arg(Arg::new("scene").value_parser(clap::value_parser!(PathBuf)));
        let matches = command.try_get_matches_from(arguments).map_err(|error| {
            let text = error.to_string();
            let what = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
            Error::OutOfRange(format!("the saved settings cannot be used: {what}"))
        })?;
        let default = || PathBuf::from(BUILTINS[0].name);
        let name = matches.get_one::<PathBuf>("scene").cloned().unwrap_or_else(default);
        let mut settings = Self::of_scene(SceneRef::new(scene::load(name)?));
        Changes::of_matches(&matches).apply(&mut settings)?;
        Ok(settings)
    }

    /// The command that renders this picture again, as a line for a shell.
    pub fn command_line(&self, output: &str) -> String {
        let words: Vec<String> = self.arguments().iter().map(|word| quoted(word)).collect();
        format!("thinlens render {} -o {output}", words.join(" "))
    }
}

/// A value as the text of an option. A number has as many digits as it needs to be read back exactly.
fn text(value: &Value, named: impl Fn(&Path) -> PathBuf) -> OsString {
    match value {
        Value::Single(number) => number.to_string().into(),
        Value::Double(number) => number.to_string().into(),
        Value::Metres(number) => format!("{number}m").into(),
        Value::Whole(number) => number.to_string().into(),
        Value::Switch(is) => is.to_string().into(),
        Value::Vector(place) => format!("{},{},{}", place.x, place.y, place.z).into(),
        Value::Size([width, height]) => format!("{width}x{height}").into(),
        Value::Name(name) => name.into(),
        Value::Sensor(sensor) => sensor.to_string().into(),
        Value::Tolerance(tolerance) => tolerance.to_string().into(),
        Value::File(file) => file.as_deref().map_or(NONE.into(), |file| named(file).into()),
    }
}

/// A scene as an argument. A name that begins with a dash gets a folder, because it would be taken for an option.
fn scene_argument(source: &Path, named: impl Fn(&Path) -> PathBuf) -> OsString {
    let builtin = BUILTINS.iter().any(|builtin| source == Path::new(builtin.name));
    let path = if builtin { source.to_path_buf() } else { named(source) };
    let dash = path.as_os_str().as_encoded_bytes().starts_with(b"-");
    if dash { Path::new(".").join(path).into() } else { path.into() }
}

/// A word, quoted for a shell. Bytes that are not text are written in the syntax of bash, zsh and POSIX of 2024.
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
