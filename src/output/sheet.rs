//! A sheet of pictures side by side, with a line of text under each.

use crate::error::{Error, Result};
use crate::scene::MAX_EXTENT;
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

/// The margin around the sheet and between its pictures, in pixels.
const MARGIN: u32 = 16;
/// Grey, as sRGB bytes.
const BACKGROUND: u8 = 24;
const LABEL: u8 = 235;
const DETAIL: u8 = 160;
/// The height of letters in pixels, where the pictures are large enough.
const LETTERS: [f32; 2] = [14.0, 40.0];
/// The height of letters below smaller pictures, as a share of the picture's height.
const LETTERS_SHARE: f32 = 1.0 / 20.0;

/// The sheet, built picture by picture.
pub(super) struct Sheet {
    picture: [u32; 2],
    columns: u32,
    size: [u32; 2],
    letters: f32,
    font: FontRef<'static>,
    /// r, g, b, a, row by row from the top left.
    rgba: Vec<u8>,
}

impl Sheet {
    /// A sheet for so many pictures of this size, in so many columns, or else in about as many columns as rows.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it grows too large, or has columns that stay empty.
    pub(super) fn new(picture: [u32; 2], count: u32, columns: Option<u32>) -> Result<Self> {
        let columns = columns.unwrap_or_else(|| f64::from(count).sqrt().ceil() as u32);
        if columns == 0 || columns > count {
            return Err(Error::OutOfRange(format!("columns is {columns}, but must be from 1 to {count}")));
        }
        let letters = (LETTERS_SHARE * picture[1] as f32).clamp(LETTERS[0], LETTERS[1]).floor();
        let rows = count.div_ceil(columns);
        let size = [
            u64::from(MARGIN) + u64::from(columns) * u64::from(picture[0] + MARGIN),
            u64::from(rows) * u64::from(picture[1] + row_gap(letters)) + u64::from(MARGIN),
        ];
        if size.iter().any(|extent| *extent > u64::from(MAX_EXTENT)) {
            let [width, height] = size;
            return Err(Error::OutOfRange(format!(
                "the sheet would have {width} x {height} pixels, and may have {MAX_EXTENT} at most either \
                 way; make --size smaller"
            )));
        }
        let size = size.map(|extent| extent as u32);
        let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).expect("it is a font");
        let mut rgba = vec![BACKGROUND; 4 * size[0] as usize * size[1] as usize];
        rgba.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 255);
        Ok(Self { picture, columns, size, letters, font, rgba })
    }

    /// Pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// r, g, b, a bytes row by row from the top left.
    pub(super) fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// Puts the picture with this index in its place, and writes under it: on the left its name, and on the right what else
    /// there is to know, if there is room.
    pub(super) fn place(&mut self, index: u32, rgba: &[u8], [label, detail]: &[String; 2]) {
        let [width, height] = self.picture;
        let left = MARGIN + index % self.columns * (width + MARGIN);
        let top = MARGIN + index / self.columns * (height + row_gap(self.letters));
        for (row, pixels) in rgba.chunks_exact(4 * width as usize).enumerate() {
            let start = 4 * ((top as usize + row) * self.size[0] as usize + left as usize);
            self.rgba[start..start + pixels.len()].copy_from_slice(pixels);
        }
        let baseline = (top + height) as f32 + 1.2 * self.letters;
        let room = width as f32;
        let widths = [label, detail].map(|text| self.line(text, self.letters).1);
        let shrunk = self.letters * (room / widths[0]).min(1.0);
        self.write(left as f32, baseline, label, shrunk, LABEL);
        if widths[0] + self.letters + widths[1] <= room {
            self.write(left as f32 + room - widths[1], baseline, detail, self.letters, DETAIL);
        }
    }

    /// The letters of a line that begins at 0, and the width of the line.
    fn line(&self, text: &str, letters: f32) -> (Vec<Glyph>, f32) {
        let font = self.font.as_scaled(PxScale::from(letters));
        let (mut glyphs, mut x) = (Vec::<Glyph>::new(), 0.0);
        for letter in text.chars() {
            let mut glyph = font.scaled_glyph(letter);
            x += glyphs.last().map_or(0.0, |last| font.kern(last.id, glyph.id));
            glyph.position = point(x, 0.0);
            x += font.h_advance(glyph.id);
            glyphs.push(glyph);
        }
        (glyphs, x)
    }

    fn write(&mut self, left: f32, baseline: f32, text: &str, letters: f32, grey: u8) {
        let [width, height] = self.size;
        for mut glyph in self.line(text, letters).0 {
            glyph.position += point(left, baseline);
            let Some(outline) = self.font.outline_glyph(glyph) else { continue };
            let bounds = outline.px_bounds();
            let rgba = &mut self.rgba;
            outline.draw(|x, y, coverage| {
                let (x, y) = (bounds.min.x as u32 + x, bounds.min.y as u32 + y);
                if x < width && y < height {
                    let at = 4 * (y as usize * width as usize + x as usize);
                    for part in &mut rgba[at..at + 3] {
                        let under = f32::from(*part);
                        *part = (under + coverage.min(1.0) * (f32::from(grey) - under)).round() as u8;
                    }
                }
            });
        }
    }
}

/// The height of what lies between two rows of pictures: a line of text, and the margins around it.
fn row_gap(letters: f32) -> u32 {
    (1.7 * letters) as u32 + MARGIN / 2
}
