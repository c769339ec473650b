//! Finds the surface that the centre of each pixel sees.

use super::SceneBuffers;
use crate::error::Result;
use crate::gpu_types::{Camera, GeometryPush};
use crate::interface::{GROUP_SIZE, binding};
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
        Ok(Self(ComputePipeline::new(device, shader, scene.constants())?))
    }

    /// The pass looks at `scene` and writes to the image `surfaces`.
    pub fn bind(&self, scene: &SceneBuffers, surfaces: &Arc<Image>) -> Result<BindingSet> {
        let mut bindings = scene.bindings();
        bindings.push((binding::SURFACE_IMAGE, Binding::Image(Arc::clone(surfaces))));
        BindingSet::new(&self.0, &bindings)
    }

    /// Traces a ray for each pixel of a picture of this extent.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        camera: Camera,
        extent: [u32; 2],
    ) {
        let [width, height] = extent;
        let rows = (MAX_PIXELS / width).max(1).next_multiple_of(GROUP_SIZE);
        let mut top = 0;
        while top < height {
            let push = GeometryPush { camera, extent, top };
            let size = [width, rows.min(height - top)];
            recording.dispatch(&self.0, bindings, bytemuck::bytes_of(&push), size);
            top += rows;
        }
    }
}
