//! Asks what the camera sees at one place of the film.

use super::{BlueNoiseTile, Opening, SceneBuffers};
use crate::error::Result;
use crate::gpu_types::{PickPush, PickedRay};
use crate::interface::binding;
use crate::vulkan::{
    Binding, BindingSet, Buffer, ComputePipeline, Device, FRAMES_IN_FLIGHT, Recording, Residence, Shader,
    shader,
};
use std::sync::Arc;

/// Beside the passes of a picture. See `shaders/pick.comp`.
pub struct Pick {
    pipeline: ComputePipeline,
    /// What was met, and where it is written, for each frame in flight.
    frames: Vec<(Arc<Buffer>, BindingSet)>,
}

impl Pick {
    /// The shader.
    pub const SHADER: Shader = shader!("pick");
    /// Rays of a fan, and samples, at most.
    pub const MOST_FAN: u32 = 65;
    /// Likewise.
    pub const MOST_SAMPLES: u32 = 256;

    /// Compiles the pass from its shader, or one with the same interface, for a scene seen through an
    /// opening, and the constants of the estimator.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        estimator: &[(u32, u32)],
        scene: &SceneBuffers,
        opening: &Opening,
        tile: &BlueNoiseTile,
    ) -> Result<Self> {
        let constants = [scene.constants(), estimator].concat();
        let pipeline = ComputePipeline::new(device, shader, &constants)?;
        let most_rays = 1 + 2 * Self::MOST_FAN + Self::MOST_SAMPLES;
        let frame = || {
            let size = u64::from(most_rays) * size_of::<PickedRay>() as u64;
            let rays = Arc::new(Buffer::new(device, "picked rays", size, Residence::Host)?);
            let mut bindings = scene.bindings();
            bindings.push((binding::PICKED_RAYS, Binding::Buffer(Arc::clone(&rays))));
            bindings.extend(opening.bindings());
            bindings.push(tile.binding());
            let bindings = BindingSet::new(&pipeline, &bindings)?;
            Ok((rays, bindings))
        };
        let frames = (0..FRAMES_IN_FLIGHT).map(|_| frame()).collect::<Result<_>>()?;
        Ok(Self { pipeline, frames })
    }

    /// Traces the rays: the first, those of two fans, and the samples.
    pub fn record(&self, recording: &mut Recording<'_>, frame: usize, push: &PickPush) {
        let (_, bindings) = &self.frames[frame];
        let rays = 1 + 2 * push.fan + push.samples;
        recording.dispatch(&self.pipeline, bindings, bytemuck::bytes_of(push), [rays, 1]);
    }

    /// What so many of them met, once the commands of the frame are done.
    pub fn read(&self, frame: usize, rays: usize) -> Vec<PickedRay> {
        let (buffer, _) = &self.frames[frame];
        bytemuck::allocation::pod_collect_to_vec(&buffer.bytes()[..rays * size_of::<PickedRay>()])
    }
}
