//! Images that surfaces and the sky show. They are read whole, into linear colours of 16 bits a channel, which is also what a
//! device reads.

use super::{MAX_EXTENT, MAX_LENGTH, linear_of_srgb};
use crate::error::{Error, Result};
use crate::input_file;
use glam::{DVec3, Vec3};
use half::f16;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The most memory that reading an image may take, in bytes: an image of the largest size, with 4 floats a pixel.
const MAX_MEMORY: u64 = 16 * (MAX_EXTENT as u64) * (MAX_EXTENT as u64);

/// A shared image. Two are equal if they come from the same loading.
#[derive(Clone)]
pub struct Image(Arc<Texels>);

/// The texels of an image.
pub struct Texels {
    /// The number of columns and rows.
    pub size: [u32; 2],
    /// Linear r, g, b and opacity, divided by [`Self::scale`], row by row from the top left.
    pub texels: Vec<[f16; 4]>,
    /// What the colours are multiplied by. It is 1 unless a colour is too bright for 16 bits.
    pub scale: f32,
    /// As bright as it is anywhere, in each channel.
    pub brightest: Vec3,
    /// The file that it was read from.
    pub file: PathBuf,
}

impl std::fmt::Debug for Image {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} ({:?} texels)", self.file.display(), self.size)
    }
}

impl PartialEq for Image {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl std::ops::Deref for Image {
    type Target = Texels;

    fn deref(&self) -> &Texels {
        &self.0
    }
}

impl Image {
    /// Reads a PNG, JPEG, OpenEXR or Radiance HDR file. The colours of PNG and JPEG are encoded as sRGB says (IEC 61966-2-1);
    /// those of the other two are linear already. Colours below 0 become 0.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Image`] for a file of another kind, one that is damaged, or one that is too large.
    pub fn read(path: &Path) -> Result<Self> {
        let error = |message: String| Error::Image { file: path.display().to_string(), message };
        let (file, beginning) = input_file::open_with_beginning(path)?;
        let format = image::guess_format(&beginning).ok().filter(|format| {
            matches!(format, ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::OpenExr | ImageFormat::Hdr)
        });
        let Some(format) = format else {
            let is = input_file::kind(&beginning).map_or_else(String::new, |kind| format!(": it is {kind}"));
            return Err(error(format!(
                "it is not an image that can be read{is}; save it as PNG, JPEG, EXR or HDR"
            )));
        };
        let decoded = input_file::guarded(|| decode(BufReader::new(file), format));
        let image = decoded.unwrap_or_else(|| Err("it is damaged; save it anew".into())).map_err(error)?;
        Ok(Self::of(&image, matches!(format, ImageFormat::Png | ImageFormat::Jpeg), path))
    }

    fn of(image: &DynamicImage, encoded: bool, path: &Path) -> Self {
        let size = [image.width(), image.height()];
        // Neither a NaN nor what is infinite is a colour.
        let linear = |channel: f32| {
            let channel = if encoded { linear_of_srgb(channel.into()) as f32 } else { channel };
            if channel > 0.0 { channel.min(MAX_LENGTH) } else { 0.0 }
        };
        let texels = image.to_rgba32f();
        let colors = || texels.pixels().map(|image::Rgba([r, g, b, _])| [*r, *g, *b].map(linear));
        let brightest = colors().map(Vec3::from_array).fold(Vec3::ZERO, Vec3::max);
        let scale = (brightest.max_element() / f16::MAX.to_f32()).max(1.0);
        let stored = |channel: f32| f16::from_f32(channel / scale);
        let opacity = |image::Rgba([.., a]): &image::Rgba<f32>| f16::from_f32(a.clamp(0.0, 1.0));
        let texels = colors()
            .zip(texels.pixels().map(opacity))
            .map(|(color, opacity)| {
                let [r, g, b] = color.map(stored);
                [r, g, b, opacity]
            })
            .collect();
        let brightest = scale * (brightest / scale).map(|channel| f16::from_f32(channel).to_f32());
        Self(Arc::new(Texels { size, texels, scale, brightest, file: path.to_path_buf() }))
    }

    /// The colour of a texel.
    pub fn color(&self, [x, y]: [u32; 2]) -> DVec3 {
        let [r, g, b, _] = self.texels[y as usize * self.size[0] as usize + x as usize];
        f64::from(self.scale) * DVec3::new(r.into(), g.into(), b.into())
    }
}

/// Decodes a file of this format.
fn decode(file: BufReader<std::fs::File>, format: ImageFormat) -> Result<DynamicImage, String> {
    let damaged = |error: image::ImageError| match error {
        image::ImageError::Limits(_) => "it takes too much memory; make it smaller".to_owned(),
        other => format!("it is damaged ({other}); save it anew"),
    };
    let mut reader = ImageReader::with_format(file, format);
    let mut limits = image::Limits::no_limits();
    limits.max_alloc = Some(MAX_MEMORY);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > MAX_EXTENT || width.min(height) == 0 {
        return Err(format!(
            "it has {width} x {height} pixels, and may have 1 to {MAX_EXTENT} either way; scale it"
        ));
    }
    DynamicImage::from_decoder(decoder).map_err(damaged)
}
