//! Finds what the camera sees at one place of the film.

use super::{ApertureBuffers, BlueNoiseTile, SceneBuffers};
use crate::error::Result;
use crate::gpu_types::{PickPush, PickedRay};
use crate::interface::binding;
use crate::vulkan::{
    Binding, BindingSet, Buffer, ComputePipeline, Device, Recording, Residence, Shader, shader,
};
use std::sync::Arc;

/// The pick pass, which takes no part in making a picture. See `shaders/pick.comp`.
pub struct Pick {
    pipeline: ComputePipeline,
    tile: BlueNoiseTile,
    device: Arc<Device>,
}

/// The resources that the pass reads, and the buffer that it writes the rays to.
pub struct PickBindings {
    rays: Arc<Buffer>,
    set: BindingSet,
}

impl Pick {
    /// The shader.
    pub const SHADER: Shader = shader!("pick");
    /// The most rays of a fan.
    pub const MAX_FAN: u32 = 65;
    /// The most samples that the pass follows.
    pub const MAX_SAMPLES: u32 = 256;

    /// Compiles the pass from its shader, or from one with the same interface, for the constants of an
    /// estimator and a scene.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        estimator: &[(u32, u32)],
        scene: &SceneBuffers,
        tile: &BlueNoiseTile,
    ) -> Result<Self> {
        let constants = [scene.constants(), estimator].concat();
        let pipeline = ComputePipeline::new(device, shader, &constants)?;
        Ok(Self { pipeline, tile: tile.clone(), device: Arc::clone(device) })
    }

    /// The pass traces `scene` through `aperture` and writes to a buffer that the host reads.
    pub fn bind(&self, scene: &SceneBuffers, aperture: &ApertureBuffers) -> Result<PickBindings> {
        let max_rays = 1 + 2 * Self::MAX_FAN + Self::MAX_SAMPLES;
        let size = u64::from(max_rays) * size_of::<PickedRay>() as u64;
        let rays = Arc::new(Buffer::new(&self.device, "picked rays", size, Residence::Host)?);
        let mut bindings = scene.bindings();
        bindings.push((binding::PICKED_RAYS, Binding::Buffer(Arc::clone(&rays))));
        bindings.extend(aperture.bindings());
        bindings.push(self.tile.binding());
        Ok(PickBindings { rays, set: BindingSet::new(&self.pipeline, &bindings)? })
    }

    /// Traces the rays: the one through the centre of the lens, then those of the two fans, then the samples.
    pub fn record(&self, recording: &mut Recording<'_>, bindings: &PickBindings, push: &PickPush) {
        let rays = 1 + 2 * push.fan + push.samples;
        recording.dispatch(&self.pipeline, &bindings.set, bytemuck::bytes_of(push), [rays, 1]);
    }
}

impl PickBindings {
    /// The first `rays` rays and what they met. The commands that trace them must have finished.
    pub fn read(&self, rays: usize) -> Vec<PickedRay> {
        bytemuck::allocation::pod_collect_to_vec(&self.rays.bytes()[..rays * size_of::<PickedRay>()])
    }
}
