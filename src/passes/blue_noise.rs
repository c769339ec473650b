//! The tile that the blue-noise sampler reads.

use crate::error::Result;
use crate::interface::binding;
use crate::vulkan::{Binding, Device, TexelBuffer};
use std::sync::Arc;

/// The tile of `examples/blue_noise_tile.rs` on the device, for every shader that uses
/// `shaders/core/sampling.glsl`.
#[derive(Clone)]
pub struct BlueNoiseTile(Arc<TexelBuffer>);

impl BlueNoiseTile {
    /// Uploads the tile.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        let numbers = include_bytes!("../../shaders/blue_noise_tile.bin");
        Ok(Self(Arc::new(TexelBuffer::upload(device, "blue-noise tile", numbers)?)))
    }

    /// The binding from which the shaders read the tile.
    pub fn binding(&self) -> (u32, Binding) {
        (binding::BLUE_NOISE_TILE, Binding::Texels(Arc::clone(&self.0)))
    }
}
