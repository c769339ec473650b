//! Vulkan through `ash`: the only unsafe code of the crate, and no knowledge of scenes.
//!
//! A child holds its parent by `Arc` (`Instance <- Device <- Buffer, Image, ...`), so a handle is never destroyed
//! after what it was made from. Commands do not hold the buffers, images and pipelines that they use: whoever records
//! commands keeps those until the device has run them. The renderer and the window wait for the device before they
//! replace one.
//!
//! # Errors
//! Every `Result` of this module can be [`Error::Vulkan`], which names the call that failed and Vulkan's answer (a lost
//! device, for example), or [`Error::Memory`]. Functions say only which other errors they give.
#![allow(unsafe_code, reason = "this module wraps the driver's C interface")]

mod buffer;
mod command;
mod device;
mod health;
mod image;
mod instance;
mod limits;
mod physical;
mod pipeline;
mod pipeline_cache;
mod reflection;
mod surface;
mod swapchain;
mod texture;
mod timing;
mod upload;
mod validation;

pub use buffer::{Buffer, Residence, TexelBuffer, UniformBuffer};
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
pub use texture::Texture;
pub use timing::Timer;

use crate::error::{Error, Result};
use ash::vk;
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Guards the loader's lists of instances, drivers and devices, which all threads share. To name an object, the loader
/// walks through all of them, those of other instances too, without a lock of its own (seen in 1.4.309). Meanwhile no
/// other thread may create or destroy an instance or a device.
static LOADER: RwLock<()> = RwLock::new(());

/// Held while something is looked up in the loader's lists.
fn loader_stays() -> RwLockReadGuard<'static, ()> {
    LOADER.read().unwrap_or_else(PoisonError::into_inner)
}

/// Held while the loader's lists change: around creating and destroying instances and devices, and around listing the
/// devices, which unloads drivers that have none.
fn loader_changes() -> RwLockWriteGuard<'static, ()> {
    LOADER.write().unwrap_or_else(PoisonError::into_inner)
}

/// Turns Vulkan's answer into an error that names what was tried.
fn check<T>(what: &'static str, result: Result<T, vk::Result>) -> Result<T> {
    result.map_err(|result| match result {
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
            Error::Memory { what }
        }
        result => Error::Vulkan { what, result },
    })
}
