//! The images and buffers that an adaptive picture needs besides the tracing and the accumulation image: see
//! `shaders/core/adaptive.glsl`.

use crate::error::Result;
use crate::gpu_types::Brightest;
use crate::interface::binding;
use crate::vulkan::{Binding, Buffer, Device, Image, Recording, Residence};
use std::sync::Arc;

/// The second moments of the pixels, and the lists of active pixels. Without moments, all have the size of one pixel.
pub struct AdaptiveBuffers {
    /// The second moments of the tracing image, then those of the accumulation image.
    moments: [Arc<Image>; 2],
    /// Two lists of active pixels: a selection reads one and writes the other. A list is the number of its pixels, then
    /// an entry for each pixel.
    lists: [Arc<Buffer>; 2],
    /// See [`Brightest`].
    brightest: Arc<Buffer>,
}

impl AdaptiveBuffers {
    /// The number of bytes in a list before its first pixel.
    pub const LIST_HEADER: u64 = size_of::<u32>() as u64;

    /// Makes them for a picture of this size, or, with `None`, for a film without second moments.
    pub fn new(device: &Arc<Device>, size: Option<[u32; 2]>) -> Result<Self> {
        let size = size.unwrap_or([1, 1]);
        let moments = |name| Image::r32f(device, name, size).map(Arc::new);
        let bytes = Self::LIST_HEADER * (1 + u64::from(size[0]) * u64::from(size[1]));
        let [_, columns, rows] = Brightest::grid(size);
        let cells = size_of::<f32>() as u64 * u64::from(columns * rows);
        let list = || Buffer::new(device, "active pixels", bytes, Residence::Device).map(Arc::new);
        Ok(Self {
            moments: [moments("moments of the tracing image")?, moments("moments of the film")?],
            lists: [list()?, list()?],
            brightest: Buffer::new(device, "brightest", cells, Residence::Device).map(Arc::new)?,
        })
    }

    /// The second moments of the tracing image, then those of the accumulation image.
    pub fn moments(&self) -> &[Arc<Image>; 2] {
        &self.moments
    }

    /// One of the two lists.
    pub fn list(&self, list: usize) -> &Buffer {
        &self.lists[list]
    }

    /// The bindings that two passes share: the tracing image `traced`, the accumulation image `film`, and the list of
    /// active pixels to read.
    pub(super) fn bind_images(
        &self,
        traced: &Arc<Image>,
        film: &Arc<Image>,
        list: usize,
    ) -> [(u32, Binding); 3] {
        [
            (binding::TRACED_IMAGE, Binding::Image(Arc::clone(traced))),
            (binding::FILM_IMAGE, Binding::Image(Arc::clone(film))),
            self.bind_active(list),
        ]
    }

    /// Binds one of the lists as the active pixels.
    pub fn bind_active(&self, list: usize) -> (u32, Binding) {
        (binding::ACTIVE_PIXELS, Binding::Buffer(Arc::clone(&self.lists[list])))
    }

    /// Binds one of the lists as the pixels that a selection keeps.
    pub(super) fn bind_kept(&self, list: usize) -> (u32, Binding) {
        (binding::KEPT_PIXELS, Binding::Buffer(Arc::clone(&self.lists[list])))
    }

    /// Writes the upper bounds of the luminance that rays can meet.
    pub fn record_brightest(&self, recording: &mut Recording<'_>, brightest: &Brightest) {
        recording.update_buffer(&self.brightest, bytemuck::cast_slice(&brightest.luminances));
    }

    pub(super) fn bind_brightest(&self) -> (u32, Binding) {
        (binding::BRIGHTEST, Binding::Buffer(Arc::clone(&self.brightest)))
    }

    pub(super) fn bind_traced_moments(&self) -> (u32, Binding) {
        (binding::TRACED_MOMENTS, Binding::Image(Arc::clone(&self.moments[0])))
    }

    pub(super) fn bind_film_moments(&self) -> (u32, Binding) {
        (binding::FILM_MOMENTS, Binding::Image(Arc::clone(&self.moments[1])))
    }
}
