//! How a picture was made, carried by its file: the arguments that render it again.

use crate::error::{Error, Result};
use crate::input_file;
use crate::settings::saved_names;
use exr::meta::attribute::{AttributeValue, Text as ExrText};
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The keyword of the text in a PNG, and the name of the attribute in an EXR.
const KEY: &str = "thinlens";
/// The most bytes that the text has once it is unpacked.
const MAX_TEXT: usize = 1 << 20;

/// What a picture file says of how it was made, as JSON.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The version of the program.
    version: String,
    /// The arguments that follow `thinlens render`, without `-o`.
    #[serde(with = "saved_names")]
    pub arguments: Vec<OsString>,
}

impl Origin {
    /// The origin of a picture that these arguments render.
    pub fn new(arguments: Vec<OsString>) -> Self {
        Self { version: env!("CARGO_PKG_VERSION").into(), arguments }
    }

    /// Reads it from a picture file.
    ///
    /// # Errors
    /// [`Error::Read`], [`Error::UnknownFormat`], or [`Error::NoOrigin`] where the file does not say.
    pub fn read(path: &Path) -> Result<Self> {
        let without = |why: String| Error::NoOrigin { path: path.to_path_buf(), why };
        if super::PictureFormat::of(path).is_none() {
            return Err(without("it is neither a .png nor an .exr".into()));
        }
        let (file, beginning) = input_file::open_with_beginning(path)?;
        // The contents decide, for a name is easily changed.
        let text = match input_file::kind(&beginning) {
            Some(input_file::PNG) => input_file::guarded(|| text_of_png(file)),
            Some(input_file::EXR) => input_file::guarded(|| text_of_exr(file)),
            Some(kind) => return Err(without(format!("it is {kind}, whatever its name"))),
            None => return Err(without("it is not a picture, whatever its name".into())),
        };
        let text = text.unwrap_or_else(|| Err("the file is damaged".into())).map_err(without)?;
        let text =
            text.ok_or_else(|| without("thinlens did not write it, or another program has since".into()))?;
        serde_json::from_str(&text).map_err(|error| without(error.to_string()))
    }

    /// The origin as text of plain ASCII, which every file format can hold.
    fn text(&self) -> String {
        let json = serde_json::to_string(self).expect("names are JSON");
        let mut text = String::new();
        for letter in json.chars() {
            if letter.is_ascii() {
                text.push(letter);
            } else {
                let mut units = [0; 2];
                for unit in letter.encode_utf16(&mut units) {
                    text += &format!("\\u{unit:04x}");
                }
            }
        }
        text
    }

    pub(super) fn add_to_png(
        &self,
        encoder: &mut png::Encoder<'_, impl std::io::Write>,
    ) -> Result<(), png::EncodingError> {
        encoder.add_text_chunk(KEY.into(), self.text())
    }

    /// The origin as an attribute of an EXR.
    pub(super) fn attribute(&self) -> (ExrText, AttributeValue) {
        (ExrText::from(KEY), AttributeValue::Text(ExrText::from(self.text().as_str())))
    }
}

/// The text that a file has, if it has one, or what is wrong with the file.
type Text = std::result::Result<Option<String>, String>;

/// Finds the text wherever it stands in a PNG: programs that save a picture anew put it behind the pixels, or compress it.
fn text_of_png(file: File) -> Text {
    let damaged = |error: png::DecodingError| format!("the file is damaged ({error})");
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(damaged)?;
    if let Some(text) = text_among(reader.info()) {
        return Ok(Some(text));
    }
    let rest = reader.finish();
    match text_among(reader.info()) {
        Some(text) => Ok(Some(text)),
        None => rest.map(|()| None).map_err(damaged),
    }
}

fn text_among(info: &png::Info<'_>) -> Option<String> {
    let plain = info.uncompressed_latin1_text.iter().find(|text| text.keyword == KEY);
    let packed = || {
        let mut text = info.compressed_latin1_text.iter().find(|text| text.keyword == KEY)?.clone();
        text.decompress_text_with_limit(MAX_TEXT).ok()?;
        text.get_text().ok()
    };
    let international = || {
        let mut text = info.utf8_text.iter().find(|text| text.keyword == KEY)?.clone();
        text.decompress_text_with_limit(MAX_TEXT).ok()?;
        text.get_text().ok()
    };
    plain.map(|text| text.text.clone()).or_else(packed).or_else(international)
}

fn text_of_exr(file: File) -> Text {
    let meta = exr::meta::MetaData::read_from_buffered(BufReader::new(file), false);
    let meta = meta.map_err(|error| format!("the file is damaged ({error})"))?;
    let attributes = meta
        .headers
        .iter()
        .flat_map(|header| header.own_attributes.other.iter().chain(&header.shared_attributes.other));
    let text = attributes.into_iter().find(|(key, _)| **key == *KEY).map(|(_, value)| value);
    Ok(match text {
        Some(AttributeValue::Text(text)) => Some(text.to_string()),
        _ => None,
    })
}
