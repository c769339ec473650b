//! The arguments that say what to render: a scene, and changes to its settings.

use crate::error::Result;
use crate::scene::{self, BUILTINS, SceneRef};
use crate::settings::{Changes, DEFAULT_SAMPLES, Role, Setting, Settings, Value, list};
use clap::{Arg, Args};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The default number of samples per pixel in the viewer.
const DEFAULT_VIEW_SAMPLES: u32 = 256;

/// The size and the samples of pictures that verify a device. They are small, because the oracle is slow.
const PROOF_SIZE: [u32; 2] = [128, 96];
const PROOF_SAMPLES: u32 = 16;

/// What to render: a scene, and changes to its settings.
#[derive(Debug, Args, Default)]
pub struct SettingsArgs {
    /// A built-in scene (see thinlens scenes), .toml or .obj file [default: version-4]
    scene: Option<PathBuf>,
    #[command(flatten)]
    changes: Changes,
}

impl SettingsArgs {
    /// The settings for a picture in a file.
    ///
    /// # Errors
    /// Those of loading a scene, or [`crate::error::Error::OutOfRange`].
    pub fn for_render(&self) -> Result<Settings> {
        self.resolve(DEFAULT_SAMPLES)
    }

    /// The settings for a picture in a file, which are changes to the arguments of another picture.
    ///
    /// # Errors
    /// The errors of parsing an argument or of loading the scene.
    pub fn of_picture(&self, arguments: &[OsString]) -> Result<Settings> {
        let mut settings = Settings::of_arguments(arguments)?;
        self.changes.apply(&mut settings)?;
        Ok(settings)
    }

    /// Whether neither a scene nor an option was given.
    pub fn is_plain(&self) -> bool {
        self.scene.is_none() && self.changes.is_empty()
    }

    /// The settings that the viewer starts with.
    ///
    /// # Errors
    /// Those of loading a scene, or [`crate::error::Error::OutOfRange`].
    pub fn for_viewer(&self) -> Result<Settings> {
        self.resolve(DEFAULT_VIEW_SAMPLES)
    }

    /// The settings of small pictures to verify a device with: of the scene that was named, or of each built-in scene.
    ///
    /// # Errors
    /// Those of loading a scene, or [`crate::error::Error::OutOfRange`].
    pub fn for_verify(&self) -> Result<Vec<Settings>> {
        let named = self.scene.as_deref().map(|name| vec![name]);
        let names = named.unwrap_or_else(|| BUILTINS.iter().map(|builtin| Path::new(builtin.name)).collect());
        let proof = |name: &Path| {
            let mut settings = Settings::of_scene(SceneRef::new(scene::load(name)?));
            (settings.estimator.size, settings.samples) = (PROOF_SIZE, PROOF_SAMPLES);
            self.changes.apply(&mut settings)?;
            // Single samples are compared with the oracle, so no pixel may stop before the others.
            settings.estimator.noise_threshold = 0.0;
            Ok(settings)
        };
        names.into_iter().map(proof).collect()
    }

    /// The name of the scene as it was given.
    pub fn scene(&self) -> &Path {
        self.scene.as_deref().unwrap_or(Path::new(BUILTINS[0].name))
    }

    /// The size of the picture, if it was given.
    pub fn size(&self) -> Option<[u32; 2]> {
        match self.changes.get("size") {
            Some(Value::Size(size)) => Some(*size),
            _ => None,
        }
    }

    fn resolve(&self, samples: u32) -> Result<Settings> {
        let mut settings = Settings::of_scene(SceneRef::new(scene::load(self.scene())?));
        settings.samples = samples;
        self.changes.apply(&mut settings)?;
        Ok(settings)
    }
}

/// Hides the options of sampling from a command that renders no picture.
pub(super) fn without_sampling(option: Arg) -> Arg {
    hide(option, |setting| setting.is_of_sampling())
}

/// Hides options from the command that verifies devices: it compares single samples before they are shown.
pub(super) fn for_verifying(option: Arg) -> Arg {
    let option = match option.get_id().as_str() {
        "scene" => option.help(
            "A built-in scene (see thinlens scenes), .toml or .obj file [default: every built-in scene]",
        ),
        "samples" => option.help("The number of antialiasing points per pixel [default: 16]"),
        "size" => option.help("The size of the pictures in pixels [default: 128x96]"),
        _ => option,
    };
    hide(option, |setting| setting.role == Role::View || setting.flag == "noise-threshold")
}

/// Hides the options of these settings from the help of a command.
fn hide(option: Arg, such: impl Fn(&Setting) -> bool) -> Arg {
    let setting = list::all().find(|setting| option.get_id() == setting.flag);
    let hidden = setting.is_some_and(such);
    option.hide(hidden)
}
