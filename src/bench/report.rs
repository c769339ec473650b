//! The figures, as JSON and as a table.

use super::Spread;
use crate::vulkan::DeviceInfo;
use serde::Serialize;
use std::fmt::Write;

/// All figures.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// The device's name.
    pub device: String,
    /// The driver's name and version.
    pub driver: String,
    /// How often everything was measured.
    pub runs: u32,
    /// The figures of each scene.
    pub scenes: Vec<SceneReport>,
}

/// Figures of a scene.
#[derive(Debug, Clone, Serialize)]
pub struct SceneReport {
    /// Its name.
    pub scene: String,
    /// Width and height in pixels of the pictures that throughput was measured with.
    pub size: [u32; 2],
    /// Samples per pixel of these.
    pub samples: u32,
    /// Seconds to a picture of one sample per pixel.
    pub first_picture: Change,
    /// Width and height in pixels of the pictures that the error was measured with.
    pub error_size: [u32; 2],
    /// Samples per pixel of the picture that these were compared with.
    pub reference_samples: u32,
    /// The figures of each way to render.
    pub variants: Vec<VariantReport>,
}

/// Wall-clock seconds to a picture of one sample per pixel, resolved and read back.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Change {
    /// From before there is a Vulkan instance.
    pub from_start: Spread,
    /// From another focal distance.
    pub from_change: Spread,
}

/// Figures of a way to render.
#[derive(Debug, Clone, Serialize)]
pub struct VariantReport {
    /// Its name.
    pub variant: String,
    /// Millions of samples a second of wall-clock time.
    pub msamples_per_second: Spread,
    /// Millions of samples a second of the device's time.
    pub msamples_per_device_second: Spread,
    /// Millions of rays a second of wall-clock time, shadow rays among them.
    pub mrays_per_second: Spread,
    /// How long the device was kept busy at once.
    pub submissions: Submissions,
    /// The error after 1, 2, 4, ... samples per pixel.
    pub convergence: Vec<Convergence>,
}

/// Submissions of all runs.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Submissions {
    /// How many.
    pub count: usize,
    /// By the device's clock.
    pub device_seconds: Spread,
}

/// The error after so many samples.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Convergence {
    /// Asked for per pixel.
    pub samples: u32,
    /// Traced per pixel, on average.
    pub samples_traced: Spread,
    /// Wall-clock time.
    pub seconds: Spread,
    /// To the converged picture.
    pub rmse: Spread,
}

impl Report {
    pub(super) fn new(device: &DeviceInfo, runs: u32) -> Self {
        Self { device: device.name.clone(), driver: device.driver.clone(), runs, scenes: Vec::new() }
    }

    pub(super) fn heading(&self) -> String {
        format!("{} ({}), medians of {} runs, quartiles in brackets", self.device, self.driver, self.runs)
    }

    /// As one JSON object.
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain numbers and strings are JSON") + "\n"
    }
}

impl SceneReport {
    pub(super) fn table(&self) -> String {
        let mut text = String::new();
        let [[width, height], [error_width, error_height]] = [self.size, self.error_size];
        // A string takes whatever is written to it.
        let mut line = |line: String| writeln!(text, "{line}").unwrap_or_default();
        line(format!("\n{}, {width}x{height}, {} samples per pixel", self.scene, self.samples));
        let Change { from_start, from_change } = &self.first_picture;
        line(format!(
            "  first picture    from start {} ms, from a change {} ms",
            brackets(from_start, 1e3),
            brackets(from_change, 1e3)
        ));
        line(format!(
            "  {:12} {:>22} {:>14} {:>22} {:>24}",
            "", "M samples/s", "device's", "M rays/s", "submission, ms (worst)"
        ));
        for variant in &self.variants {
            let busy = &variant.submissions.device_seconds;
            line(format!(
                "  {:12} {:>22} {:>14.1} {:>22} {:>24}",
                variant.variant,
                brackets(&variant.msamples_per_second, 1.0),
                variant.msamples_per_device_second.median,
                brackets(&variant.mrays_per_second, 1.0),
                format!("{:.1} ({:.1})", 1e3 * busy.median, 1e3 * busy.max),
            ));
        }
        line(format!(
            "  error at {error_width}x{error_height} to {} samples: RMSE, then the milliseconds it took",
            self.reference_samples
        ));
        let names = self.variants.iter().map(|variant| format!("{:>22}", variant.variant));
        line(format!("  {:>12}{}", "samples", names.collect::<String>()));
        for (row, first) in
            self.variants.first().map_or(&[][..], |first| &first.convergence).iter().enumerate()
        {
            let cells = self.variants.iter().map(|variant| {
                let Convergence { rmse, seconds, .. } = &variant.convergence[row];
                format!("{:>13.6} {:>8.1}", rmse.median, 1e3 * seconds.median)
            });
            line(format!("  {:>12}{}", first.samples, cells.collect::<String>()));
        }
        text.trim_end().to_owned()
    }
}

/// Median and quartiles.
fn brackets(spread: &Spread, factor: f64) -> String {
    let [median, lower, upper] =
        [spread.median, spread.lower_quartile, spread.upper_quartile].map(|value| factor * value);
    format!("{median:.1} [{lower:.1}, {upper:.1}]")
}
