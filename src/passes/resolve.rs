//! Turns the film's means into a picture.

use super::Adaptive;
use crate::error::Result;
use crate::gpu_types::ResolvePush;
use crate::interface::{binding, constant};
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 3. See `shaders/resolve.comp`.
pub struct Resolve {
    with_holes: ComputePipeline,
    without_holes: ComputePipeline,
    /// With what an overlay needs, for films with moments and without, once one was shown.
    overlays: [Option<ComputePipeline>; 2],
    shader: Shader,
}

impl Resolve {
    /// The shader.
    pub const SHADER: Shader = shader!("resolve");

    /// Compiles the pass from its shader, or one with the same interface.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(device: &Arc<Device>, shader: Shader) -> Result<Self> {
        let with = |has_holes| pipeline(device, shader, has_holes, false, false);
        Ok(Self { with_holes: with(true)?, without_holes: with(false)?, overlays: [None, None], shader })
    }

    /// Compiles what overlays need, unless it is there: to be called before one is recorded.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn prepare_overlay(&mut self, device: &Arc<Device>, has_moments: bool) -> Result<()> {
        let overlay = &mut self.overlays[usize::from(has_moments)];
        if overlay.is_none() {
            *overlay = Some(pipeline(device, self.shader, true, true, has_moments)?);
        }
        Ok(())
    }

    /// From `film` into `picture`. Overlays also look at `depth` and `moments`.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(
        &self,
        film: &Arc<Image>,
        picture: &Arc<Image>,
        depth: &Arc<Image>,
        adaptive: &Adaptive,
    ) -> Result<BindingSet> {
        let image = |image: &Arc<Image>| Binding::Image(Arc::clone(image));
        let bindings = [
            (binding::FILM_IMAGE, image(film)),
            (binding::PICTURE_IMAGE, image(picture)),
            (binding::DEPTH_IMAGE, image(depth)),
            adaptive.bind_active(0),
        ];
        BindingSet::new(&self.with_holes, &[&bindings[..], &[adaptive.bind_film_moments()]].concat())
    }

    /// Resolves the whole picture. Without `has_holes` every texel that it looks at must have a sample.
    /// `has_moments`: whether the film does.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &ResolvePush,
        has_holes: bool,
        has_moments: bool,
    ) {
        let plain = if has_holes { &self.with_holes } else { &self.without_holes };
        let overlay = self.overlays[usize::from(has_moments)].as_ref().filter(|_| push.overlay.kind != 0);
        let pipeline = overlay.unwrap_or(plain);
        let cells = push.extent.map(|pixels| pixels.div_ceil(push.preview_stride));
        recording.dispatch(pipeline, bindings, bytemuck::bytes_of(push), cells);
    }
}

fn pipeline(
    device: &Arc<Device>,
    shader: Shader,
    has_holes: bool,
    has_overlay: bool,
    has_moments: bool,
) -> Result<ComputePipeline> {
    let constants = [
        (constant::HAS_HOLES, has_holes.into()),
        (constant::HAS_OVERLAY, has_overlay.into()),
        (constant::HAS_MOMENTS, has_moments.into()),
    ];
    ComputePipeline::new(device, shader, &constants)
}
