//! Merges the tracing image into the film.

use super::{AdaptiveBuffers, BlueNoiseTile};
use crate::error::Result;
use crate::gpu_types::AccumulatePush;
use crate::vulkan::{BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 2. See `shaders/accumulate.comp`.
pub struct Accumulate {
    pipeline: ComputePipeline,
    tile: BlueNoiseTile,
}

impl Accumulate {
    /// The shader.
    pub const SHADER: Shader = shader!("accumulate");

    /// Compiles the pass from its shader, or from one with the same interface, for the constants of the estimator that
    /// makes the samples.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        estimator: &[(u32, u32)],
        tile: &BlueNoiseTile,
    ) -> Result<Self> {
        Ok(Self { pipeline: ComputePipeline::new(device, shader, estimator)?, tile: tile.clone() })
    }

    /// The pass merges the tracing image `traced` into `film`. Once some pixels have stopped, the list with the number
    /// `list` in `adaptive` holds the pixels to merge.
    pub fn bind(
        &self,
        traced: &Arc<Image>,
        film: &Arc<Image>,
        adaptive: &AdaptiveBuffers,
        list: usize,
    ) -> Result<BindingSet> {
        let moments = [adaptive.bind_traced_moments(), adaptive.bind_film_moments()];
        let images = adaptive.bind_images(traced, film, list);
        BindingSet::new(&self.pipeline, &[&images[..], &moments, &[self.tile.binding()]].concat())
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
