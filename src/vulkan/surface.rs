//! The surface of a window: what it takes, and which devices can present to it.

use super::{Instance, check};
use crate::error::{Error, Result};
use ash::{khr, vk};
use std::sync::Arc;
use winit::raw_window_handle::{HandleError, HasDisplayHandle, HasWindowHandle};
use winit::window::Window;

/// A window, as Vulkan sees it.
pub struct Surface {
    pub(super) raw: vk::SurfaceKHR,
    loader: khr::surface::Instance,
    _instance: Arc<Instance>,
    _window: Arc<Window>,
}

/// How the window's images are used: pictures are copied to them, and the panel is drawn on top.
pub(super) const USAGE: vk::ImageUsageFlags = vk::ImageUsageFlags::from_raw(
    vk::ImageUsageFlags::TRANSFER_DST.as_raw() | vk::ImageUsageFlags::COLOR_ATTACHMENT.as_raw(),
);

impl Surface {
    /// The surface of a window, which stays open as long as the surface.
    ///
    /// # Errors
    /// [`Error::Window`] where the window system gives no handles.
    pub fn new(instance: &Arc<Instance>, window: &Arc<Window>) -> Result<Arc<Self>> {
        let handles = || Ok((window.display_handle()?.as_raw(), window.window_handle()?.as_raw()));
        let (display, handle) = handles().map_err(|error: HandleError| Error::Window(error.to_string()))?;
        // SAFETY: the handles are those of a live window, which the surface keeps alive.
        let raw =
            unsafe { ash_window::create_surface(&instance.entry, &instance.raw, display, handle, None) };
        Ok(Arc::new(Self {
            raw: check("creating the window's surface", raw)?,
            loader: khr::surface::Instance::new(&instance.entry, &instance.raw),
            _instance: Arc::clone(instance),
            _window: Arc::clone(window),
        }))
    }

    pub(super) fn presents(&self, device: vk::PhysicalDevice, family: u32) -> Result<bool> {
        // SAFETY: device, family and surface belong to one instance.
        let supported = unsafe { self.loader.get_physical_device_surface_support(device, family, self.raw) };
        check("asking whether a device can present", supported)
    }

    /// What the window takes from a device that presents to it.
    pub(super) fn takes(
        &self,
        device: vk::PhysicalDevice,
    ) -> Result<(vk::SurfaceCapabilitiesKHR, Vec<vk::SurfaceFormatKHR>)> {
        // SAFETY: device and surface belong to one instance, and the device presents to the surface.
        let (capabilities, formats) = unsafe {
            (
                self.loader.get_physical_device_surface_capabilities(device, self.raw),
                self.loader.get_physical_device_surface_formats(device, self.raw),
            )
        };
        let capabilities = check("asking what the window takes", capabilities)?;
        Ok((capabilities, check("asking which formats the window takes", formats)?))
    }

    /// How the window shows frames: each at once where it can, instead of after those that wait, so that what a
    /// hand did is on the screen one or two frames earlier. Neither mode tears.
    pub(super) fn present_mode(&self, device: vk::PhysicalDevice) -> Result<vk::PresentModeKHR> {
        // SAFETY: device and surface belong to one instance, and the device presents to the surface.
        let offered = unsafe { self.loader.get_physical_device_surface_present_modes(device, self.raw) };
        Ok(soonest(&check("asking how the window shows frames", offered)?))
    }

    /// The reason why this device cannot show frames in the window, if there is one.
    pub(super) fn why_unusable(&self, device: vk::PhysicalDevice) -> Result<Option<&'static str>> {
        let (capabilities, formats) = self.takes(device)?;
        Ok(why_unusable(&capabilities, &formats))
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: swapchains hold an Arc of their surface, so none is left.
        unsafe { self.loader.destroy_surface(self.raw, None) };
    }
}

pub(super) const NO_FORMAT: &str = "it takes no 8-bit pictures";

/// The resolve pass encodes sRGB itself, so the format must not do it again.
pub(super) fn format(offered: &[vk::SurfaceFormatKHR]) -> Option<&vk::SurfaceFormatKHR> {
    let known = [vk::Format::B8G8R8A8_UNORM, vk::Format::R8G8B8A8_UNORM];
    offered.iter().find(|offered| known.contains(&offered.format))
}

/// The reason why frames cannot be shown in a window, if there is one.
fn why_unusable(
    capabilities: &vk::SurfaceCapabilitiesKHR,
    formats: &[vk::SurfaceFormatKHR],
) -> Option<&'static str> {
    let takes = |usage| capabilities.supported_usage_flags.contains(usage);
    match () {
        () if !takes(vk::ImageUsageFlags::TRANSFER_DST) => Some("nothing can be copied to it (TRANSFER_DST)"),
        () if !takes(vk::ImageUsageFlags::COLOR_ATTACHMENT) => {
            Some("nothing can be drawn on it (COLOR_ATTACHMENT)")
        }
        () => format(formats).is_none().then_some(NO_FORMAT),
    }
}

/// Every window offers FIFO.
fn soonest(offered: &[vk::PresentModeKHR]) -> vk::PresentModeKHR {
    let mailbox = vk::PresentModeKHR::MAILBOX;
    if offered.contains(&mailbox) { mailbox } else { vk::PresentModeKHR::FIFO }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches a window that is used for what it does not offer: on such a device each frame breaks Vulkan's rules.
    #[test]
    fn a_window_that_lacks_something_is_not_used() {
        let of = |usage, format| {
            let capabilities = vk::SurfaceCapabilitiesKHR::default().supported_usage_flags(usage);
            let format = vk::SurfaceFormatKHR { format, ..Default::default() };
            why_unusable(&capabilities, &[format])
        };
        let eight_bits = vk::Format::R8G8B8A8_UNORM;
        assert_eq!(of(USAGE | vk::ImageUsageFlags::SAMPLED, eight_bits), None);
        let lacks = |usage: vk::ImageUsageFlags| of(USAGE & !usage, eight_bits).expect("a reason");
        assert!(lacks(vk::ImageUsageFlags::TRANSFER_DST).contains("TRANSFER_DST"));
        assert!(lacks(vk::ImageUsageFlags::COLOR_ATTACHMENT).contains("COLOR_ATTACHMENT"));
        assert_eq!(of(USAGE, vk::Format::R16G16B16A16_SFLOAT), Some(NO_FORMAT));
    }

    /// Catches frames that queue up although the window could show the newest, and a mode that it does not offer.
    #[test]
    fn the_newest_frame_is_shown_where_the_window_can() {
        let (fifo, mailbox) = (vk::PresentModeKHR::FIFO, vk::PresentModeKHR::MAILBOX);
        assert_eq!(soonest(&[vk::PresentModeKHR::IMMEDIATE, fifo, mailbox]), mailbox);
        assert_eq!(soonest(&[vk::PresentModeKHR::IMMEDIATE, fifo]), fifo);
    }
}
