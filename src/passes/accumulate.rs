//! Merges the tracing image into the film.

use super::BlueNoiseTile;
use crate::error::Result;
use crate::gpu_types::AccumulatePush;
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 2. See `shaders/accumulate.comp`.
pub struct Accumulate {
    pipeline: ComputePipeline,
    tile: BlueNoiseTile,
}

impl Accumulate {
    /// The shader.
    pub const SHADER: Shader = shader!("accumulate");

    /// Compiles the pass from its shader, or one with the same interface, for the sampler that the
    /// samples were made with.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>, shader: Shader, sampler: u32, tile: &BlueNoiseTile) -> Result<Self> {
        Ok(Self { pipeline: ComputePipeline::new(device, shader, &[sampler])?, tile: tile.clone() })
    }

    /// Width and height of a workgroup: tiles are cut at multiples of it.
    pub fn local_size(&self) -> [u32; 2] {
        self.pipeline.local_size()
    }

    /// From the tracing image `batch` into `film`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(&self, batch: &Arc<Image>, film: &Arc<Image>) -> Result<BindingSet> {
        let (batch, film) = (Binding::Image(Arc::clone(batch)), Binding::Image(Arc::clone(film)));
        BindingSet::new(&self.pipeline, &[(0, batch), (1, film), self.tile.binding()])
    }

    /// Merges `extent` pixels of the push constants' lattice.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &AccumulatePush,
        extent: [u32; 2],
    ) {
        recording.dispatch(&self.pipeline, bindings, bytemuck::bytes_of(push), extent);
    }
}
