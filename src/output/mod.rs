//! Pictures to files: the headless renderer.

mod file;
mod headless;
mod progress;
mod stats;

pub use file::{PictureFormat, write_exr, write_png, write_whole};
pub use headless::{Job, list_devices, render};
pub use stats::Stats;
