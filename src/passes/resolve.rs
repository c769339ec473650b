//! Turns the film's means into a picture.

use crate::error::Result;
use crate::gpu_types::ResolvePush;
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 3. See `shaders/resolve.comp`.
pub struct Resolve(ComputePipeline);

impl Resolve {
    /// The shader.
    pub const SHADER: Shader = shader!("resolve");

    /// Compiles the pass from its shader, or one with the same interface.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>, shader: Shader) -> Result<Self> {
        Ok(Self(ComputePipeline::new(device, shader, &[])?))
    }

    /// From `film` into `picture`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(&self, film: &Arc<Image>, picture: &Arc<Image>) -> Result<BindingSet> {
        let images = [(0, Binding::Image(Arc::clone(film))), (1, Binding::Image(Arc::clone(picture)))];
        BindingSet::new(&self.0, &images)
    }

    /// Resolves the whole picture.
    pub fn record(&self, recording: &mut Recording<'_>, bindings: &BindingSet, push: &ResolvePush) {
        recording.dispatch(&self.0, bindings, bytemuck::bytes_of(push), push.extent);
    }
}
