//! The small pictures of the built-in scenes.

use crate::error::{Error, Result};
use crate::scene::BUILTINS;
use crate::vulkan::{Device, Texture};
use std::io::Cursor;
use std::sync::Arc;

/// Uploads the thumbnails as one picture, one below the other, in the order of the built-in scenes.
pub(super) fn upload(device: &Arc<Device>) -> Result<Texture> {
    let damaged = |error: png::DecodingError| Error::Window(format!("a thumbnail is damaged: {error}"));
    let (mut width, mut rgba) = (0, Vec::new());
    for builtin in &BUILTINS {
        let mut reader = png::Decoder::new(Cursor::new(builtin.thumbnail)).read_info().map_err(damaged)?;
        let mut rgb = vec![0; reader.output_buffer_size().unwrap_or(0)];
        width = reader.next_frame(&mut rgb).map_err(damaged)?.width;
        rgba.extend(rgb.as_chunks().0.iter().map(|[red, green, blue]| [*red, *green, *blue, 255]));
    }
    let height = u32::try_from(rgba.len()).unwrap_or(u32::MAX) / width.max(1);
    Texture::new(device, "thumbnails", [width, height], &rgba)
}
