//! A device that is in use, with what belongs to it: its queue, its allocator and its pipeline cache.

use super::health::Health;
use super::limits::{Limits, Traits};
use super::physical::{DeviceInfo, SOFTWARE, choose, extensions};
use super::pipeline_cache::{PipelineCache, user_cache_folder};
use super::{Instance, Surface, check, loader_changes, loader_stays};
use crate::error::{Error, Result};
use ash::{ext, khr, vk};
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use std::ffi::CString;
use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// A logical device with one queue, which computes, copies, draws, and presents where asked to.
pub struct Device {
    pub(super) raw: ash::Device,
    pub(super) physical: vk::PhysicalDevice,
    /// One thread at a time hands work to it.
    queue: Mutex<vk::Queue>,
    /// What became of it.
    pub(super) health: Health,
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

impl Device {
    /// Opens the device that `wanted` names by index or part of its name, or else the best one:
    /// discrete before integrated before software.
    ///
    /// # Errors
    /// [`Error::UnknownDevice`], [`Error::UnusableDevice`] or [`Error::NoDevice`].
    pub fn open(
        instance: &Arc<Instance>,
        wanted: Option<&str>,
        surface: Option<&Surface>,
    ) -> Result<Arc<Self>> {
        Self::open_as(instance, wanted, surface, None)
    }

    /// Opens a device as [`Self::open`] does, but uses it in the way that `traits` say: a software device can run the code
    /// that otherwise only a GPU runs.
    ///
    /// # Errors
    /// As [`Self::open`].
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
            queue: Mutex::new(queue),
            health: Health::default(),
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

    /// Keeps compiled pipelines in a file of this folder from one run to the next. Those in the file are used from now on,
    /// and all are written to it when the device is dropped. A file that cannot be read or written is a line in the log
    /// and no failure.
    pub fn keep_pipelines_in(&self, folder: &Path) {
        self.cache.get_or_init(|| {
            // SAFETY: the device is of this instance.
            let properties = unsafe { self.instance.raw.get_physical_device_properties(self.physical) };
            PipelineCache::load(&self.raw, &properties, folder)
        });
    }

    /// Keeps compiled pipelines in the user's cache folder, if there is one: see [`Self::keep_pipelines_in`].
    pub fn keep_pipelines(&self) {
        if let Some(folder) = user_cache_folder() {
            self.keep_pipelines_in(&folder);
        }
    }

    pub(super) fn pipeline_cache(&self) -> vk::PipelineCache {
        self.cache.get().map_or_else(vk::PipelineCache::null, PipelineCache::raw)
    }

    /// Its name, kind and driver.
    pub fn info(&self) -> &DeviceInfo {
        &self.info
    }

    /// The instance it came from.
    pub fn instance(&self) -> &Arc<Instance> {
        &self.instance
    }

    /// How the renderer uses it: as a GPU, or as a software device.
    pub fn traits(&self) -> Traits {
        self.traits
    }

    /// Waits until the device has nothing to do.
    pub fn wait_idle(&self) -> Result<()> {
        let _queue = self.queue();
        // SAFETY: the device is valid, and no other thread uses its queue meanwhile.
        self.check("waiting for the device", unsafe { self.raw.device_wait_idle() })
    }

    /// The raw handles, which imgui's renderer takes. That renderer must be dropped before the device. No other thread
    /// can use the queue while it is held.
    pub fn raw_parts(&self) -> (ash::Device, MutexGuard<'_, vk::Queue>, Arc<Mutex<Allocator>>) {
        (self.raw.clone(), self.queue(), Arc::clone(&self.allocator))
    }

    /// The queue, while no other thread uses it. To hand work to it takes little time, whatever the work takes.
    pub(super) fn queue(&self) -> MutexGuard<'_, vk::Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Names what failed; of a lost device, what it ran.
    pub(super) fn check<T>(&self, what: &'static str, result: Result<T, vk::Result>) -> Result<T> {
        match result {
            Err(vk::Result::ERROR_DEVICE_LOST) => Err(self.health.error()),
            result => check(what, result),
        }
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
