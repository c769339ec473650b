//! Pictures to files: the headless renderer.

mod drawing;
mod file;
mod format;
mod headless;
mod list;
mod origin;
mod progress;
mod sheet;
mod stats;
mod sweep;

pub use drawing::{DrawingJob, draw_optics, save_drawing};
pub use file::{save, save_scene, write_exr, write_picture, write_png};
pub use format::PictureFormat;
pub use headless::{Job, render, render_instead};
pub use list::{list_devices, list_scenes};
pub use origin::Origin;
pub use progress::{load, loading_line};
pub use stats::Stats;
pub use sweep::{SweepJob, sweep};

use crate::error::{Error, Result};
use std::io::Write;

/// Prints a line of the program's answer. A closed pipe or a full disk is an error, not a panic.
///
/// # Errors
/// [`Error::Output`].
pub fn say(line: &str) -> Result<()> {
    writeln!(std::io::stdout(), "{line}").map_err(Error::Output)
}
