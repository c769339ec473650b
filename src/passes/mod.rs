//! The passes, in the order of the data: a pipeline and its `record()` each. Trace, accumulate and resolve
//! make every picture; select belongs to adaptive ones, pick says what lies under a pixel, and geometry how
//! deep all of them see. A pass, its shader, its file and its debug label
//! share one name. Every `Result` can have the errors of [`crate::vulkan`].

mod accumulate;
mod adaptive;
mod aperture;
mod blue_noise;
mod geometry;
mod pick;
mod resolve;
mod scene_buffers;
mod select;
mod trace;

pub use accumulate::Accumulate;
pub use adaptive::Adaptive;
pub use aperture::ApertureBuffers;
pub use blue_noise::BlueNoiseTile;
pub use geometry::Geometry;
pub use pick::{Pick, PickBindings};
pub use resolve::{Resolve, ResolveKind};
pub use scene_buffers::SceneBuffers;
pub use select::Select;
pub use trace::Trace;

use crate::vulkan::Shader;

/// The shaders of the passes. Tests put others in their place, to see a mistake found.
#[derive(Debug, Clone, Copy)]
pub struct Shaders {
    /// Pass 1.
    pub trace: Shader,
    /// Pass 2.
    pub accumulate: Shader,
    /// Between batches of an adaptive picture.
    pub select: Shader,
    /// Pass 3.
    pub resolve: Shader,
    /// Beside them.
    pub pick: Shader,
    /// For overlays.
    pub geometry: Shader,
}

impl Default for Shaders {
    fn default() -> Self {
        Self {
            trace: Trace::SHADER,
            accumulate: Accumulate::SHADER,
            select: Select::SHADER,
            resolve: Resolve::SHADER,
            pick: Pick::SHADER,
            geometry: Geometry::SHADER,
        }
    }
}
