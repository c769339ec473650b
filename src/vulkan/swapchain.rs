//! The images that a window shows: acquiring, drawing, presenting.

use super::command::LAYER;
use super::image::WHOLE;
use super::surface::{NO_FORMAT, Surface, USAGE, format};
use super::{Device, Image, Recording, check};
use crate::error::{Error, Result};
use ash::{khr, vk};
use std::sync::Arc;
use std::time::Duration;

/// The images that the window shows, and the semaphores around them.
pub struct Swapchain {
    raw: vk::SwapchainKHR,
    loader: khr::swapchain::Device,
    images: Vec<vk::Image>,
    views: Vec<vk::ImageView>,
    /// Signalled when an image may be presented, one an image.
    rendered: Vec<vk::Semaphore>,
    /// Signalled when an image was acquired, one a frame in flight.
    acquired: [vk::Semaphore; FRAMES_IN_FLIGHT],
    next_acquire: usize,
    extent: [u32; 2],
    format: vk::Format,
    device: Arc<Device>,
    _surface: Arc<Surface>,
}

/// How many frames the host may be ahead of the device.
pub const FRAMES_IN_FLIGHT: usize = 2;

/// The answer to asking for the next image. Neither a stale swapchain nor a hidden window is an error.
pub enum Acquired {
    /// An image to draw to.
    Image(AcquiredImage),
    /// The window has changed: make another swapchain.
    Stale,
    /// No image is free yet, as when the window is hidden: try again later.
    NotReady,
}

/// How long to wait for an image: the window must stay able to answer.
const ACQUIRE_TIMEOUT: Duration = Duration::from_millis(200);

/// An image of the swapchain, to be presented.
pub struct AcquiredImage {
    index: u32,
    acquired: vk::Semaphore,
}

impl Swapchain {
    /// A swapchain for a window of `size` pixels. None while the window has no area, as when it is
    /// minimised.
    ///
    /// # Errors
    /// [`Error::Window`] where the window takes no 8-bit picture.
    pub fn new(device: &Arc<Device>, surface: &Arc<Surface>, size: [u32; 2]) -> Result<Option<Self>> {
        let (capabilities, formats) = surface.takes(device.physical)?;
        let extent = extent(&capabilities, size);
        if extent.contains(&0) {
            return Ok(None);
        }
        let Some(format) = format(&formats) else {
            return Err(Error::Window(NO_FORMAT.into()));
        };
        let most = if capabilities.max_image_count == 0 { u32::MAX } else { capabilities.max_image_count };
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(surface.raw)
            .min_image_count((capabilities.min_image_count + 1).min(most))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(vk::Extent2D { width: extent[0], height: extent[1] })
            .image_array_layers(1)
            .image_usage(USAGE)
            .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(composite_alpha(&capabilities))
            .present_mode(surface.present_mode(device.physical)?)
            .clipped(true);
        let loader = khr::swapchain::Device::new(&device.instance.raw, &device.raw);
        // SAFETY: info follows the surface's capabilities, and `swapchain` below owns the handle.
        let raw = check("creating the swapchain", unsafe { loader.create_swapchain(&info, None) })?;
        let mut swapchain = Self {
            raw,
            loader,
            images: Vec::new(),
            views: Vec::new(),
            rendered: Vec::new(),
            acquired: [vk::Semaphore::null(); FRAMES_IN_FLIGHT],
            next_acquire: 0,
            extent,
            format: format.format,
            device: Arc::clone(device),
            _surface: Arc::clone(surface),
        };
        swapchain.create_parts()?;
        Ok(Some(swapchain))
    }

    fn create_parts(&mut self) -> Result<()> {
        let semaphore = vk::SemaphoreCreateInfo::default();
        let device = Arc::clone(&self.device);
        // SAFETY: the swapchain is valid, and `self` owns each handle as soon as it is made.
        unsafe {
            self.images =
                check("listing the swapchain's images", self.loader.get_swapchain_images(self.raw))?;
            for image in &self.images {
                let info = vk::ImageViewCreateInfo::default()
                    .image(*image)
                    .view_type(vk::ImageViewType::TYPE_2D)
                    .format(self.format)
                    .subresource_range(WHOLE);
                self.views.push(check("creating an image view", device.raw.create_image_view(&info, None))?);
                let rendered = device.raw.create_semaphore(&semaphore, None);
                self.rendered.push(check("creating a semaphore", rendered)?);
            }
            for acquired in &mut self.acquired {
                *acquired = check("creating a semaphore", device.raw.create_semaphore(&semaphore, None))?;
            }
        }
        Ok(())
    }

    /// Width and height in pixels.
    pub fn extent(&self) -> [u32; 2] {
        self.extent
    }

    /// The format of its images, for imgui's renderer.
    pub fn format(&self) -> vk::Format {
        self.format
    }

    /// Waits for the next image to draw to.
    pub fn acquire(&mut self) -> Result<Acquired> {
        let acquired = self.acquired[self.next_acquire];
        let timeout = u64::try_from(ACQUIRE_TIMEOUT.as_nanos()).unwrap_or(u64::MAX);
        // SAFETY: the semaphore's last wait is over: the caller waits for a frame's fence before
        // it begins the frame, and there are as many semaphores as frames.
        let result =
            unsafe { self.loader.acquire_next_image(self.raw, timeout, acquired, vk::Fence::null()) };
        match result {
            // A suboptimal image can still be shown; presenting it says so again.
            Ok((index, _suboptimal)) => {
                self.next_acquire = (self.next_acquire + 1) % FRAMES_IN_FLIGHT;
                Ok(Acquired::Image(AcquiredImage { index, acquired }))
            }
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(Acquired::Stale),
            Err(vk::Result::TIMEOUT | vk::Result::NOT_READY) => Ok(Acquired::NotReady),
            Err(result) => self.device.check("acquiring an image of the window", Err(result)),
        }
    }

    /// Whether a pixel's bytes start with blue: pictures are copied as they are.
    pub fn blue_first(&self) -> bool {
        self.format == vk::Format::B8G8R8A8_UNORM
    }

    /// Copies `picture` to the acquired image, with its upper left corner at `corner`, and opens the image for drawing
    /// on top. Another picture of the same size takes the left part of its place. What no picture covers must be drawn
    /// over; without a picture the image is black.
    pub fn begin_drawing(
        &self,
        recording: &mut Recording<'_>,
        image: &AcquiredImage,
        corner: [u32; 2],
        picture: Option<&Image>,
        left: Option<(&Image, u32)>,
    ) {
        let raw = self.images[image.index as usize];
        let buffer = recording.raw();
        let transfer = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
        let attachment = (
            vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
            vk::AccessFlags2::COLOR_ATTACHMENT_READ | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE,
        );
        // `present` waits for the acquired image at this stage, so that tracing need not.
        let undefined = (vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT, vk::AccessFlags2::NONE);
        let (dst, color) = (vk::ImageLayout::TRANSFER_DST_OPTIMAL, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
        recording.transition(raw, vk::ImageLayout::UNDEFINED, undefined, dst, transfer);
        let copy = |picture: &Image, from: u32, to: u32| {
            let [width, height] =
                [0, 1].map(|axis| self.extent[axis].saturating_sub(corner[axis]).min(picture.extent()[axis]));
            let (from, to) = (from.min(width), to.min(width));
            if from == to || height == 0 {
                return;
            }
            let offset = |x: u32, y: u32| vk::Offset3D { x: x.cast_signed(), y: y.cast_signed(), z: 0 };
            let region = [vk::ImageCopy::default()
                .src_subresource(LAYER)
                .src_offset(offset(from, 0))
                .dst_subresource(LAYER)
                .dst_offset(offset(corner[0] + from, corner[1]))
                .extent(vk::Extent3D { width: to - from, height, depth: 1 })];
            let general = vk::ImageLayout::GENERAL;
            // A copy leaves the bytes as they are. A blit would convert them, which takes a software device as long as
            // tracing does.
            // SAFETY: both images are in these layouts, hold the area, and have four bytes a pixel.
            unsafe { recording.device().raw.cmd_copy_image(buffer, picture.raw, general, raw, dst, &region) };
        };
        let split = left.map_or(0, |(_, split)| split);
        if let Some((other, split)) = left {
            copy(other, 0, split);
        }
        if let Some(picture) = picture {
            copy(picture, split, self.extent[0]);
        }
        recording.transition(raw, dst, transfer, color, attachment);
        let load_op =
            if picture.is_some() { vk::AttachmentLoadOp::LOAD } else { vk::AttachmentLoadOp::CLEAR };
        let target = [vk::RenderingAttachmentInfo::default()
            .image_view(self.views[image.index as usize])
            .image_layout(color)
            .load_op(load_op)
            .store_op(vk::AttachmentStoreOp::STORE)];
        let [width, height] = self.extent;
        let rendering = vk::RenderingInfo::default()
            .render_area(vk::Rect2D::default().extent(vk::Extent2D { width, height }))
            .layer_count(1)
            .color_attachments(&target);
        // SAFETY: recording is under way; the view is in this layout.
        unsafe { recording.device().raw.cmd_begin_rendering(buffer, &rendering) };
    }

    /// Ends the drawing, submits, and presents. False when the swapchain has become stale.
    pub fn present(&mut self, mut recording: Recording<'_>, image: &AcquiredImage) -> Result<bool> {
        let raw = self.images[image.index as usize];
        // SAFETY: `begin_drawing` began it.
        unsafe { recording.device().raw.cmd_end_rendering(recording.raw()) };
        let attachment =
            (vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT, vk::AccessFlags2::COLOR_ATTACHMENT_WRITE);
        let nothing = (vk::PipelineStageFlags2::ALL_COMMANDS, vk::AccessFlags2::NONE);
        let color = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
        recording.transition(raw, color, attachment, vk::ImageLayout::PRESENT_SRC_KHR, nothing);

        let rendered = self.rendered[image.index as usize];
        let wait = [vk::SemaphoreSubmitInfo::default()
            .semaphore(image.acquired)
            .stage_mask(vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT)];
        let signal = [vk::SemaphoreSubmitInfo::default()
            .semaphore(rendered)
            .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        recording.submit_between(&wait, &signal)?;

        let (semaphores, swapchains, indices) = ([rendered], [self.raw], [image.index]);
        let info = vk::PresentInfoKHR::default()
            .wait_semaphores(&semaphores)
            .swapchains(&swapchains)
            .image_indices(&indices);
        // SAFETY: the image is in the layout for presenting once the semaphore is signalled.
        match unsafe { self.loader.queue_present(*self.device.queue(), &info) } {
            Ok(suboptimal) => Ok(!suboptimal),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(false),
            Err(result) => self.device.check("presenting", Err(result)),
        }
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        // SAFETY: the device is waited for, so that no image or semaphore is in use; null handles
        // are allowed. The surface goes after, by its Arc.
        unsafe {
            let _ = self.device.raw.device_wait_idle();
            for view in &self.views {
                self.device.raw.destroy_image_view(*view, None);
            }
            for semaphore in self.rendered.iter().chain(&self.acquired) {
                self.device.raw.destroy_semaphore(*semaphore, None);
            }
            self.loader.destroy_swapchain(self.raw, None);
        }
    }
}

fn extent(capabilities: &vk::SurfaceCapabilitiesKHR, size: [u32; 2]) -> [u32; 2] {
    let current = capabilities.current_extent;
    if current.width != u32::MAX {
        return [current.width, current.height];
    }
    let (min, max) = (capabilities.min_image_extent, capabilities.max_image_extent);
    [size[0].clamp(min.width, max.width), size[1].clamp(min.height, max.height)]
}

fn composite_alpha(capabilities: &vk::SurfaceCapabilitiesKHR) -> vk::CompositeAlphaFlagsKHR {
    let supported = capabilities.supported_composite_alpha;
    [
        vk::CompositeAlphaFlagsKHR::OPAQUE,
        vk::CompositeAlphaFlagsKHR::INHERIT,
        vk::CompositeAlphaFlagsKHR::PRE_MULTIPLIED,
    ]
    .into_iter()
    .find(|mode| supported.contains(*mode))
    .unwrap_or(vk::CompositeAlphaFlagsKHR::OPAQUE)
}
