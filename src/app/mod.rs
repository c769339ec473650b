//! The viewer: a window that shows the film as it fills, and a panel that changes what is rendered.

mod clipboard;
pub mod diagram;
mod display;
mod focus;
mod graphics;
mod history;
mod keys;
mod loader;
mod memory;
mod navigate;
mod panel;
mod save_as;
pub mod telemetry;
mod ui;
mod window;

pub use memory::Memory;

use crate::error::{Error, Result};
use crate::settings::{DeviceChoice, Settings};

/// What the viewer starts with.
#[derive(Debug, Clone)]
pub struct Options {
    /// What to render. The picture's size follows the window's.
    pub settings: Settings,
    /// What Reset goes back to.
    pub initial: Settings,
    /// The window's size in physical pixels, if one was asked for.
    pub size: Option<[u32; 2]>,
    /// What there was the last time.
    pub memory: Memory,
    /// What to tell the user at first.
    pub message: Option<String>,
    /// Where to render.
    pub device: DeviceChoice,
}

/// Opens the viewer and returns when it is closed.
///
/// # Errors
/// [`Error::NoDisplay`] where no window can be opened at all; otherwise whatever ended the viewer.
pub fn run(options: Options) -> Result<()> {
    let event_loop = display::event_loop().map_err(|error| Error::NoDisplay(reason(&error)))?;
    let mut viewer = window::Viewer::new(options, event_loop.create_proxy());
    let ended = event_loop.run_app(&mut viewer);
    viewer.finish()?;
    ended.map_err(|error| Error::Window(reason(&error)))
}

/// Without the source file that winit puts in front.
fn reason(error: &dyn std::fmt::Display) -> String {
    let text = error.to_string().replace('\n', " ");
    text.rsplit(": ").next().unwrap_or_default().trim_end_matches('.').to_owned()
}
