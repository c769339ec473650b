//! The table that rough materials read.

use crate::error::Result;
use crate::interface::binding;
use crate::vulkan::{Binding, Device, TexelBuffer};
use std::sync::Arc;

/// The table of `examples/facet_albedo.rs` on the device, for every shader that uses `shaders/material/albedo.glsl`.
#[derive(Clone)]
pub struct FacetAlbedo(Arc<TexelBuffer>);

impl FacetAlbedo {
    /// Uploads the table.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        let table = include_bytes!("../../shaders/facet_albedo.bin");
        Ok(Self(Arc::new(TexelBuffer::upload(device, "facet albedo", table)?)))
    }

    /// The binding from which the shaders read the table.
    pub fn binding(&self) -> (u32, Binding) {
        (binding::FACET_ALBEDO, Binding::Texels(Arc::clone(&self.0)))
    }
}
