//! Picture files.

use super::Origin;
use super::PictureFormat;
use crate::error::{Error, Result};
use crate::pending_file::{PendingFile, keep_apart};
use crate::renderer::Renderer;
use crate::settings::Settings;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use std::io::Cursor;
use std::path::Path;

/// Saves the picture that a renderer has by now, with the samples that it has so far. The renderer's target is that number
/// afterwards.
///
/// # Errors
/// [`Error::UnknownFormat`], [`Error::OutOfRange`] while there is no whole pass yet, [`Error::Write`], or those of
/// rendering.
pub fn save(renderer: &mut Renderer, settings: &Settings, path: &Path) -> Result<()> {
    let format = PictureFormat::of(path).ok_or_else(|| Error::UnknownFormat(path.to_path_buf()))?;
    renderer.settle()?;
    let samples = renderer.progress().samples;
    if samples == 0 {
        return Err(Error::OutOfRange(
            "the picture has no sample in every pixel yet; save it in a moment".into(),
        ));
    }
    let settings = Settings { samples, ..settings.clone() };
    renderer.set(&settings)?;
    // Settings that the film was not rendered with would have started it anew.
    if renderer.progress().samples != samples {
        return Err(Error::OutOfRange("the picture has just changed; save it in a moment".into()));
    }
    keep_apart(&[("the picture", path)], &settings.files())?;
    write_picture(renderer, &settings, format, PendingFile::create(path)?)
}

/// Saves settings as a scene file: [`Settings::scene_file`].
///
/// # Errors
/// [`Error::OutOfRange`] for a name that does not end in `.toml`, [`Error::Write`], or those of reading the scene's file.
pub fn save_scene(settings: &Settings, path: &Path) -> Result<()> {
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("toml")) {
        return Err(Error::OutOfRange(format!("a scene file is a .toml; {} is not", path.display())));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut files = settings.files();
    // A scene may be saved over itself, but not over its mesh.
    let source = &settings.estimator.scene.source;
    if source.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
        files.retain(|(_, file)| file != source);
    }
    keep_apart(&[("the scene", path)], &files)?;
    let text = settings.scene_file(folder.unwrap_or(Path::new(".")))?;
    PendingFile::create(path)?.write(text.as_bytes())
}

/// Writes the picture that a renderer has, with the settings that it was rendered with.
///
/// # Errors
/// [`Error::Write`], or those of rendering.
pub fn write_picture(
    renderer: &mut Renderer,
    settings: &Settings,
    format: PictureFormat,
    file: PendingFile,
) -> Result<()> {
    let (size, origin) = (settings.estimator.size, Origin::new(settings.arguments()));
    match format {
        PictureFormat::Png => write_png(file, size, &renderer.read_picture()?, Some(&origin)),
        PictureFormat::Exr => write_exr(file, size, &renderer.read_film()?, Some(&origin)),
    }
}

/// Writes an sRGB picture, given as r, g, b, a bytes row by row from the top left, and how it was made. The
/// alpha is left out.
///
/// # Errors
/// [`crate::error::Error::Write`].
pub fn write_png(
    file: PendingFile,
    [width, height]: [u32; 2],
    rgba: &[u8],
    origin: Option<&Origin>,
) -> Result<()> {
    let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        // About twenty times as fast as the default, which would take a fifth of the time of a quick picture. The file of
        // a picture with little noise grows by a seventh.
        encoder.set_compression(png::Compression::Fast);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        if let Some(origin) = origin {
            origin.add_to_png(&mut encoder)?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&rgb)?;
        writer.finish()?;
        Ok(bytes)
    };
    let bytes = encode().map_err(|error| not_encoded(file.path(), &error))?;
    file.write(&bytes)
}

/// Writes the film, given as mean r, g, b and count row by row from the top left: linear f32
/// channels R, G, B and count; and how it was made.
///
/// # Errors
/// [`crate::error::Error::Write`].
pub fn write_exr(
    file: PendingFile,
    [width, height]: [u32; 2],
    film: &[[f32; 4]],
    origin: Option<&Origin>,
) -> Result<()> {
    let channel = |name: &str, index: usize| {
        let values = film.iter().map(|pixel| pixel[index]).collect();
        AnyChannel::new(name, FlatSamples::F32(values))
    };
    let channels = [channel("R", 0), channel("G", 1), channel("B", 2), channel("count", 3)];
    let mut attributes = LayerAttributes::default();
    attributes.other.extend(origin.map(Origin::attribute));
    let layer = Layer::new(
        (width as usize, height as usize),
        attributes,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.map_err(|error| not_encoded(file.path(), &error))?;
    file.write(bytes.get_ref())
}

fn not_encoded(path: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::Write { path: path.to_path_buf(), reason: error.to_string() }
}
