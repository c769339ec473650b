//! Buffers.

use super::{Device, check};
use crate::error::{Error, Result};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::sync::Arc;

/// Where a buffer lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Residence {
    /// On the device; the host cannot see it.
    Device,
    /// Where the host can read and write it.
    Host,
    /// Where the host can read and write it, and shaders cannot: data passes through it on its way.
    Staging,
}

/// A buffer with its memory.
pub struct Buffer {
    pub(super) raw: vk::Buffer,
    allocation: Option<Allocation>,
    pub(super) device: Arc<Device>,
}

/// A buffer that shaders read as texels of four u32. On Mesa's software device that is several times
/// faster than a storage buffer where the index differs from invocation to invocation.
pub struct TexelBuffer {
    pub(super) view: vk::BufferView,
    pub(super) buffer: Buffer,
}

/// A buffer that shaders read at indices that are the same for all invocations. On GPUs this is faster than a storage
/// buffer, but there is room for little.
pub struct UniformBuffer {
    pub(super) buffer: Buffer,
}

impl Buffer {
    /// A buffer of at least `size` bytes, its contents undefined.
    ///
    /// # Errors
    /// [`Error::Limit`] where the device has no buffers as large.
    pub fn new(device: &Arc<Device>, name: &'static str, size: u64, residence: Residence) -> Result<Self> {
        let mut usage = vk::BufferUsageFlags::empty();
        if residence != Residence::Staging {
            device.limits.check_storage(name, size)?;
            usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        }
        Self::with_usage(device, name, size, residence, usage)
    }

    fn with_usage(
        device: &Arc<Device>,
        name: &'static str,
        size: u64,
        residence: Residence,
        usage: vk::BufferUsageFlags,
    ) -> Result<Self> {
        let size = size.max(16); // Vulkan has no empty buffers, and a scene may have no triangles.
        device.limits.check_buffer(name, size)?;
        let copies = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
        let info = vk::BufferCreateInfo::default().size(size).usage(usage | copies);
        // SAFETY: the device is valid. The handle is owned by `buffer` before anything else can fail.
        let raw = check("creating a buffer", unsafe { device.raw.create_buffer(&info, None) })?;
        let mut buffer = Self { raw, allocation: None, device: Arc::clone(device) };
        // SAFETY: raw is a buffer of this device.
        let requirements = unsafe { device.raw.get_buffer_memory_requirements(raw) };
        let location = match residence {
            Residence::Device => MemoryLocation::GpuOnly,
            Residence::Host | Residence::Staging => MemoryLocation::GpuToCpu,
        };
        let allocation = allocate(device, name, requirements, location, true)?;
        // SAFETY: the memory was allocated for this buffer's requirements and is bound once.
        let bound = unsafe { device.raw.bind_buffer_memory(raw, allocation.memory(), allocation.offset()) };
        buffer.allocation = Some(allocation);
        check("binding a buffer's memory", bound)?;
        device.set_name(raw, name);
        Ok(buffer)
    }

    /// Writes the start of a buffer that the host sees and the device is not using.
    pub fn write(&mut self, bytes: &[u8]) {
        let mapped = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        mapped.expect("a host buffer is mapped")[..bytes.len()].copy_from_slice(bytes);
    }

    /// What the host sees of a buffer that the device is not writing.
    pub fn bytes(&self) -> &[u8] {
        let mapped = self.allocation.as_ref().and_then(Allocation::mapped_slice);
        mapped.expect("a host buffer is mapped")
    }
}

impl TexelBuffer {
    /// A buffer on the device of at least `size` bytes, in texels of 16, its contents undefined.
    ///
    /// # Errors
    /// [`Error::Limit`] where it has more texels than the device can read.
    pub(super) fn new(device: &Arc<Device>, name: &'static str, size: u64) -> Result<Self> {
        // The view has whole texels only.
        let size = size.next_multiple_of(16);
        device.limits.check_texels(name, size)?;
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
        let buffer = Buffer::with_usage(device, name, size, Residence::Device, usage)?;
        let info = vk::BufferViewCreateInfo::default()
            .buffer(buffer.raw)
            .format(vk::Format::R32G32B32A32_UINT)
            .range(vk::WHOLE_SIZE);
        // SAFETY: the buffer is of this device, and every Vulkan device can read this format so.
        let view = unsafe { device.raw.create_buffer_view(&info, None) };
        Ok(Self { view: check("creating a buffer view", view)?, buffer })
    }
}

impl UniformBuffer {
    /// A buffer on the device of at least `size` bytes, its contents undefined.
    ///
    /// # Errors
    /// [`Error::Limit`] where it is larger than the device can bind.
    pub(super) fn new(device: &Arc<Device>, name: &'static str, size: u64) -> Result<Self> {
        device.limits.check_uniform(name, size)?;
        let usage = vk::BufferUsageFlags::UNIFORM_BUFFER;
        Ok(Self { buffer: Buffer::with_usage(device, name, size, Residence::Device, usage)? })
    }
}

impl Drop for TexelBuffer {
    fn drop(&mut self) {
        // SAFETY: whoever records commands with the buffer holds it until they are done.
        unsafe { self.buffer.device.raw.destroy_buffer_view(self.view, None) };
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: whoever records commands with the buffer holds it until they are done.
        unsafe { self.device.raw.destroy_buffer(self.raw, None) };
        release(&self.device, self.allocation.take());
    }
}

pub(super) fn allocate(
    device: &Device,
    name: &'static str,
    requirements: vk::MemoryRequirements,
    location: MemoryLocation,
    linear: bool,
) -> Result<Allocation> {
    let description = AllocationCreateDesc {
        name,
        requirements,
        location,
        linear,
        allocation_scheme: AllocationScheme::GpuAllocatorManaged,
    };
    device.allocator().allocate(&description).map_err(|error| {
        log::debug!("allocating {name}: {error}");
        Error::Memory { what: name }
    })
}

pub(super) fn release(device: &Device, allocation: Option<Allocation>) {
    if let Some(allocation) = allocation
        && let Err(error) = device.allocator().free(allocation)
    {
        log::error!("freeing device memory: {error}");
    }
}
