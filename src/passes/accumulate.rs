//! Merges the tracing image into the film.

use crate::error::Result;
use crate::gpu_types::AccumulatePush;
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 2. See `shaders/accumulate.comp`.
pub struct Accumulate(ComputePipeline);

impl Accumulate {
    /// The shader.
    pub const SHADER: Shader = shader!("accumulate");

    /// Compiles the pass.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>) -> Result<Self> {
        Ok(Self(ComputePipeline::new(device, Self::SHADER, &[])?))
    }

    /// From the tracing image `batch` into `film`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(&self, batch: &Arc<Image>, film: &Arc<Image>) -> Result<BindingSet> {
        let images = [(0, Binding::Image(Arc::clone(batch))), (1, Binding::Image(Arc::clone(film)))];
        BindingSet::new(&self.0, &images)
    }

    /// Merges the pixels of the push constants' lattice, of which there are `traced`. With a reach,
    /// every pixel of the film gathers.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &AccumulatePush,
        traced: [u32; 2],
    ) {
        let extent = if push.reach == 0 { traced } else { push.lattice.extent };
        recording.dispatch(&self.0, bindings, bytemuck::bytes_of(push), extent);
    }
}
