//! Buffers that are made with their contents, which are copied to the device at once.

use super::{Buffer, Commands, Device, Residence, TexelBuffer, UniformBuffer};
use crate::error::Result;
use std::sync::Arc;

impl Buffer {
    /// A buffer on the device that holds `data`.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where the device has no buffers as large.
    pub fn upload<T: bytemuck::NoUninit>(
        device: &Arc<Device>,
        name: &'static str,
        data: &[T],
    ) -> Result<Self> {
        let buffer = Self::new(device, name, size_of_val(data) as u64, Residence::Device)?;
        fill(&buffer, bytemuck::cast_slice(data))?;
        Ok(buffer)
    }
}

impl TexelBuffer {
    /// A buffer on the device that holds `data`, in texels of 16 bytes.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where it has more texels than the device can read.
    pub fn upload<T: bytemuck::NoUninit>(
        device: &Arc<Device>,
        name: &'static str,
        data: &[T],
    ) -> Result<Self> {
        let texels = Self::new(device, name, size_of_val(data) as u64)?;
        fill(&texels.buffer, bytemuck::cast_slice(data))?;
        Ok(texels)
    }
}

impl UniformBuffer {
    /// A buffer on the device that holds `data`.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where it is larger than the device can bind.
    pub fn upload<T: bytemuck::NoUninit>(device: &Arc<Device>, name: &'static str, data: &T) -> Result<Self> {
        let uniform = Self::new(device, name, size_of_val(data) as u64)?;
        fill(&uniform.buffer, bytemuck::bytes_of(data))?;
        Ok(uniform)
    }
}

/// Copies `bytes` to the start of a buffer on the device that is not in use.
fn fill(buffer: &Buffer, bytes: &[u8]) -> Result<()> {
    if bytes.is_empty() {
        return Ok(());
    }
    let mut staging = Buffer::new(&buffer.device, "staging", bytes.len() as u64, Residence::Staging)?;
    staging.write(bytes);
    let mut commands = Commands::new(&buffer.device)?;
    let mut recording = commands.begin()?;
    recording.copy_buffer(&staging, buffer, bytes.len() as u64);
    recording.submit()?;
    commands.wait()
}
