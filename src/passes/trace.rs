//! Traces a batch of samples for each pixel of a lattice into the tracing image.

use super::{AdaptiveBuffers, ApertureBuffers, BlueNoiseTile, FacetAlbedo, SceneBuffers};
use crate::error::Result;
use crate::gpu_types::TracePush;
use crate::interface::binding;
use crate::vulkan::{Binding, BindingSet, Buffer, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 1. See `shaders/core/trace_pass.glsl`.
pub struct Trace {
    pipeline: ComputePipeline,
    tile: BlueNoiseTile,
    /// Only for an integrator that scatters light from rough surfaces.
    albedo: Option<FacetAlbedo>,
    /// Whether the integrator samples lamps and the sky.
    samples_light: bool,
}

impl Trace {
    /// The shader of each integrator.
    pub const SHADERS: [Shader; 2] = [shader!("trace"), shader!("trace_path")];

    /// Compiles the pass from its shader, or one with the same interface, for the constants of an
    /// estimator and a scene.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        estimator: &[(u32, u32)],
        scene: &SceneBuffers,
        tile: &BlueNoiseTile,
        albedo: &FacetAlbedo,
    ) -> Result<Self> {
        let constants = [scene.constants(), estimator].concat();
        let pipeline = ComputePipeline::new(device, shader, &constants)?;
        let resources = shader.interface().resources;
        let samples_light = resources.contains_key(&binding::LAMPS);
        let albedo = resources.contains_key(&binding::FACET_ALBEDO).then(|| albedo.clone());
        Ok(Self { pipeline, tile: tile.clone(), albedo, samples_light })
    }

    /// The pass traces `scene` through `aperture` into the tracing image `traced`, and adds to `counters`. Once some
    /// pixels have stopped, the list with the number `list` in `adaptive` holds the pixels to trace.
    pub fn bind(
        &self,
        scene: &SceneBuffers,
        aperture: &ApertureBuffers,
        traced: &Arc<Image>,
        counters: &Arc<Buffer>,
        adaptive: &AdaptiveBuffers,
        list: usize,
    ) -> Result<BindingSet> {
        let mut bindings = scene.bindings();
        if self.samples_light {
            bindings.extend(scene.of_sampled_light());
        }
        bindings.extend(self.albedo.as_ref().map(FacetAlbedo::binding));
        bindings.extend(aperture.bindings());
        bindings.extend([
            (binding::TRACED_IMAGE, Binding::Image(Arc::clone(traced))),
            (binding::COUNTERS, Binding::Buffer(Arc::clone(counters))),
            adaptive.bind_active(list),
            adaptive.bind_traced_moments(),
            self.tile.binding(),
        ]);
        BindingSet::new(&self.pipeline, &bindings)
    }

    /// Traces `extent` pixels of the push constants' lattice.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &TracePush,
        extent: [u32; 2],
    ) {
        recording.dispatch(&self.pipeline, bindings, bytemuck::bytes_of(push), extent);
    }
}
