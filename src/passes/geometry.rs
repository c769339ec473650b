//! Finds how deep each pixel sees.

use super::SceneBuffers;
use crate::error::Result;
use crate::gpu_types::{Camera, GeometryPush};
use crate::interface::binding;
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Beside the passes of a picture. See `shaders/geometry.comp`.
pub struct Geometry {
    pipeline: ComputePipeline,
    bindings: BindingSet,
    depth: Arc<Image>,
}

/// Rows are cut so that a dispatch has no more pixels than these.
const MOST_PIXELS: u32 = 1 << 21;

impl Geometry {
    /// The shader.
    pub const SHADER: Shader = shader!("geometry");

    /// Compiles the pass from its shader, or one with the same interface, for a scene.
    /// It writes `depth`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        scene: &SceneBuffers,
        depth: &Arc<Image>,
    ) -> Result<Self> {
        let pipeline = ComputePipeline::new(device, shader, scene.constants())?;
        let mut bindings = scene.bindings();
        bindings.push((binding::DEPTH_IMAGE, Binding::Image(Arc::clone(depth))));
        let bindings = BindingSet::new(&pipeline, &bindings)?;
        Ok(Self { pipeline, bindings, depth: Arc::clone(depth) })
    }

    /// Whether this is what it writes.
    pub fn writes(&self, depth: &Arc<Image>) -> bool {
        Arc::ptr_eq(&self.depth, depth)
    }

    /// Traces a ray for each pixel.
    pub fn record(&self, recording: &mut Recording<'_>, camera: Camera) {
        let extent @ [width, height] = self.depth.extent();
        let [_, local] = self.pipeline.local_size();
        let rows = (MOST_PIXELS / width).max(1).next_multiple_of(local);
        let mut top = 0;
        while top < height {
            let push = GeometryPush { camera, extent, top };
            let size = [width, rows.min(height - top)];
            recording.dispatch(&self.pipeline, &self.bindings, bytemuck::bytes_of(&push), size);
            top += rows;
        }
    }
}
