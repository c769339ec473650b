//! Recording and submitting commands.

use super::image::WHOLE;
use super::{BindingSet, Buffer, ComputePipeline, Device, Image, Timer, check};
use crate::error::Result;
use ash::vk;
use std::ffi::CString;
use std::sync::Arc;

/// The commands that a barrier ties together: their stages, and how they use the memory.
pub(super) type Scope = (vk::PipelineStageFlags2, vk::AccessFlags2);

/// A command buffer that is recorded, submitted, waited for, and recorded again.
pub struct Commands {
    pool: vk::CommandPool,
    buffer: vk::CommandBuffer,
    fence: vk::Fence,
    /// Whether a submission has signalled the fence, or will.
    submitted: bool,
    /// The passes that are recorded, in their order.
    passes: Vec<&'static str>,
    device: Arc<Device>,
}

/// Commands being recorded. They run once [`Recording::submit`] is called.
pub struct Recording<'a> {
    commands: &'a mut Commands,
}

impl Commands {
    /// An idle command buffer.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        let mut commands = Self {
            pool: vk::CommandPool::null(),
            buffer: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            submitted: false,
            passes: Vec::new(),
            device: Arc::clone(device),
        };
        let pool = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER)
            .queue_family_index(device.queue_family);
        let fence = vk::FenceCreateInfo::default();
        // SAFETY: the device is valid. Each handle is owned by `commands` before the next call can fail.
        unsafe {
            commands.pool = check("creating a command pool", device.raw.create_command_pool(&pool, None))?;
            commands.fence = check("creating a fence", device.raw.create_fence(&fence, None))?;
            let buffer = vk::CommandBufferAllocateInfo::default()
                .command_pool(commands.pool)
                .level(vk::CommandBufferLevel::PRIMARY)
                .command_buffer_count(1);
            let buffers = device.raw.allocate_command_buffers(&buffer);
            commands.buffer = check("allocating a command buffer", buffers)?[0];
        }
        Ok(commands)
    }

    /// The pool that the command buffer comes from, for imgui's renderer.
    pub fn raw_pool(&self) -> vk::CommandPool {
        self.pool
    }

    /// Waits until what was submitted last is done.
    pub fn wait(&self) -> Result<()> {
        if !self.submitted {
            return Ok(());
        }
        // SAFETY: the fence is of this device, and a submission signals it.
        let result = unsafe { self.device.raw.wait_for_fences(&[self.fence], true, u64::MAX) };
        self.device.check("waiting for the device", result)
    }

    /// Waits, then starts recording anew.
    pub fn begin(&mut self) -> Result<Recording<'_>> {
        self.wait()?;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the command buffer is not in use. It is reset first, for a recording may have been dropped
        // before it was submitted.
        let result = unsafe {
            let reset = vk::CommandBufferResetFlags::empty();
            let result = self.device.raw.reset_command_buffer(self.buffer, reset);
            result.and_then(|()| self.device.raw.begin_command_buffer(self.buffer, &info))
        };
        check("beginning a command buffer", result)?;
        self.passes.clear();
        Ok(Recording { commands: self })
    }
}

impl Drop for Commands {
    fn drop(&mut self) {
        // A device that is lost has ended its work too, so an error does not matter.
        let _ = self.wait();
        // SAFETY: the last submission is waited for; null handles are allowed.
        unsafe {
            self.device.raw.destroy_fence(self.fence, None);
            self.device.raw.destroy_command_pool(self.pool, None);
        }
    }
}

impl Recording<'_> {
    /// The command buffer that is recorded, for imgui's renderer.
    pub fn raw(&self) -> vk::CommandBuffer {
        self.commands.buffer
    }

    pub(super) fn device(&self) -> &Device {
        &self.commands.device
    }

    /// Runs `pipeline` for `extent` invocations, rounded up to whole workgroups.
    pub fn dispatch(
        &mut self,
        pipeline: &ComputePipeline,
        bindings: &BindingSet,
        push: &[u8],
        extent: [u32; 2],
    ) {
        let device = self.device();
        let buffer = self.raw();
        let groups = pipeline.workgroups(extent);
        self.begin_label(pipeline.name());
        // SAFETY: recording is under way; the set was made for this pipeline's layout; push covers
        // the pipeline's range, which `assert_push_size` asserts.
        unsafe {
            device.raw.cmd_bind_pipeline(buffer, vk::PipelineBindPoint::COMPUTE, pipeline.raw);
            device.raw.cmd_bind_descriptor_sets(
                buffer,
                vk::PipelineBindPoint::COMPUTE,
                pipeline.layout,
                0,
                &[bindings.raw],
                &[],
            );
            pipeline.assert_push_size(push);
            if !push.is_empty() {
                let stage = vk::ShaderStageFlags::COMPUTE;
                device.raw.cmd_push_constants(buffer, pipeline.layout, stage, 0, push);
            }
            device.raw.cmd_dispatch(buffer, groups[0], groups[1], 1);
        }
        self.end_label();
        if self.commands.passes.last() != Some(&pipeline.name()) {
            self.commands.passes.push(pipeline.name());
        }
    }

    /// The boundary between two passes: compute and transfer commands after it see all that those before it wrote, and so
    /// does the host once it has waited for the fence.
    pub fn barrier(&mut self) {
        let stages = vk::PipelineStageFlags2::COMPUTE_SHADER | vk::PipelineStageFlags2::ALL_TRANSFER;
        let writes = vk::AccessFlags2::SHADER_STORAGE_WRITE | vk::AccessFlags2::TRANSFER_WRITE;
        // Reads of texel buffers count as sampled reads.
        let reads = vk::AccessFlags2::SHADER_STORAGE_READ
            | vk::AccessFlags2::SHADER_SAMPLED_READ
            | vk::AccessFlags2::UNIFORM_READ
            | vk::AccessFlags2::TRANSFER_READ;
        let barrier = [vk::MemoryBarrier2::default()
            .src_stage_mask(stages)
            .src_access_mask(writes)
            .dst_stage_mask(stages | vk::PipelineStageFlags2::HOST)
            .dst_access_mask(reads | writes | vk::AccessFlags2::HOST_READ)];
        self.depend(&vk::DependencyInfo::default().memory_barriers(&barrier));
    }

    /// Gives an image another layout. The commands `after` it see what those `before` it wrote to the image.
    pub(super) fn transition(
        &mut self,
        image: vk::Image,
        old: vk::ImageLayout,
        before: Scope,
        new: vk::ImageLayout,
        after: Scope,
    ) {
        let barrier = [vk::ImageMemoryBarrier2::default()
            .image(image)
            .subresource_range(WHOLE)
            .old_layout(old)
            .src_stage_mask(before.0)
            .src_access_mask(before.1)
            .new_layout(new)
            .dst_stage_mask(after.0)
            .dst_access_mask(after.1)];
        self.depend(&vk::DependencyInfo::default().image_memory_barriers(&barrier));
    }

    /// Sets every value of an image to zero, whatever its layout was, and leaves it in GENERAL.
    pub fn clear(&mut self, image: &Image) {
        let stages = vk::PipelineStageFlags2::COMPUTE_SHADER | vk::PipelineStageFlags2::ALL_TRANSFER;
        let writes = vk::AccessFlags2::SHADER_STORAGE_WRITE | vk::AccessFlags2::TRANSFER_WRITE;
        let transfer = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
        let (undefined, general) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::GENERAL);
        self.transition(image.raw, undefined, (stages, writes), general, transfer);
        // SAFETY: recording is under way, and the transition above gave the image this layout.
        unsafe {
            self.device().raw.cmd_clear_color_image(
                self.raw(),
                image.raw,
                vk::ImageLayout::GENERAL,
                &vk::ClearColorValue { float32: [0.0; 4] },
                &[WHOLE],
            );
        }
        self.barrier();
    }

    /// Sets the first `size` bytes to zero.
    pub fn clear_buffer(&mut self, buffer: &Buffer, size: u64) {
        // SAFETY: recording is under way; callers give a size within the buffer, a multiple of four.
        unsafe { self.device().raw.cmd_fill_buffer(self.raw(), buffer.raw, 0, size, 0) };
        self.barrier();
    }

    /// Writes up to 64 KiB to the start of a buffer, a multiple of four bytes.
    pub fn update_buffer(&mut self, buffer: &Buffer, bytes: &[u8]) {
        self.barrier();
        // SAFETY: recording is under way; callers give no more than the buffer holds.
        unsafe { self.device().raw.cmd_update_buffer(self.raw(), buffer.raw, 0, bytes) };
        self.barrier();
    }

    /// Copies the first `size` bytes.
    pub fn copy_buffer(&mut self, from: &Buffer, to: &Buffer, size: u64) {
        let region = [vk::BufferCopy::default().size(size)];
        // SAFETY: recording is under way; callers give a size within both buffers.
        unsafe { self.device().raw.cmd_copy_buffer(self.raw(), from.raw, to.raw, &region) };
        self.barrier();
    }

    /// Copies an image to another one of the same extent and format.
    pub fn copy_to_image(&mut self, from: &Image, to: &Image) {
        let [width, height] = from.extent();
        let region = [vk::ImageCopy::default()
            .src_subresource(LAYER)
            .dst_subresource(LAYER)
            .extent(vk::Extent3D { width, height, depth: 1 })];
        let general = vk::ImageLayout::GENERAL;
        // SAFETY: recording is under way, both images are in this layout, and callers give equal ones.
        unsafe { self.device().raw.cmd_copy_image(self.raw(), from.raw, general, to.raw, general, &region) };
        self.barrier();
    }

    /// Copies an image's pixels to the start of a buffer, row by row without padding.
    pub fn copy_image(&mut self, from: &Image, to: &Buffer) {
        self.copy_rows(from, 0, from.extent()[1], to);
    }

    /// Copies `count` rows of an image's pixels, from the row `first` on, to the start of a buffer.
    pub fn copy_rows(&mut self, from: &Image, first: u32, count: u32, to: &Buffer) {
        self.copy_part(from, [0, first], [from.extent()[0], count], to);
    }

    /// Copies a part of an image, with this upper left pixel and this size, to the start of a buffer, row by row without
    /// padding.
    pub fn copy_part(&mut self, from: &Image, corner: [u32; 2], [width, height]: [u32; 2], to: &Buffer) {
        let [x, y] = corner.map(|at| i32::try_from(at).unwrap_or(i32::MAX));
        let offset = vk::Offset3D { x, y, z: 0 };
        let region = [vk::BufferImageCopy::default()
            .image_subresource(LAYER)
            .image_offset(offset)
            .image_extent(vk::Extent3D { width, height, depth: 1 })];
        // SAFETY: recording is under way, the image is in GENERAL, and callers give a part that lies within it and a
        // buffer that the part fits into.
        unsafe {
            self.device().raw.cmd_copy_image_to_buffer(
                self.raw(),
                from.raw,
                vk::ImageLayout::GENERAL,
                to.raw,
                &region,
            );
        }
        self.barrier();
    }

    /// Starts a timer. The barriers here and in [`Self::stop`] tie the timestamps to the commands between them: without
    /// them Vulkan promises no order, and lavapipe writes both timestamps late.
    pub fn start(&mut self, timer: &Timer) {
        if self.device().timestamp_period > 0.0 {
            // SAFETY: recording is under way and the pool has two queries.
            unsafe {
                self.device().raw.cmd_reset_query_pool(self.raw(), timer.pool, 0, 2);
                let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
                self.device().raw.cmd_write_timestamp2(self.raw(), stage, timer.pool, 0);
            }
            self.barrier();
        }
    }

    /// Stops a timer, after all commands recorded so far.
    pub fn stop(&mut self, timer: &Timer) {
        if self.device().timestamp_period > 0.0 {
            self.barrier();
            let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
            // SAFETY: recording is under way and the query was reset by `start`.
            unsafe { self.device().raw.cmd_write_timestamp2(self.raw(), stage, timer.pool, 1) };
        }
    }

    /// Ends the recording and hands it to the device.
    pub fn submit(self) -> Result<()> {
        self.submit_between(&[], &[])
    }

    /// Ends the recording and hands it to the device, which waits for some semaphores before it and signals others after.
    pub(super) fn submit_between(
        self,
        wait: &[vk::SemaphoreSubmitInfo<'_>],
        signal: &[vk::SemaphoreSubmitInfo<'_>],
    ) -> Result<()> {
        let device = Arc::clone(&self.commands.device);
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(self.raw())];
        let submit = [vk::SubmitInfo2::default()
            .command_buffer_infos(&buffers)
            .wait_semaphore_infos(wait)
            .signal_semaphore_infos(signal)];
        self.commands.submitted = false;
        if !device.health.submits(&self.commands.passes) {
            return Err(device.health.error());
        }
        // SAFETY: the recording ends here; `begin` waited for the fence, so it is not in use.
        unsafe {
            check("ending a command buffer", device.raw.end_command_buffer(self.raw()))?;
            check("resetting a fence", device.raw.reset_fences(&[self.commands.fence]))?;
            let result = device.raw.queue_submit2(*device.queue(), &submit, self.commands.fence);
            device.check("submitting commands", result)?;
        }
        self.commands.submitted = true;
        Ok(())
    }

    pub(super) fn depend(&mut self, dependency: &vk::DependencyInfo<'_>) {
        // SAFETY: recording is under way; the dependency names live images.
        unsafe { self.device().raw.cmd_pipeline_barrier2(self.raw(), dependency) };
    }

    fn begin_label(&self, name: &str) {
        if let (Some(debug), Ok(name)) = (&self.device().debug, CString::new(name)) {
            let label = vk::DebugUtilsLabelEXT::default().label_name(&name);
            // SAFETY: recording is under way.
            unsafe { debug.cmd_begin_debug_utils_label(self.raw(), &label) };
        }
    }

    fn end_label(&self) {
        if let Some(debug) = &self.device().debug {
            // SAFETY: recording is under way, and a label was begun.
            unsafe { debug.cmd_end_debug_utils_label(self.raw()) };
        }
    }
}

pub(super) const LAYER: vk::ImageSubresourceLayers = vk::ImageSubresourceLayers {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    mip_level: 0,
    base_array_layer: 0,
    layer_count: 1,
};
