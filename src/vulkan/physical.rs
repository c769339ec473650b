//! The devices of the system: what they are, whether they can be used, and choosing one.

use super::limits::why_too_small;
use super::{Instance, Surface, check, loader_changes};
use crate::error::{Error, Result};
use ash::{khr, vk};
use std::ffi::{CStr, CString};

/// The kind of a device that runs on the CPU.
pub(super) const SOFTWARE: &str = "software";

/// A device of the system, usable or not.
#[derive(Debug, Clone)]
pub struct DeviceInfo {
    /// The number by which `--device` chooses it.
    pub index: usize,
    /// The device's own name.
    pub name: String,
    /// "discrete GPU", "integrated GPU", "virtual GPU", "software" or "other".
    pub kind: &'static str,
    /// The driver's name and version.
    pub driver: String,
    /// Its UUID, where another device has the same name.
    pub uuid: Option<String>,
    /// The reason why the renderer cannot use it, if there is one.
    pub unusable: Option<String>,
    rank: u8,
    pub(super) raw: vk::PhysicalDevice,
    pub(super) queue_family: u32,
}

impl Instance {
    /// The system's devices. With a surface, those that cannot present to it are unusable.
    pub fn devices(&self, surface: Option<&Surface>) -> Result<Vec<DeviceInfo>> {
        // SAFETY: the instance is valid.
        let devices = unsafe {
            let _lists = loader_changes();
            self.raw.enumerate_physical_devices()
        };
        let mut devices: Vec<DeviceInfo> = check("listing devices", devices)?
            .into_iter()
            .enumerate()
            .map(|(index, raw)| self.describe(index, raw, surface))
            .collect::<Result<_>>()?;
        keep_needed_uuids(&mut devices);
        Ok(devices)
    }

    fn describe(
        &self,
        index: usize,
        raw: vk::PhysicalDevice,
        surface: Option<&Surface>,
    ) -> Result<DeviceInfo> {
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut id = vk::PhysicalDeviceIDProperties::default();
        let mut properties =
            vk::PhysicalDeviceProperties2::default().push_next(&mut driver).push_next(&mut id);
        // SAFETY: raw is a device of this instance; the structures chain to live locals.
        unsafe { self.raw.get_physical_device_properties2(raw, &mut properties) };
        let properties = properties.properties;
        let (kind, rank) = match properties.device_type {
            vk::PhysicalDeviceType::DISCRETE_GPU => ("discrete GPU", 0),
            vk::PhysicalDeviceType::INTEGRATED_GPU => ("integrated GPU", 1),
            vk::PhysicalDeviceType::VIRTUAL_GPU => ("virtual GPU", 2),
            vk::PhysicalDeviceType::CPU => (SOFTWARE, 3),
            _ => ("other", 4),
        };
        let mut info = DeviceInfo {
            index,
            name: text(properties.device_name_as_c_str()),
            kind,
            driver: format!(
                "{} {}",
                text(driver.driver_name_as_c_str()),
                text(driver.driver_info_as_c_str())
            ),
            uuid: Some(id.device_uuid.map(|byte| format!("{byte:02x}")).concat()),
            unusable: None,
            rank,
            raw,
            queue_family: 0,
        };
        if properties.api_version < vk::API_VERSION_1_3 {
            let (major, minor) = (
                vk::api_version_major(properties.api_version),
                vk::api_version_minor(properties.api_version),
            );
            info.unusable = Some(format!("Vulkan {major}.{minor}, needs 1.3"));
            return Ok(info);
        }
        if let Some(why) = why_too_small(&properties.limits) {
            info.unusable = Some(why);
            return Ok(info);
        }
        match self.queue_family(raw, surface)? {
            Some(family) => info.queue_family = family,
            None if surface.is_some() => {
                info.unusable = Some("no queue that computes, draws and presents".into())
            }
            None => info.unusable = Some("no queue that computes".into()),
        }
        if let (None, Some(surface)) = (&info.unusable, surface) {
            let can_swap = extensions(self, raw)?.iter().any(|name| name.as_c_str() == khr::swapchain::NAME);
            let why = if can_swap { surface.why_unusable(raw)? } else { Some("VK_KHR_swapchain is missing") };
            info.unusable = why.map(|why| format!("it can show no picture in a window: {why}"));
        }
        Ok(info)
    }

    fn queue_family(&self, raw: vk::PhysicalDevice, surface: Option<&Surface>) -> Result<Option<u32>> {
        // SAFETY: raw is a device of this instance.
        let families = unsafe { self.raw.get_physical_device_queue_family_properties(raw) };
        // Only the window's panel is drawn; all else is computed.
        let graphics = if surface.is_some() { vk::QueueFlags::GRAPHICS } else { vk::QueueFlags::empty() };
        let wanted = vk::QueueFlags::COMPUTE | graphics;
        for (family, properties) in (0..).zip(&families) {
            let presents = surface.map_or(Ok(true), |surface| surface.presents(raw, family))?;
            if properties.queue_flags.contains(wanted) && presents {
                return Ok(Some(family));
            }
        }
        Ok(None)
    }
}

/// Removes the UUIDs of devices that their name tells apart already.
fn keep_needed_uuids(devices: &mut [DeviceInfo]) {
    let names: Vec<_> = devices.iter().map(|device| device.name.clone()).collect();
    let alone = |device: &DeviceInfo| names.iter().filter(|name| **name == device.name).count() == 1;
    devices.iter_mut().filter(|device| alone(device)).for_each(|device| device.uuid = None);
}

pub(super) fn choose<'a>(devices: &'a [DeviceInfo], wanted: Option<&str>) -> Result<&'a DeviceInfo> {
    let Some(wanted) = wanted else {
        let usable = devices.iter().filter(|device| device.unusable.is_none());
        return usable.min_by_key(|device| device.rank).ok_or_else(|| {
            let reasons = devices.iter().filter_map(|device| {
                let why = device.unusable.as_ref()?;
                Some(format!("{}: {why}", device.name))
            });
            let reasons = reasons.collect::<Vec<_>>().join("; ");
            Error::NoDevice(if reasons.is_empty() { "no driver is installed".into() } else { reasons })
        });
    };
    let lowercase = wanted.to_lowercase();
    let named = |device: &&DeviceInfo| !wanted.is_empty() && device.name.to_lowercase().contains(&lowercase);
    let device = match wanted.parse::<usize>() {
        Ok(index) => devices.get(index),
        // Where several devices have the name, one that can be used.
        Err(_) => devices.iter().filter(named).min_by_key(|device| device.unusable.is_some()),
    };
    let device = device.ok_or_else(|| {
        let names = devices.iter().map(|device| format!("{} {}", device.index, device.name));
        Error::UnknownDevice { wanted: wanted.to_owned(), available: names.collect::<Vec<_>>().join(", ") }
    })?;
    match &device.unusable {
        Some(why) => Err(Error::UnusableDevice(format!("{}: {why}", device.name))),
        None => Ok(device),
    }
}

pub(super) fn extensions(instance: &Instance, device: vk::PhysicalDevice) -> Result<Vec<CString>> {
    // SAFETY: the device is of this instance.
    let properties = unsafe { instance.raw.enumerate_device_extension_properties(device) };
    let properties = check("listing device extensions", properties)?;
    Ok(properties
        .iter()
        .filter_map(|extension| extension.extension_name_as_c_str().ok().map(CStr::to_owned))
        .collect())
}

fn text(name: Result<&CStr, std::ffi::FromBytesUntilNulError>) -> String {
    name.unwrap_or(c"?").to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches two devices of one name that a list does not tell apart.
    #[test]
    fn devices_of_one_name_keep_their_uuids() {
        let named = |name: &str, uuid: &str| DeviceInfo {
            index: 0,
            name: name.into(),
            kind: SOFTWARE,
            driver: String::new(),
            uuid: Some(uuid.into()),
            unusable: None,
            rank: 3,
            raw: vk::PhysicalDevice::null(),
            queue_family: 0,
        };
        let mut devices = [named("twin", "01"), named("other", "02"), named("twin", "03")];
        keep_needed_uuids(&mut devices);
        assert_eq!(devices.map(|device| device.uuid), [Some("01".into()), None, Some("03".into())]);
    }
}
