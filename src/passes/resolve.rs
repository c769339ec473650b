//! Turns the film's means into a picture.

use crate::error::Result;
use crate::gpu_types::ResolvePush;
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 3. See `shaders/resolve.comp`.
pub struct Resolve {
    with_holes: ComputePipeline,
    without_holes: ComputePipeline,
}

impl Resolve {
    /// The shader.
    pub const SHADER: Shader = shader!("resolve");

    /// Compiles the pass from its shader, or one with the same interface.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>, shader: Shader) -> Result<Self> {
        let with = |has_holes: bool| ComputePipeline::new(device, shader, &[has_holes.into()]);
        Ok(Self { with_holes: with(true)?, without_holes: with(false)? })
    }

    /// From `film` into `picture`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(&self, film: &Arc<Image>, picture: &Arc<Image>) -> Result<BindingSet> {
        let images = [(0, Binding::Image(Arc::clone(film))), (1, Binding::Image(Arc::clone(picture)))];
        BindingSet::new(&self.with_holes, &images)
    }

    /// Resolves the whole picture. Without `has_holes` every texel that it looks at must have a sample.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &ResolvePush,
        has_holes: bool,
    ) {
        let pipeline = if has_holes { &self.with_holes } else { &self.without_holes };
        let cells = push.extent.map(|pixels| pixels.div_ceil(push.preview_stride));
        recording.dispatch(pipeline, bindings, bytemuck::bytes_of(push), cells);
    }
}
