//! The passes. Each has a pipeline, and a `record()` that records its dispatch. Trace, accumulate and resolve, in this
//! order, make every picture. Select belongs to adaptive pictures, pick finds what lies under one pixel, and geometry
//! finds the normal and the depth of the surface under every pixel. A pass, its shader, its file and its debug label
//! share one name. Every `Result` can have the errors of [`crate::vulkan`].

mod accumulate;
mod adaptive;
mod aperture;
mod blue_noise;
mod facet_albedo;
mod geometry;
mod pick;
mod resolve;
mod scene_buffers;
mod select;
mod trace;

pub use accumulate::Accumulate;
pub use adaptive::AdaptiveBuffers;
pub use aperture::ApertureBuffers;
pub use blue_noise::BlueNoiseTile;
pub use facet_albedo::FacetAlbedo;
pub use geometry::Geometry;
pub use pick::{Pick, PickBindings};
pub use resolve::{Resolve, ResolveKind};
pub use scene_buffers::SceneBuffers;
pub use select::Select;
pub use trace::Trace;

use crate::vulkan::Shader;

/// The shaders of the passes. Tests replace them by shaders with a planted fault, and expect to find it.
#[derive(Debug, Clone, Copy)]
pub struct Shaders {
    /// Pass 1, which traces a batch of samples, for each [integrator](crate::interface::integrator).
    pub trace: [Shader; 2],
    /// Pass 2, which merges the batch into the film.
    pub accumulate: Shader,
    /// The pass between batches of an adaptive picture, which lists the pixels to go on with.
    pub select: Shader,
    /// Pass 3, which turns the film into a picture.
    pub resolve: Shader,
    /// The pass that finds what lies under one pixel.
    pub pick: Shader,
    /// The pass that finds the surface under every pixel, for overlays.
    pub geometry: Shader,
}

impl Default for Shaders {
    fn default() -> Self {
        Self {
            trace: Trace::SHADERS,
            accumulate: Accumulate::SHADER,
            select: Select::SHADER,
            resolve: Resolve::SHADER,
            pick: Pick::SHADER,
            geometry: Geometry::SHADER,
        }
    }
}
