//! What the viewer remembers from one run to the next.

use crate::pending_file::PendingFile;
use crate::settings::saved_names;
use etcetera::BaseStrategy;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;

/// The state of the viewer when it was closed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Memory {
    /// The window's size in physical pixels, for each scale of the display in percent: the same window may stand on
    /// displays of different scales.
    pub sizes: BTreeMap<u32, [u32; 2]>,
    /// The settings, as [`crate::settings::Settings::arguments`] returns them. Empty before the first run.
    #[serde(with = "saved_names")]
    pub arguments: Vec<OsString>,
    /// Files that were opened, with the latest first.
    #[serde(with = "saved_names")]
    pub recent: Vec<PathBuf>,
    /// Whether the drawing of the optics was open.
    pub optics: bool,
    /// The height of the strip with the drawing of the optics in points.
    pub optics_height: Option<f32>,
    /// The width of the panel in points.
    pub panel_width: Option<f32>,
    /// The sections of the panel that were opened or closed, and whether they are open.
    pub folds: BTreeMap<String, bool>,
    /// Whether the focal distance stays as it is while the camera moves, and does not follow what was focused on.
    pub focus_stays: bool,
    /// The size of the picture that is rendered to a file, if it is not that of the shown picture.
    pub output: Option<[u32; 2]>,
    /// Whether the user has read the greeting, and then done something.
    pub greeted: bool,
}

impl Memory {
    /// Reads the memory from the user's folder. It is empty if there is no folder or the file is damaged.
    pub fn load() -> Self {
        let Some(path) = file("viewer.json") else {
            return Self::default();
        };
        let Ok(text) = std::fs::read_to_string(&path) else {
            return Self::default();
        };
        serde_json::from_str(&text).unwrap_or_else(|error| {
            log::warn!("{}: {error}; starting as if for the first time", path.display());
            Self::default()
        })
    }

    /// Writes the memory to the user's folder, if there is one.
    pub(super) fn save(&self) {
        let Some(path) = file("viewer.json") else {
            return;
        };
        let text = serde_json::to_string_pretty(self).expect("names and numbers are JSON");
        let written = PendingFile::create(&path).and_then(|file| file.write(text.as_bytes()));
        if let Err(error) = written {
            log::warn!("{error}; the settings are not remembered");
        }
    }
}

/// The path of one of the viewer's own files. Creates the folder if it does not exist.
pub(super) fn file(name: &str) -> Option<PathBuf> {
    let folders = etcetera::base_strategy::choose_native_strategy().ok()?;
    let folder = folders.state_dir().unwrap_or_else(|| folders.data_dir()).join("thinlens");
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder.join(name))
}
