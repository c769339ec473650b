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

    /// Compiles the pass from its shader, or one with the same interface, for the sampler that the
    /// samples were made with.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>, shader: Shader, sampler: u32) -> Result<Self> {
        Ok(Self(ComputePipeline::new(device, shader, &[sampler])?))
    }

    /// Width and height of a workgroup: tiles are cut at multiples of it.
    pub fn local_size(&self) -> [u32; 2] {
        self.0.local_size()
    }

    /// From the tracing image `batch` into `film`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(&self, batch: &Arc<Image>, film: &Arc<Image>) -> Result<BindingSet> {
        let images = [(0, Binding::Image(Arc::clone(batch))), (1, Binding::Image(Arc::clone(film)))];
        BindingSet::new(&self.0, &images)
    }

    /// Merges `extent` pixels of the push constants' lattice.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &AccumulatePush,
        extent: [u32; 2],
    ) {
        recording.dispatch(&self.0, bindings, bytemuck::bytes_of(push), extent);
    }
}
