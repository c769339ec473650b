//! Pictures to files: the headless renderer.

mod file;
mod headless;
mod list;
mod progress;
mod stats;

pub use file::{PictureFormat, write_exr, write_png, write_whole};
pub use headless::{Job, render, render_instead};
pub use list::{list_devices, list_scenes};
pub use stats::Stats;
