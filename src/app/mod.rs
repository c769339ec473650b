//! The viewer: a window that shows the film as it fills, and a panel that changes what is rendered.

mod area;
mod clipboard;
mod content;
mod dialog;
mod display;
mod focus;
mod graphics;
mod guide;
mod history;
mod keys;
mod lesson;
mod loader;
mod memory;
mod message;
mod navigate;
mod optics;
mod over_picture;
mod panel;
mod render_job;
mod save_as;
pub mod telemetry;
mod theme;
mod thumbnails;
mod typing;
mod ui;
mod window;
mod words;
mod zoom_lock;

pub use dialog::DialogLog;
pub use memory::Memory;

use crate::error::{Error, Result};
use crate::settings::{DeviceChoice, Settings};

/// What the viewer starts with.
#[derive(Debug, Clone)]
pub struct Options {
    /// What to render. The picture's size follows the window's.
    pub settings: Settings,
    /// The settings that the Reset button restores.
    pub initial: Settings,
    /// The picture's size in physical pixels, if one was asked for.
    pub size: Option<[u32; 2]>,
    /// What the viewer remembers of its last run.
    pub memory: Memory,
    /// A message to show at the start, if there is one.
    pub message: Option<String>,
    /// The device to render on.
    pub device: DeviceChoice,
}

/// Opens the viewer, and returns once it is closed.
///
/// # Errors
/// [`Error::NoDisplay`] if no window can be opened at all; otherwise the error that ended the viewer.
pub fn run(options: Options) -> Result<()> {
    let event_loop = display::event_loop().map_err(|error| Error::NoDisplay(reason(&error)))?;
    let mut viewer = window::Viewer::new(options, event_loop.create_proxy());
    let ended = event_loop.run_app(&mut viewer);
    viewer.finish()?;
    ended.map_err(|error| Error::Window(reason(&error)))
}

/// The text of an error, without the source file that winit puts in front of it.
fn reason(error: &dyn std::fmt::Display) -> String {
    let text = error.to_string().replace('\n', " ");
    text.rsplit(": ").next().unwrap_or_default().trim_end_matches('.').to_owned()
}
