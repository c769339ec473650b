//! What `--stats` writes.

use crate::error::Result;
use crate::pending_file::PendingFile;
use serde::Serialize;

/// Figures of a finished picture.
#[derive(Debug, Clone, Serialize)]
pub struct Stats {
    /// The scene's name.
    pub scene: String,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Scene units.
    pub lens_diameter: f32,
    /// Scene units, along the axis.
    pub focal_distance: f32,
    /// Samples traced for each pixel, or for those that went on longest where pixels stop by themselves.
    pub samples_per_pixel: u32,
    /// Samples traced for a pixel on average.
    pub mean_samples_per_pixel: f64,
    /// Samples traced over all pixels.
    pub samples: u64,
    /// Rays traced, shadow rays among them.
    pub rays: u64,
    /// Samples that were not averaged in: not finite, or given up.
    pub rejected_samples: u64,
    /// Wall-clock time of the rendering, without start-up and file.
    pub seconds: f64,
    /// Millions of samples a second of that time.
    pub msamples_per_second: f64,
    /// The device's time for the longest of the submissions, which are cut to take about a tenth of a second.
    pub longest_submission_seconds: f64,
    /// The device's name.
    pub device: String,
    /// The driver's name and version.
    pub driver: String,
}

impl Stats {
    /// Writes them as one JSON object.
    ///
    /// # Errors
    /// [`crate::error::Error::Write`].
    pub fn write(&self, file: PendingFile) -> Result<()> {
        let mut json = serde_json::to_string_pretty(self).expect("plain numbers and strings are JSON");
        json.push('\n');
        file.write(json.as_bytes())
    }
}
