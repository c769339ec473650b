//! Vulkan through `ash`: the only unsafe code of the crate, and no knowledge of scenes.
//!
//! Ownership goes from child to parent by `Arc` (`Instance <- Device <- Buffer, Image, ...`), so a
//! handle is never destroyed after what it came from. Every call into the driver goes through
//! `check`, which says what was tried. What a recording uses is held by whoever records, until
//! the commands are done; the renderer and the window do so by waiting before they replace it.
#![allow(unsafe_code, reason = "this module wraps the driver's C interface")]

mod buffer;
mod command;
mod device;
mod image;
mod instance;
mod limits;
mod physical;
mod pipeline;
mod pipeline_cache;
mod reflection;
mod surface;
mod swapchain;
mod timing;
mod upload;
mod validation;

pub use buffer::{Buffer, Residence, TexelBuffer};
pub use command::{Commands, Recording};
pub use device::Device;
pub use image::Image;
pub use instance::Instance;
pub use limits::{NEEDED, Traits};
pub use physical::DeviceInfo;
pub(crate) use pipeline::shader;
pub use pipeline::{Binding, BindingSet, ComputePipeline, Shader};
pub use reflection::{ResourceKind, ShaderInterface, StructLayout};
pub use surface::Surface;
pub use swapchain::{Acquired, AcquiredImage, FRAMES_IN_FLIGHT, Swapchain};
pub use timing::Timer;

use crate::error::{Error, Result};
use ash::vk;
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// The loader's lists of instances, drivers and devices, which all threads share. To name an object the loader
/// walks through all of them, those of other instances too, and does so without a lock of its own (seen in
/// 1.4.309): meanwhile no other thread may make or unmake any.
static LOADER: RwLock<()> = RwLock::new(());

/// While something is looked up in the loader's lists.
fn loader_stays() -> RwLockReadGuard<'static, ()> {
    LOADER.read().unwrap_or_else(PoisonError::into_inner)
}

/// While the loader's lists change: around making and unmaking instances and devices, and around listing the
/// devices, which unloads drivers that have none.
fn loader_changes() -> RwLockWriteGuard<'static, ()> {
    LOADER.write().unwrap_or_else(PoisonError::into_inner)
}

/// Names what failed.
fn check<T>(what: &'static str, result: Result<T, vk::Result>) -> Result<T> {
    result.map_err(|result| match result {
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
            Error::Memory { what }
        }
        result => Error::Vulkan { what, result },
    })
}
