//! How far a rendering is: a bar on a terminal, plain lines elsewhere.

use crate::error::Result;
use crate::interrupt::Leftover;
use crate::scene::Triangle;
use crate::settings::Settings;
use indicatif::{HumanCount, ProgressBar, ProgressStyle};
use std::convert::Infallible;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// The time between plain lines.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// Loading that takes no longer than this is not mentioned.
const LOADING_UNSAID: Duration = Duration::from_millis(500);

/// Loads a scene, and says so on standard error if it took a while.
///
/// # Errors
/// Those of `load`.
pub fn load(quiet: bool, load: impl FnOnce() -> Result<Settings>) -> Result<Settings> {
    let started = Instant::now();
    let settings = load()?;
    let scene = &settings.estimator.scene;
    let line = loading_line(&scene.name, scene.of_kind::<Triangle>().count() as u64, started.elapsed());
    if let Some(line) = line.filter(|_| !quiet) {
        eprintln!("{line}");
    }
    Ok(settings)
}

/// The line about a scene that took so long to load, if it deserves one.
pub fn loading_line(scene: &str, triangles: u64, took: Duration) -> Option<String> {
    let seconds = took.as_secs_f64();
    (took >= LOADING_UNSAID)
        .then(|| format!("{scene}: {} triangles read in {seconds:.1} s", HumanCount(triangles)))
}

/// Shows progress on standard error.
pub(super) struct ProgressDisplay {
    /// The bar, which is removed from the terminal when a signal ends the program.
    bar: Option<(ProgressBar, Leftover)>,
    target: u32,
    pixels: u64,
    started: Instant,
    last_line: Instant,
    quiet: bool,
}

impl ProgressDisplay {
    pub(super) fn new(target: u32, pixels: u64, quiet: bool) -> Self {
        let bar = (!quiet && std::io::stderr().is_terminal()).then(|| {
            let style =
                ProgressStyle::with_template("{bar:32} {pos}/{len} samples per pixel, {msg}, {eta} left")
                    .expect("the template is valid");
            let bar = ProgressBar::new(u64::from(target)).with_style(style);
            let of_signal = bar.clone();
            let Ok(bar) = Leftover::of(|| Ok::<_, Infallible>(bar), move || of_signal.finish_and_clear());
            bar
        });
        Self { bar, target, pixels, started: Instant::now(), last_line: Instant::now(), quiet }
    }

    pub(super) fn show(&mut self, samples: u32, traced: u64) {
        let rate = traced as f64 / self.started.elapsed().as_secs_f64();
        let message = format!("{:.1} M samples/s", rate / 1e6);
        if let Some((bar, _)) = &self.bar {
            bar.set_position(u64::from(samples));
            bar.set_message(message);
        } else if !self.quiet && self.last_line.elapsed() >= LINE_EVERY {
            self.last_line = Instant::now();
            let all = u64::from(self.target) * self.pixels;
            let left = all.saturating_sub(traced) as f64 / rate;
            eprintln!("{samples}/{} samples per pixel, {message}, {left:.0} s left", self.target);
        }
    }

    pub(super) fn finish(self) -> Duration {
        if let Some((bar, _)) = self.bar {
            bar.finish_and_clear();
        }
        self.started.elapsed()
    }
}
