//! The aperture on the device: see `shaders/aperture/record.glsl`.

use crate::error::Result;
use crate::gpu_types::ApertureBuffer;
use crate::interface::binding;
use crate::vulkan::{Binding, Buffer, Device, Recording, Residence, TexelBuffer};
use std::sync::Arc;

/// The buffers of an aperture, which the passes read.
pub struct ApertureBuffers {
    shape: Arc<Buffer>,
    sums: Arc<TexelBuffer>,
}

impl ApertureBuffers {
    /// Uploads the running sums of the aperture's image, if it has one. The shape must be written with
    /// [`Self::record`] before a pass reads it.
    pub fn new(device: &Arc<Device>, sums: &[[f32; 4]]) -> Result<Self> {
        let size = size_of::<ApertureBuffer>() as u64;
        Ok(Self {
            shape: Arc::new(Buffer::new(device, "aperture", size, Residence::Device)?),
            sums: Arc::new(TexelBuffer::upload(device, "aperture image", sums)?),
        })
    }

    /// Records the commands that write the shape.
    pub fn record(&self, recording: &mut Recording<'_>, shape: &ApertureBuffer) {
        recording.update_buffer(&self.shape, bytemuck::bytes_of(shape));
    }

    /// The bindings from which the shaders read the aperture.
    pub fn bindings(&self) -> [(u32, Binding); 2] {
        [
            (binding::APERTURE, Binding::Buffer(Arc::clone(&self.shape))),
            (binding::APERTURE_SUMS, Binding::Texels(Arc::clone(&self.sums))),
        ]
    }
}
