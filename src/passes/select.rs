//! Lists the pixels of an adaptive picture that are still to be traced.

use super::AdaptiveBuffers;
use crate::error::Result;
use crate::gpu_types::SelectPush;
use crate::vulkan::{BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// The pass that follows pass 2 between the batches of an adaptive picture. See `shaders/select.comp`.
pub struct Select(ComputePipeline);

impl Select {
    /// The shader.
    pub const SHADER: Shader = shader!("select");

    /// Compiles the pass from its shader, or from one with the same interface.
    pub fn new(device: &Arc<Device>, shader: Shader, estimator: &[(u32, u32)]) -> Result<Self> {
        Ok(Self(ComputePipeline::new(device, shader, estimator)?))
    }

    /// The pass reads the pixels of the list with the number `list` in `adaptive`, and writes those that `film` shows
    /// to be noisy to the other list. It empties the texels of the pixels that stop in the tracing image `traced`.
    pub fn bind(
        &self,
        traced: &Arc<Image>,
        film: &Arc<Image>,
        adaptive: &AdaptiveBuffers,
        list: usize,
    ) -> Result<BindingSet> {
        let others = [adaptive.bind_kept(1 - list), adaptive.bind_film_moments(), adaptive.bind_brightest()];
        BindingSet::new(&self.0, &[&adaptive.bind_images(traced, film, list)[..], &others].concat())
    }

    /// Selects from `extent` pixels of the push constants' lattice.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &SelectPush,
        extent: [u32; 2],
    ) {
        recording.dispatch(&self.0, bindings, bytemuck::bytes_of(push), extent);
    }
}
