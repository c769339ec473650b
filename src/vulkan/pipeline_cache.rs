//! Compiled pipelines on disk, so that the next start need not compile them.
//!
//! Drivers trust the bytes after the header, and some crash on bytes that they did not write. So a file begins with a
//! checksum of the driver's data, and the header of that data, which Vulkan specifies
//! (`VkPipelineCacheHeaderVersionOne`), must name this device.

use crate::error::Result;
use crate::pending_file::PendingFile;
use ash::vk;
use etcetera::BaseStrategy;
use std::path::{Path, PathBuf};

/// Every scene adds its own pipelines, and drivers never remove one, so a file that is larger than this is started
/// anew.
const MAX_BYTES: usize = 64 << 20;
/// The first bytes of every file. The checksum and the driver's data follow.
const MAGIC: [u8; 8] = *b"thinlpc1";
/// Bytes of magic and checksum.
const ENVELOPE: usize = 16;
/// Bytes of the header of the driver's data: its length, version, vendor, device and UUID.
const HEADER: usize = 32;

/// The cache that all pipelines of a device share.
pub(super) struct PipelineCache {
    raw: vk::PipelineCache,
    path: PathBuf,
    /// The driver's data that the file had, or nothing where it was of no use.
    loaded: Vec<u8>,
}

/// The user's folder for files that programs can make again, if there is one: `XDG_CACHE_HOME` or `~/.cache`,
/// `~/Library/Caches`, `%LOCALAPPDATA%`.
pub(super) fn user_cache_folder() -> Option<PathBuf> {
    let folders = etcetera::base_strategy::choose_native_strategy().ok()?;
    Some(folders.cache_dir().join("thinlens"))
}

impl PipelineCache {
    /// A cache with what the folder's file for this device holds.
    pub(super) fn load(
        device: &ash::Device,
        properties: &vk::PhysicalDeviceProperties,
        folder: &Path,
    ) -> Self {
        let path = folder.join(file_name(properties));
        let loaded = match std::fs::read(&path) {
            Ok(bytes) => open(&bytes, properties).map(<[u8]>::to_vec).unwrap_or_else(|why| {
                log::info!("pipeline cache {}: {why}; compiling anew", path.display());
                Vec::new()
            }),
            Err(error) => {
                log::debug!("pipeline cache {}: {error}", path.display());
                Vec::new()
            }
        };
        let create = |data: &[u8]| {
            let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
            // SAFETY: the device is valid; the data is empty or what this driver gave before.
            unsafe { device.create_pipeline_cache(&info, None) }
        };
        // Pipelines can be compiled without a cache, so a failure here is only a line in the log.
        let (raw, loaded) = match create(&loaded) {
            Ok(raw) => (raw, loaded),
            Err(error) => {
                log::info!("pipeline cache {}: {error}; compiling anew", path.display());
                (create(&[]).unwrap_or_default(), Vec::new())
            }
        };
        if !loaded.is_empty() {
            log::debug!("pipeline cache: {} bytes from {}", loaded.len(), path.display());
        }
        Self { raw, path, loaded }
    }

    pub(super) fn raw(&self) -> vk::PipelineCache {
        self.raw
    }

    /// Writes the cache's file, if there is something new.
    pub(super) fn save(&self, device: &ash::Device) {
        if self.raw == vk::PipelineCache::null() {
            return;
        }
        // SAFETY: the cache is of this device, and nothing is compiled with it at the moment.
        let data = match unsafe { device.get_pipeline_cache_data(self.raw) } {
            Ok(data) if data.len() >= HEADER && data != self.loaded => data,
            Ok(_) => return,
            Err(error) => return log::info!("pipeline cache {}: {error}", self.path.display()),
        };
        match write(&self.path, &data) {
            Ok(()) => log::debug!("pipeline cache: {} bytes to {}", data.len(), self.path.display()),
            Err(error) => log::info!("pipeline cache: {error}"),
        }
    }

    /// Destroys the cache, which must happen before its device is destroyed.
    pub(super) fn destroy(self, device: &ash::Device) {
        // SAFETY: the cache is of this device and nothing uses it any more; null is allowed.
        unsafe { device.destroy_pipeline_cache(self.raw, None) };
    }
}

/// The name of the file for a device and its driver. Each has a file of its own, for none can use another's.
fn file_name(properties: &vk::PhysicalDeviceProperties) -> String {
    let uuid = properties.pipeline_cache_uuid.map(|byte| format!("{byte:02x}")).concat();
    format!(
        "pipelines-{:04x}-{:04x}-{:08x}-{uuid}.bin",
        properties.vendor_id, properties.device_id, properties.driver_version
    )
}

/// The driver's data in a file, or why it cannot be used.
fn open<'a>(bytes: &'a [u8], properties: &vk::PhysicalDeviceProperties) -> Result<&'a [u8], &'static str> {
    let (envelope, data) = bytes.split_at_checked(ENVELOPE).ok_or("it is cut short")?;
    let word =
        |at: usize| data.get(at..at + 4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
    if envelope[..8] != MAGIC {
        return Err("it is another kind of file");
    }
    if data.len() > MAX_BYTES {
        return Err("it has grown large");
    }
    if envelope[8..] != checksum(data).to_le_bytes() || data.len() < HEADER {
        return Err("it is damaged");
    }
    let header = [word(0), word(4), word(8), word(12)];
    let version = vk::PipelineCacheHeaderVersion::ONE.as_raw().cast_unsigned();
    let own = [HEADER as u32, version, properties.vendor_id, properties.device_id].map(Some);
    if header != own || data[16..HEADER] != properties.pipeline_cache_uuid {
        return Err("it is another device's");
    }
    Ok(data)
}

fn write(path: &Path, data: &[u8]) -> Result<()> {
    if let Some(folder) = path.parent() {
        // Where the folder cannot be made, writing the file fails below, with an error that says why.
        let _ = std::fs::create_dir_all(folder);
    }
    PendingFile::create(path)?.write(&[&MAGIC[..], &checksum(data).to_le_bytes(), data].concat())
}

/// FNV-1a, by G. Fowler, L. C. Noll and K.-P. Vo. It finds damage, not malice.
fn checksum(data: &[u8]) -> u64 {
    data.iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}
