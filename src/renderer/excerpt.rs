//! A small part of the picture, which is read back while the picture is shown.

use super::Renderer;
use crate::error::Result;
use crate::vulkan::{Buffer, FRAMES_IN_FLIGHT, Recording, Residence};

/// The pixels of the picture around one of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Excerpt {
    /// The column and the row of the pixel in the middle.
    pub middle: [u32; 2],
    /// The column and the row of the upper left pixel. The edge of the picture may be nearer to the middle.
    pub corner: [u32; 2],
    /// The number of columns and rows.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel in sRGB, row by row from the upper left.
    pub pixels: Vec<[u8; 3]>,
}

/// The buffers of the frames in flight, and what they will hold once the commands of the frame are done.
#[derive(Default)]
pub(super) struct Excerpts([Read; FRAMES_IN_FLIGHT]);

#[derive(Default)]
struct Read {
    buffer: Option<Buffer>,
    /// The excerpt without its pixels, and whether their bytes start with blue.
    asked: Option<(Excerpt, bool)>,
}

impl Excerpt {
    /// At most so many rows and columns on each side of the middle are read.
    pub const MAX_REACH: u32 = 256;

    /// The part of a picture of `extent` pixels that reaches so far from the pixel in the middle, without its pixels.
    fn around(middle: [u32; 2], reach: u32, extent: [u32; 2]) -> Self {
        let reach = reach.min(Self::MAX_REACH);
        let middle = [0, 1].map(|axis| middle[axis].min(extent[axis] - 1));
        let corner = middle.map(|at| at.saturating_sub(reach));
        let size = [0, 1].map(|axis| (middle[axis] + reach + 1).min(extent[axis]) - corner[axis]);
        Self { middle, corner, size, pixels: Vec::new() }
    }

    /// The part of a picture, whose pixels are given row by row from the upper left, around one of them.
    pub fn of(pixels: &[[u8; 3]], extent: [u32; 2], middle: [u32; 2], reach: u32) -> Self {
        let mut part = Self::around(middle, reach, extent);
        let [left, top] = part.corner;
        let [width, height] = part.size;
        for row in top..top + height {
            let start = (row * extent[0] + left) as usize;
            part.pixels.extend_from_slice(&pixels[start..start + width as usize]);
        }
        part
    }

    /// The colour of a pixel, which is so many columns to the right and rows below the middle. `None` outside of the
    /// picture, and outside of what was read.
    pub fn pixel(&self, right: i32, down: i32) -> Option<[u8; 3]> {
        let within = |axis: usize, offset: i32| {
            let at = self.middle[axis].checked_add_signed(offset)?.checked_sub(self.corner[axis])?;
            (at < self.size[axis]).then_some(at)
        };
        let (column, row) = (within(0, right)?, within(1, down)?);
        self.pixels.get((row * self.size[0] + column) as usize).copied()
    }
}

impl Renderer {
    /// Records the reading of the picture around a pixel, as it is after [`Renderer::record_resolve`].
    /// [`Renderer::excerpt`] returns it once the commands of `frame` are done.
    ///
    /// # Errors
    /// Those of [`crate::vulkan`].
    pub fn record_excerpt(
        &mut self,
        recording: &mut Recording<'_>,
        frame: usize,
        middle: [u32; 2],
        reach: u32,
    ) -> Result<()> {
        let part = Excerpt::around(middle, reach, self.picture().extent());
        let Read { buffer, asked } = &mut self.excerpts.0[frame];
        if buffer.is_none() {
            let widest = u64::from(2 * Excerpt::MAX_REACH + 1);
            let size = 4 * widest * widest;
            *buffer = Some(Buffer::new(&self.preparer.device, "excerpt", size, Residence::Staging)?);
        }
        if let Some(buffer) = buffer {
            recording.copy_part(&self.loaded.images.picture, part.corner, part.size, buffer);
            *asked = Some((part, self.blue_first));
        }
        Ok(())
    }

    /// The part of the picture that `frame` has read, whose commands must be done. `None` if it has read none, or if the
    /// part was returned already.
    pub fn excerpt(&mut self, frame: usize) -> Option<Excerpt> {
        let Read { buffer, asked } = &mut self.excerpts.0[frame];
        let (part, blue_first) = asked.take()?;
        let count = part.size[0] as usize * part.size[1] as usize;
        let bytes = &buffer.as_ref()?.bytes()[..4 * count];
        let color = |pixel: &[u8]| {
            if blue_first { [pixel[2], pixel[1], pixel[0]] } else { [pixel[0], pixel[1], pixel[2]] }
        };
        let pixels = bytes.chunks_exact(4).map(color).collect();
        Some(Excerpt { pixels, ..part })
    }
}
