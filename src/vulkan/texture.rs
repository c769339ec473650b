//! Pictures that imgui's renderer draws.

use super::command::LAYER;
use super::{Buffer, Commands, Device, Image, Residence, check};
use crate::error::Result;
use ash::vk;
use std::sync::Arc;

/// A picture of four bytes a pixel, with the descriptor set by which imgui's renderer reads it. The renderer must be
/// dropped before it.
pub struct Texture {
    image: Image,
    sampler: vk::Sampler,
    layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    device: Arc<Device>,
}

impl Texture {
    /// Uploads a picture, row by row from the top left, and waits until it is there.
    ///
    /// # Errors
    /// [`Error::Limit`](crate::error::Error::Limit) where the device has no images as wide or high.
    pub fn new(device: &Arc<Device>, name: &'static str, extent: [u32; 2], rgba: &[[u8; 4]]) -> Result<Self> {
        let mut texture = Self {
            // imgui's colours are those of the screen, so the format converts nothing.
            image: Image::sampled(device, name, extent)?,
            sampler: vk::Sampler::null(),
            layout: vk::DescriptorSetLayout::null(),
            pool: vk::DescriptorPool::null(),
            set: vk::DescriptorSet::null(),
            device: Arc::clone(device),
        };
        texture.make_set()?;
        texture.fill(extent, rgba)?;
        Ok(texture)
    }

    /// What imgui's renderer knows the picture by.
    pub fn descriptor_set(&self) -> vk::DescriptorSet {
        self.set
    }

    /// Makes the descriptor set, in the layout of imgui's renderer: one picture for the fragment shader.
    fn make_set(&mut self) -> Result<()> {
        let raw = &self.device.raw;
        let edge = vk::SamplerAddressMode::CLAMP_TO_EDGE;
        let sampler = vk::SamplerCreateInfo::default()
            .mag_filter(vk::Filter::LINEAR)
            .min_filter(vk::Filter::LINEAR)
            .address_mode_u(edge)
            .address_mode_v(edge)
            .address_mode_w(edge);
        let kind = vk::DescriptorType::COMBINED_IMAGE_SAMPLER;
        let bindings = [vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(kind)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::FRAGMENT)];
        let layout = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: 1 }];
        let pool = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: the device is valid, and `self` owns each handle before anything else can fail. The set is of this
        // layout and pool, and nothing uses it yet.
        unsafe {
            self.sampler = check("creating a sampler", raw.create_sampler(&sampler, None))?;
            self.layout =
                check("creating a descriptor set layout", raw.create_descriptor_set_layout(&layout, None))?;
            self.pool = check("creating a descriptor pool", raw.create_descriptor_pool(&pool, None))?;
            let layouts = [self.layout];
            let sets =
                vk::DescriptorSetAllocateInfo::default().descriptor_pool(self.pool).set_layouts(&layouts);
            self.set = check("allocating a descriptor set", raw.allocate_descriptor_sets(&sets))?[0];
            let image = [vk::DescriptorImageInfo::default()
                .sampler(self.sampler)
                .image_view(self.image.view)
                .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)];
            let write =
                vk::WriteDescriptorSet::default().dst_set(self.set).descriptor_type(kind).image_info(&image);
            raw.update_descriptor_sets(&[write], &[]);
        }
        Ok(())
    }

    fn fill(&self, [width, height]: [u32; 2], rgba: &[[u8; 4]]) -> Result<()> {
        let bytes: &[u8] = rgba.as_flattened();
        let mut staging = Buffer::new(&self.device, "staging", bytes.len() as u64, Residence::Staging)?;
        staging.write(bytes);
        let mut commands = Commands::new(&self.device)?;
        let mut recording = commands.begin()?;
        let (undefined, written) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
        let nothing = (vk::PipelineStageFlags2::NONE, vk::AccessFlags2::NONE);
        let transfer = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
        recording.transition(self.image.raw, undefined, nothing, written, transfer);
        let region = [vk::BufferImageCopy::default().image_subresource(LAYER).image_extent(vk::Extent3D {
            width,
            height,
            depth: 1,
        })];
        // SAFETY: recording is under way, the transition above gave the image this layout, and the buffer has its pixels.
        unsafe {
            self.device.raw.cmd_copy_buffer_to_image(
                recording.raw(),
                staging.raw,
                self.image.raw,
                written,
                &region,
            );
        }
        let sampled = (vk::PipelineStageFlags2::FRAGMENT_SHADER, vk::AccessFlags2::SHADER_SAMPLED_READ);
        let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        recording.transition(self.image.raw, written, transfer, read, sampled);
        recording.submit()?;
        commands.wait()
    }
}

impl Drop for Texture {
    fn drop(&mut self) {
        // SAFETY: whoever draws with the texture holds it until that is done; null handles are allowed.
        unsafe {
            self.device.raw.destroy_descriptor_pool(self.pool, None);
            self.device.raw.destroy_descriptor_set_layout(self.layout, None);
            self.device.raw.destroy_sampler(self.sampler, None);
        }
    }
}
