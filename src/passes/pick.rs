//! Asks what the camera sees at one place of the film.

use super::SceneBuffers;
use crate::error::Result;
use crate::gpu_types::{PickPush, PickedRay};
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

    /// Compiles the pass from its shader, or one with the same interface, for a scene, and the constants of
    /// its estimator.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        estimator: [u32; 2],
        scene: &SceneBuffers,
    ) -> Result<Self> {
        let pipeline = ComputePipeline::new(device, shader, &scene.constants(estimator))?;
        let frame = || {
            let size = size_of::<PickedRay>() as u64;
            let rays = Arc::new(Buffer::new(device, "picked rays", size, Residence::Host)?);
            let bindings =
                BindingSet::new(&pipeline, &scene.bindings(&[Binding::Buffer(Arc::clone(&rays))]))?;
            Ok((rays, bindings))
        };
        let frames = (0..FRAMES_IN_FLIGHT).map(|_| frame()).collect::<Result<_>>()?;
        Ok(Self { pipeline, frames })
    }

    /// Traces the ray.
    pub fn record(&self, recording: &mut Recording<'_>, frame: usize, push: &PickPush) {
        let (_, bindings) = &self.frames[frame];
        recording.dispatch(&self.pipeline, bindings, bytemuck::bytes_of(push), [1, 1]);
    }

    /// What it met, once the commands of the frame are done.
    pub fn read(&self, frame: usize) -> PickedRay {
        let (rays, _) = &self.frames[frame];
        bytemuck::pod_read_unaligned(&rays.bytes()[..size_of::<PickedRay>()])
    }
}
