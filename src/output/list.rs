//! What there is to choose from, on standard output.

use super::say;
use crate::error::{Error, Result};
use crate::scene::BUILTINS;
use crate::vulkan::Instance;

/// Prints the built-in scenes, a line each.
///
/// # Errors
/// [`Error::Output`].
pub fn list_scenes() -> Result<()> {
    for scene in BUILTINS {
        say(&format!("{:16} {}", scene.name, scene.about))?;
    }
    Ok(())
}

/// Prints the system's devices, a line each.
///
/// # Errors
/// [`Error::NoLoader`], or [`Error::NoDevice`] where there is none.
pub fn list_devices() -> Result<()> {
    let devices = Instance::new(false, None)?.devices(None)?;
    if devices.is_empty() {
        return Err(Error::NoDevice("no driver is installed".into()));
    }
    for device in devices {
        let unusable =
            device.unusable.map_or_else(String::new, |reason| format!(", cannot be used: {reason}"));
        let uuid = device.uuid.map_or_else(String::new, |uuid| format!(", UUID {uuid}"));
        say(&format!(
            "{}  {} ({}, {}{uuid}{unusable})",
            device.index, device.name, device.kind, device.driver
        ))?;
    }
    Ok(())
}
