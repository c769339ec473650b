//! Images: storage images, which stay in the layout GENERAL, and those that fragment shaders sample.

use super::buffer::{allocate, release};
use super::{Device, check};
use crate::error::Result;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;
use std::sync::Arc;

pub(super) const WHOLE: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

/// A two-dimensional image with its memory and view. A storage image must be cleared before its first use, with
/// [`super::Recording::clear`], which also gives it its layout.
pub struct Image {
    pub(super) raw: vk::Image,
    pub(super) view: vk::ImageView,
    extent: [u32; 2],
    bytes_per_pixel: u64,
    allocation: Option<Allocation>,
    device: Arc<Device>,
}

impl Image {
    /// An image of four f32 a pixel.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where the device has no images as wide or high.
    pub fn rgba32f(device: &Arc<Device>, name: &'static str, extent: [u32; 2]) -> Result<Self> {
        Self::storage(device, name, extent, vk::Format::R32G32B32A32_SFLOAT, 16)
    }

    /// An image of one f32 a pixel.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where the device has no images as wide or high.
    pub fn r32f(device: &Arc<Device>, name: &'static str, extent: [u32; 2]) -> Result<Self> {
        Self::storage(device, name, extent, vk::Format::R32_SFLOAT, 4)
    }

    /// An image of four bytes a pixel. What they encode is up to the shaders: the format converts nothing.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where the device has no images as wide or high.
    pub fn rgba8(device: &Arc<Device>, name: &'static str, extent: [u32; 2]) -> Result<Self> {
        Self::storage(device, name, extent, vk::Format::R8G8B8A8_UNORM, 4)
    }

    /// An image of four bytes a pixel that fragment shaders sample.
    pub(super) fn sampled(device: &Arc<Device>, name: &'static str, extent: [u32; 2]) -> Result<Self> {
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        Self::new(device, name, extent, vk::Format::R8G8B8A8_UNORM, 4, usage)
    }

    fn storage(
        device: &Arc<Device>,
        name: &'static str,
        extent: [u32; 2],
        format: vk::Format,
        bytes_per_pixel: u64,
    ) -> Result<Self> {
        let usage = vk::ImageUsageFlags::STORAGE
            | vk::ImageUsageFlags::TRANSFER_SRC
            | vk::ImageUsageFlags::TRANSFER_DST;
        Self::new(device, name, extent, format, bytes_per_pixel, usage)
    }

    fn new(
        device: &Arc<Device>,
        name: &'static str,
        extent: [u32; 2],
        format: vk::Format,
        bytes_per_pixel: u64,
        usage: vk::ImageUsageFlags,
    ) -> Result<Self> {
        device.limits.check_image(name, extent)?;
        let [width, height] = extent;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(usage);
        // SAFETY: the device is valid. The handle is owned by `image` before anything else can fail.
        let raw = check("creating an image", unsafe { device.raw.create_image(&info, None) })?;
        let mut image = Self {
            raw,
            view: vk::ImageView::null(),
            extent,
            bytes_per_pixel,
            allocation: None,
            device: Arc::clone(device),
        };
        // SAFETY: raw is an image of this device.
        let requirements = unsafe { device.raw.get_image_memory_requirements(raw) };
        let allocation = allocate(device, name, requirements, MemoryLocation::GpuOnly, false)?;
        // SAFETY: the memory was allocated for this image's requirements and is bound once.
        let bound = unsafe { device.raw.bind_image_memory(raw, allocation.memory(), allocation.offset()) };
        image.allocation = Some(allocation);
        check("binding an image's memory", bound)?;
        let info = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(WHOLE);
        // SAFETY: the image is bound and has this format.
        image.view = check("creating an image view", unsafe { device.raw.create_image_view(&info, None) })?;
        device.set_name(raw, name);
        Ok(image)
    }

    /// Width and height in pixels.
    pub fn extent(&self) -> [u32; 2] {
        self.extent
    }

    /// How many bytes its pixels take in a buffer, without padding.
    pub fn byte_len(&self) -> u64 {
        u64::from(self.extent[0]) * u64::from(self.extent[1]) * self.bytes_per_pixel
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: whoever records commands with the image holds it until they are done; a null
        // view is allowed.
        unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.raw, None);
        }
        release(&self.device, self.allocation.take());
    }
}
