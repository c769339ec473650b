//! Picture files. A file appears whole or not at all.

use crate::error::{Error, Result};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use std::ffi::OsString;
use std::fs::File;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

/// The formats of pictures, chosen by the file's name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8-bit sRGB.
    Png,
    /// Linear f32, with the count of samples.
    Exr,
}

impl PictureFormat {
    /// The format that a path asks for.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_lowercase().as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            _ => None,
        }
    }
}

/// Writes an sRGB picture, given as r, g, b, a bytes row by row from the top left. The alpha is
/// left out.
///
/// # Errors
/// [`Error::Write`].
pub fn write_png(file: PendingFile, [width, height]: [u32; 2], rgba: &[u8]) -> Result<()> {
    let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&rgb)?;
        writer.finish()?;
        Ok(bytes)
    };
    let bytes = encode().map_err(|error| failed(&file.path, &error))?;
    file.write(&bytes)
}

/// Writes the film, given as mean r, g, b and count row by row from the top left: linear f32
/// channels R, G, B and count.
///
/// # Errors
/// [`Error::Write`].
pub fn write_exr(file: PendingFile, [width, height]: [u32; 2], film: &[[f32; 4]]) -> Result<()> {
    let channel = |name: &str, index: usize| {
        let values = film.iter().map(|pixel| pixel[index]).collect();
        AnyChannel::new(name, FlatSamples::F32(values))
    };
    let channels = [channel("R", 0), channel("G", 1), channel("B", 2), channel("count", 3)];
    let layer = Layer::new(
        (width as usize, height as usize),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.map_err(|error| failed(&file.path, &error))?;
    file.write(bytes.get_ref())
}

/// A file that is written beside its place and renamed, so that nobody sees half of it. Made before
/// the work, so that a wrong path is known before it.
pub struct PendingFile {
    path: PathBuf,
    part: PathBuf,
    file: File,
}

impl PendingFile {
    /// Creates the file beside `path`.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn create(path: &Path) -> Result<Self> {
        if path.is_dir() {
            return Err(failed(path, &"it is a folder"));
        }
        let mut name = OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(format!(".{}.part", std::process::id()));
        let part = path.with_file_name(name);
        let file = File::create(&part).map_err(|error| failed(path, &error))?;
        Ok(Self { path: path.to_path_buf(), part, file })
    }

    /// Writes it whole and puts it in its place.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(mut self, bytes: &[u8]) -> Result<()> {
        let written = self.file.write_all(bytes).and_then(|()| self.file.sync_all());
        let placed = written.and_then(|()| std::fs::rename(&self.part, &self.path));
        placed.map_err(|error| failed(&self.path, &error))
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        // Gone already where it was put in its place.
        let _ = std::fs::remove_file(&self.part);
    }
}

fn failed(path: &Path, reason: &dyn std::fmt::Display) -> Error {
    Error::Write { path: path.to_path_buf(), reason: reason.to_string() }
}
