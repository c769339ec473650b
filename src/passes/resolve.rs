//! Turns the film's means into a picture.

use super::AdaptiveBuffers;
use crate::error::Result;
use crate::gpu_types::ResolvePush;
use crate::interface::{binding, constant};
use crate::vulkan::{Binding, BindingSet, ComputePipeline, Device, Image, Recording, Shader, shader};
use std::sync::Arc;

/// Pass 3. See `shaders/resolve.comp`.
pub struct Resolve(ComputePipeline);

/// The variants that the pass can be compiled as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResolveKind {
    /// Every texel that the pass reads has a sample.
    WithoutHoles,
    /// Some texels may have no sample.
    WithHoles,
    /// An overlay is shown, and some texels may have no sample.
    Overlay {
        /// Whether the film has second moments.
        has_moments: bool,
    },
}

impl Resolve {
    /// The shader.
    pub const SHADER: Shader = shader!("resolve");

    /// Compiles the pass from its shader, or from one with the same interface.
    pub fn new(device: &Arc<Device>, shader: Shader, kind: ResolveKind) -> Result<Self> {
        let has_moments = kind == ResolveKind::Overlay { has_moments: true };
        let constants = [
            (constant::HAS_HOLES, (kind != ResolveKind::WithoutHoles).into()),
            (constant::HAS_OVERLAY, matches!(kind, ResolveKind::Overlay { .. }).into()),
            (constant::HAS_MOMENTS, has_moments.into()),
        ];
        Ok(Self(ComputePipeline::new(device, shader, &constants)?))
    }

    /// The pass turns `film` into `picture`. The bindings serve every [`ResolveKind`]; overlays also read `surfaces`
    /// and the second moments of `adaptive`.
    pub fn bind(
        &self,
        film: &Arc<Image>,
        picture: &Arc<Image>,
        surfaces: &Arc<Image>,
        adaptive: &AdaptiveBuffers,
    ) -> Result<BindingSet> {
        let image = |image: &Arc<Image>| Binding::Image(Arc::clone(image));
        let bindings = [
            (binding::FILM_IMAGE, image(film)),
            (binding::PICTURE_IMAGE, image(picture)),
            (binding::SURFACE_IMAGE, image(surfaces)),
            adaptive.bind_active(0),
        ];
        BindingSet::new(&self.0, &[&bindings[..], &[adaptive.bind_film_moments()]].concat())
    }

    /// Resolves the whole picture.
    pub fn record(&self, recording: &mut Recording<'_>, bindings: &BindingSet, push: &ResolvePush) {
        let cells = push.extent.map(|pixels| pixels.div_ceil(push.preview_stride));
        recording.dispatch(&self.0, bindings, bytemuck::bytes_of(push), cells);
    }
}
