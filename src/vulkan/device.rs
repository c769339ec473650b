//! Choosing a device, and what belongs to it: its queue and its allocator.

use super::limits::{Limits, Traits, why_too_small};
use super::pipeline_cache::{PipelineCache, user_cache_folder};
use super::swapchain::Surface;
use super::{Instance, check, loader_changes, loader_stays};
use crate::error::{Error, Result};
use ash::{ext, khr, vk};
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use std::ffi::{CStr, CString};
use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// The kind of a device that runs on the CPU.
const SOFTWARE: &str = "software";

/// A device of the system, usable or not.
#[derive(Debug, Clone)]
pub struct DeviceInfo {
    /// What `--device` takes.
    pub index: usize,
    /// The device's own name.
    pub name: String,
    /// "discrete GPU", "integrated GPU", "virtual GPU", "software" or "other".
    pub kind: &'static str,
    /// The driver's name and version.
    pub driver: String,
    /// Its UUID, where another device has the same name.
    pub uuid: Option<String>,
    /// Why the renderer cannot use it, if so.
    pub unusable: Option<String>,
    rank: u8,
    raw: vk::PhysicalDevice,
    queue_family: u32,
}

/// A logical device with one queue, which computes, copies, draws, and presents where asked to.
pub struct Device {
    pub(super) raw: ash::Device,
    pub(super) physical: vk::PhysicalDevice,
    pub(super) queue: vk::Queue,
    pub(super) queue_family: u32,
    pub(super) debug: Option<ext::debug_utils::Device>,
    /// Nanoseconds a timestamp tick; 0 where the queue has no timestamps.
    pub(super) timestamp_period: f32,
    allocator: ManuallyDrop<Arc<Mutex<Allocator>>>,
    cache: OnceLock<PipelineCache>,
    info: DeviceInfo,
    pub(super) limits: Limits,
    traits: Traits,
    pub(super) instance: Arc<Instance>,
}

impl Instance {
    /// The system's devices. With a surface, those that cannot present to it are unusable.
    ///
    /// # Errors
    /// What Vulkan says.
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
            let fault = if can_swap { surface.fault(raw)? } else { Some("VK_KHR_swapchain is missing") };
            info.unusable = fault.map(|fault| format!("it can show no picture in a window: {fault}"));
        }
        Ok(info)
    }

    fn queue_family(&self, raw: vk::PhysicalDevice, surface: Option<&Surface>) -> Result<Option<u32>> {
        // SAFETY: raw is a device of this instance.
        let families = unsafe { self.raw.get_physical_device_queue_family_properties(raw) };
        // Drawing is for the window's panel alone.
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

impl Device {
    /// Opens the device that `wanted` names by index or part of its name, or else the best one:
    /// discrete before integrated before software.
    ///
    /// # Errors
    /// [`Error::UnknownDevice`], [`Error::NoDevice`], or what Vulkan says.
    pub fn open(
        instance: &Arc<Instance>,
        wanted: Option<&str>,
        surface: Option<&Surface>,
    ) -> Result<Arc<Self>> {
        Self::open_as(instance, wanted, surface, None)
    }

    /// Likewise, to be used in this way instead of its own: so a software device can run what else only a GPU runs.
    ///
    /// # Errors
    /// Likewise.
    pub fn open_as(
        instance: &Arc<Instance>,
        wanted: Option<&str>,
        surface: Option<&Surface>,
        traits: Option<Traits>,
    ) -> Result<Arc<Self>> {
        let devices = instance.devices(surface)?;
        let info = choose(&devices, wanted)?;
        let own = if info.kind == SOFTWARE { Traits::SOFTWARE } else { Traits::GPU };
        log::info!("device {}: {} ({})", info.index, info.name, info.driver);

        let has = extensions(instance, info.raw)?;
        let mut wanted = Vec::new();
        if surface.is_some() {
            wanted.push(khr::swapchain::NAME.as_ptr());
        }
        if has.iter().any(|name| name.as_c_str() == khr::portability_subset::NAME) {
            // The specification asks for it wherever it is offered.
            wanted.push(khr::portability_subset::NAME.as_ptr());
        }
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(info.queue_family)
            .queue_priorities(&[1.0])];
        let mut features =
            vk::PhysicalDeviceVulkan13Features::default().synchronization2(true).dynamic_rendering(true);
        let create = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&wanted)
            .push_next(&mut features);
        // SAFETY: the structures live through the call; Vulkan 1.3 guarantees both features.
        let raw = unsafe {
            let _lists = loader_changes();
            instance.raw.create_device(info.raw, &create, None)
        };
        let raw = check("creating the device", raw)?;

        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.raw.clone(),
            device: raw.clone(),
            physical_device: info.raw,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: Default::default(),
        });
        let allocator = match allocator {
            Ok(allocator) => allocator,
            Err(error) => {
                // SAFETY: nothing was made of the device yet.
                unsafe {
                    let _lists = loader_changes();
                    raw.destroy_device(None);
                }
                log::error!("allocator: {error}");
                return Err(Error::NoDevice(format!("{}: {error}", info.name)));
            }
        };
        // SAFETY: the family and its one queue were asked for above; the device is of this instance.
        let (queue, limits, families) = unsafe {
            (
                raw.get_device_queue(info.queue_family, 0),
                instance.raw.get_physical_device_properties(info.raw).limits,
                instance.raw.get_physical_device_queue_family_properties(info.raw),
            )
        };
        let timestamps = families[info.queue_family as usize].timestamp_valid_bits > 0;
        Ok(Arc::new(Self {
            debug: instance.debug_utils.then(|| ext::debug_utils::Device::new(&instance.raw, &raw)),
            physical: info.raw,
            queue,
            queue_family: info.queue_family,
            timestamp_period: if timestamps { limits.timestamp_period } else { 0.0 },
            allocator: ManuallyDrop::new(Arc::new(Mutex::new(allocator))),
            cache: OnceLock::new(),
            limits: Limits::new(&instance.raw, info.raw),
            traits: traits.unwrap_or(own),
            info: info.clone(),
            instance: Arc::clone(instance),
            raw,
        }))
    }

    /// Keeps compiled pipelines in a file of this folder from one run to the next: what is there is
    /// used from now on, and what is there at the end is written when the device goes. A file that cannot be
    /// read or written is a line in the log and no failure.
    pub fn keep_pipelines_in(&self, folder: &Path) {
        self.cache.get_or_init(|| PipelineCache::load(self, folder));
    }

    /// Likewise, in the user's cache folder, if there is one.
    pub fn keep_pipelines(&self) {
        if let Some(folder) = user_cache_folder() {
            self.keep_pipelines_in(&folder);
        }
    }

    /// What this device is and can, as its driver says.
    pub(super) fn properties(&self) -> vk::PhysicalDeviceProperties {
        // SAFETY: the device is of this instance.
        unsafe { self.instance.raw.get_physical_device_properties(self.physical) }
    }

    pub(super) fn pipeline_cache(&self) -> vk::PipelineCache {
        self.cache.get().map_or_else(vk::PipelineCache::null, PipelineCache::raw)
    }

    /// What device it is.
    pub fn info(&self) -> &DeviceInfo {
        &self.info
    }

    /// The instance it came from.
    pub fn instance(&self) -> &Arc<Instance> {
        &self.instance
    }

    /// How it is used.
    pub fn traits(&self) -> Traits {
        self.traits
    }

    /// Waits until the device has nothing to do.
    ///
    /// # Errors
    /// What Vulkan says: a lost device.
    pub fn wait_idle(&self) -> Result<()> {
        // SAFETY: the device is valid. Renderer and window use its queue from one thread.
        check("waiting for the device", unsafe { self.raw.device_wait_idle() })
    }

    /// The raw handles, for imgui's renderer, which is written against them. It must be dropped
    /// before the device.
    pub fn raw_parts(&self) -> (ash::Device, vk::Queue, Arc<Mutex<Allocator>>) {
        (self.raw.clone(), self.queue, Arc::clone(&self.allocator))
    }

    /// What is allocated on it now: each allocation's name and bytes, in the order of their names.
    pub fn memory(&self) -> Vec<(String, u64)> {
        let report = self.allocator().generate_report();
        let mut memory: Vec<_> =
            report.allocations.into_iter().map(|allocation| (allocation.name, allocation.size)).collect();
        memory.sort();
        memory
    }

    pub(super) fn allocator(&self) -> MutexGuard<'_, Allocator> {
        self.allocator.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives an object its name in validation messages and debuggers.
    pub(super) fn set_name(&self, object: impl vk::Handle, name: &str) {
        let (Some(debug), Ok(name)) = (&self.debug, CString::new(name)) else {
            return;
        };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&name);
        let _lists = loader_stays();
        // SAFETY: the object is one of this device. A name that cannot be set is no failure.
        let _ = unsafe { debug.set_debug_utils_object_name(&info) };
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: every child holds an Arc of this device, so none is left. The allocator frees its
        // memory before the device goes, and is not touched again.
        unsafe {
            let _ = self.raw.device_wait_idle();
            if let Some(cache) = self.cache.take() {
                cache.save(&self.raw);
                cache.destroy(&self.raw);
            }
            ManuallyDrop::drop(&mut self.allocator);
            let _lists = loader_changes();
            self.raw.destroy_device(None);
        }
    }
}

/// A device's UUID tells it apart from others of its name, and is of no use elsewhere.
fn keep_needed_uuids(devices: &mut [DeviceInfo]) {
    let names: Vec<_> = devices.iter().map(|device| device.name.clone()).collect();
    let alone = |device: &DeviceInfo| names.iter().filter(|name| **name == device.name).count() == 1;
    devices.iter_mut().filter(|device| alone(device)).for_each(|device| device.uuid = None);
}

fn choose<'a>(devices: &'a [DeviceInfo], wanted: Option<&str>) -> Result<&'a DeviceInfo> {
    let Some(wanted) = wanted else {
        let usable = devices.iter().filter(|device| device.unusable.is_none());
        return usable.min_by_key(|device| device.rank).ok_or_else(|| {
            let faults = devices.iter().filter_map(|device| {
                let fault = device.unusable.as_ref()?;
                Some(format!("{}: {fault}", device.name))
            });
            let faults = faults.collect::<Vec<_>>().join("; ");
            Error::NoDevice(if faults.is_empty() { "no driver is installed".into() } else { faults })
        });
    };
    let lowercase = wanted.to_lowercase();
    let named = |device: &&DeviceInfo| !wanted.is_empty() && device.name.to_lowercase().contains(&lowercase);
    let device = match wanted.parse::<usize>() {
        Ok(index) => devices.get(index),
        // Of devices of one name, a usable one.
        Err(_) => devices.iter().filter(named).min_by_key(|device| device.unusable.is_some()),
    };
    let device = device.ok_or_else(|| {
        let names = devices.iter().map(|device| format!("{} {}", device.index, device.name));
        Error::UnknownDevice { wanted: wanted.to_owned(), available: names.collect::<Vec<_>>().join(", ") }
    })?;
    match &device.unusable {
        Some(fault) => Err(Error::UnusableDevice(format!("{}: {fault}", device.name))),
        None => Ok(device),
    }
}

fn extensions(instance: &Instance, device: vk::PhysicalDevice) -> Result<Vec<CString>> {
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
