//! The limits of a device, and how it is best used. Every buffer and image is checked here before it is made, for
//! beyond the limits Vulkan promises nothing: specification of Vulkan 1.3, chapter "Limits".

use super::ResourceKind;
use crate::error::{Error, Result};
use ash::vk;

/// How many resources of each kind a shader binds, at most.
pub const NEEDED: [(ResourceKind, u32); 4] = [
    (ResourceKind::Buffer, 7),
    (ResourceKind::Uniform, 1),
    (ResourceKind::Image, 4),
    (ResourceKind::Texels, 7),
];

/// Lavapipe counts the steps of all loops of an invocation together, and silently leaves every loop after so many. A
/// sample that takes more steps would be wrong.
const SOFTWARE_LOOP_STEPS: u64 = 65_535;

/// How a device is best used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Traits {
    /// Whether an invocation copies a small scene to variables before it starts. A software device loads from a
    /// buffer lane by lane inside loops; a GPU would run out of registers.
    pub keeps_scene: bool,
    /// How often the loops of an invocation may go round, all counted together, if there is a limit.
    pub max_loop_steps: Option<u64>,
    /// The most steps that a ray may take in a tree of shapes, if there is a limit.
    pub max_tree_steps: Option<u32>,
}

impl Traits {
    /// The traits of a device that runs on the CPU. A ray takes some dozens of steps in a tree of a million triangles.
    /// Without a limit to them, no number of samples would be safe from the limit of loop steps.
    pub const SOFTWARE: Self =
        Self { keeps_scene: true, max_loop_steps: Some(SOFTWARE_LOOP_STEPS), max_tree_steps: Some(1024) };
    /// The traits of a GPU.
    pub const GPU: Self = Self { keeps_scene: false, max_loop_steps: None, max_tree_steps: None };
}

/// How large the parts can be that a device holds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    image_extent: u32,
    storage_bytes: u32,
    uniform_bytes: u32,
    texels: u32,
    buffer_bytes: u64,
}

impl Limits {
    pub(super) fn new(instance: &ash::Instance, device: vk::PhysicalDevice) -> Self {
        let mut maintenance = vk::PhysicalDeviceMaintenance4Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut maintenance);
        // SAFETY: the device is of this instance; the structures chain to live locals.
        unsafe { instance.get_physical_device_properties2(device, &mut properties) };
        let limits = properties.properties.limits;
        Self {
            image_extent: limits.max_image_dimension2_d,
            storage_bytes: limits.max_storage_buffer_range,
            uniform_bytes: limits.max_uniform_buffer_range,
            texels: limits.max_texel_buffer_elements,
            buffer_bytes: maintenance.max_buffer_size,
        }
    }

    /// # Errors
    /// [`Error::Limit`] where the device has no images as wide or high.
    pub(super) fn check_image(&self, what: &'static str, extent: [u32; 2]) -> Result<()> {
        let limit = Limit { unit: "pixels either way", name: "maxImageDimension2D", advice: PICTURE };
        limit.check(what, extent[0].max(extent[1]).into(), self.image_extent.into())
    }

    /// # Errors
    /// [`Error::Limit`] where the device has no buffers as large.
    pub(super) fn check_buffer(&self, what: &'static str, bytes: u64) -> Result<()> {
        Limit { unit: "bytes", name: "maxBufferSize", advice: BUFFER }.check(what, bytes, self.buffer_bytes)
    }

    /// # Errors
    /// [`Error::Limit`] where a shader cannot bind as much as a storage buffer.
    pub(super) fn check_storage(&self, what: &'static str, bytes: u64) -> Result<()> {
        let limit = Limit { unit: "bytes", name: "maxStorageBufferRange", advice: BUFFER };
        limit.check(what, bytes, self.storage_bytes.into())
    }

    /// # Errors
    /// [`Error::Limit`] where a shader cannot bind as much as a uniform buffer.
    pub(super) fn check_uniform(&self, what: &'static str, bytes: u64) -> Result<()> {
        let limit = Limit { unit: "bytes", name: "maxUniformBufferRange", advice: SCENE };
        limit.check(what, bytes, self.uniform_bytes.into())
    }

    /// # Errors
    /// [`Error::Limit`] where a shader cannot read as many bytes, in texels of 16.
    pub(super) fn check_texels(&self, what: &'static str, bytes: u64) -> Result<()> {
        let limit = Limit { unit: "texels", name: "maxTexelBufferElements", advice: SCENE };
        limit.check(what, bytes.div_ceil(16), self.texels.into())
    }
}

const PICTURE: &str = "use a smaller --size";
const SCENE: &str = "use fewer shapes or smaller images";
const BUFFER: &str = "use a smaller --size, or leave out --noise-threshold and the overlay of the error";

/// A limit of devices.
struct Limit {
    unit: &'static str,
    /// Its name in the specification.
    name: &'static str,
    advice: &'static str,
}

impl Limit {
    fn check(self, what: &'static str, wanted: u64, max: u64) -> Result<()> {
        let Self { unit, name, advice } = self;
        if wanted <= max {
            return Ok(());
        }
        Err(Error::Limit { what, unit, wanted, max, limit: format!("{name} of the device"), advice })
    }
}

/// Why a device whose limits are these cannot run the shaders.
pub(super) fn why_too_small(limits: &vk::PhysicalDeviceLimits) -> Option<String> {
    NEEDED.into_iter().find_map(|(kind, needed)| {
        let (max, what) = match kind {
            ResourceKind::Buffer => (limits.max_per_stage_descriptor_storage_buffers, "storage buffers"),
            ResourceKind::Uniform => (limits.max_per_stage_descriptor_uniform_buffers, "uniform buffers"),
            ResourceKind::Image => (limits.max_per_stage_descriptor_storage_images, "storage images"),
            ResourceKind::Texels => (limits.max_per_stage_descriptor_sampled_images, "texel buffers"),
        };
        (max < needed).then(|| format!("a shader can bind {max} {what}, needs {needed}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: Limits = Limits {
        image_extent: 4096,
        storage_bytes: 1 << 27,
        uniform_bytes: 16_384,
        texels: 65_536,
        buffer_bytes: 1 << 30,
    };

    fn words(result: Result<()>) -> String {
        result.expect_err("beyond the limit").to_string()
    }

    /// Catches a limit that is told as a lack of memory, or that is off by one.
    #[test]
    fn limits_are_told_as_what_they_are() {
        assert!(SMALL.check_texels("the tree", 16 * 65_536).is_ok());
        assert!(SMALL.check_image("the picture", [4096, 4096]).is_ok());
        assert!(SMALL.check_storage("the list", 1 << 27).is_ok());
        assert!(SMALL.check_buffer("the buffer", 1 << 30).is_ok());
        for (told, parts) in [
            (
                words(SMALL.check_texels("the tree", 16 * 65_536 + 1)),
                ["65537 texels", "65536", "maxTexelBufferElements"],
            ),
            (
                words(SMALL.check_image("the picture", [1, 4097])),
                ["4097 pixels", "4096", "maxImageDimension2D"],
            ),
            (
                words(SMALL.check_storage("the list", (1 << 27) + 4)),
                ["134217732 bytes", "134217728", "maxStorageBufferRange"],
            ),
            (
                words(SMALL.check_uniform("the scene", 16_385)),
                ["16385 bytes", "16384", "maxUniformBufferRange"],
            ),
            (
                words(SMALL.check_buffer("the buffer", (1 << 30) + 1)),
                ["1073741825 bytes", "1073741824", "maxBufferSize"],
            ),
        ] {
            for part in parts {
                assert!(told.contains(part), "{told}");
            }
        }
    }

    /// Catches a device that is taken although it cannot bind what the shaders need.
    #[test]
    fn a_device_that_binds_too_little_is_named() {
        let [(_, buffers), (_, uniforms), (_, images), (_, texels)] = NEEDED;
        let mut limits = vk::PhysicalDeviceLimits {
            max_per_stage_descriptor_storage_buffers: buffers,
            max_per_stage_descriptor_uniform_buffers: uniforms,
            max_per_stage_descriptor_storage_images: images,
            max_per_stage_descriptor_sampled_images: texels,
            ..Default::default()
        };
        assert_eq!(why_too_small(&limits), None);
        limits.max_per_stage_descriptor_storage_buffers -= 1;
        let told = format!("{} storage buffers, needs {buffers}", buffers - 1);
        assert!(why_too_small(&limits).is_some_and(|why| why.contains(&told)));
    }
}
