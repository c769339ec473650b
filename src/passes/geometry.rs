//! Finds the surface that the centre of each pixel sees.

use super::SceneBuffers;
use crate::error::Result;
use crate::gpu_types::GeometryPush;
use crate::interface::{GROUP_SIZE, binding, constant};
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// The geometry pass, which overlays need. See `shaders/geometry.comp`.
pub struct Geometry(ComputePipeline);

/// The most pixels of a dispatch. A picture with more takes several, each for some of its rows.
const MAX_PIXELS: u32 = 1 << 21;

impl Geometry {
    /// The shader.
    pub const SHADER: Shader = shader!("geometry");

    /// Compiles the pass from its shader, or from one with the same interface, for the constants of a scene.
    pub fn new(device: &Arc<Device>, shader: Shader, scene: &SceneBuffers) -> Result<Self> {
        // Nothing that is done to the lens changes the ray through its centre, except for a shift, which needs no code.
        let constants =
            [scene.constants(), &[(constant::HAS_MOVEMENTS, 0), (constant::HAS_DISPERSION, 0)]].concat();
        Ok(Self(ComputePipeline::new(device, shader, &constants)?))
    }

    /// The pass looks at `scene` and writes to the image `surfaces`.
    pub fn bind(&self, scene: &SceneBuffers, surfaces: &Arc<Image>) -> Result<BindingSet> {
        let mut bindings = scene.bindings();
        bindings.push((binding::SURFACE_IMAGE, Binding::Image(Arc::clone(surfaces))));
        BindingSet::new(&self.0, &bindings)
    }

    /// Traces a ray for each pixel of the picture.
    pub fn record(&self, recording: &mut Recording<'_>, bindings: &BindingSet, mut push: GeometryPush) {
        let [width, height] = push.extent;
        let rows = (MAX_PIXELS / width).max(1).next_multiple_of(GROUP_SIZE);
        while push.top < height {
            let size = [width, rows.min(height - push.top)];
            recording.dispatch(&self.0, bindings, bytemuck::bytes_of(&push), size);
            push.top += rows;
        }
    }
}
