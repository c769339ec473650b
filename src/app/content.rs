//! What a file holds that the viewer opens.

use crate::error::Result;
use crate::output::{Origin, PictureFormat};
use crate::scene::{self, SceneRef};
use crate::settings::Settings;
use std::path::Path;

/// The content of a file that was opened.
pub(super) enum Content {
    Scene(SceneRef),
    /// The settings of a picture.
    Picture(Box<Settings>),
}

impl Content {
    /// Reads a scene, a mesh, or the settings of a picture.
    pub(super) fn read(name: &Path) -> Result<Self> {
        match PictureFormat::of(name) {
            Some(_) => Origin::read(name)
                .and_then(|origin| Settings::of_arguments(&origin.arguments))
                .map(|settings| Self::Picture(Box::new(settings))),
            None => scene::load(name).map(|scene| Self::Scene(SceneRef::new(scene))),
        }
    }

    /// The settings that result when this replaces what is shown now.
    pub(super) fn settings(&self, now: &Settings) -> Settings {
        match self {
            Self::Scene(scene) => now.with_scene(scene.clone()),
            Self::Picture(settings) => {
                let mut settings = Settings::clone(settings);
                settings.estimator.size = now.estimator.size;
                settings
            }
        }
    }
}
