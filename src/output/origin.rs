//! How a picture was made, carried by its file: the arguments that render it again.

use crate::error::{Error, Result};
use exr::meta::attribute::{AttributeValue, Text};
use serde::{Deserialize, Serialize};
use std::io::BufReader;
use std::path::Path;

/// The key of it in a file: of a PNG's text, and of an EXR's attribute.
const KEY: &str = "thinlens";

/// What a picture file says of how it was made, as JSON.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Of the program.
    version: String,
    /// What follows `thinlens render`, but for where to.
    pub arguments: Vec<String>,
}

impl Origin {
    /// Of a picture that these arguments render.
    pub fn new(arguments: Vec<String>) -> Self {
        Self { version: env!("CARGO_PKG_VERSION").into(), arguments }
    }

    /// Reads it from a picture file.
    ///
    /// # Errors
    /// [`Error::Read`], [`Error::UnknownFormat`], or [`Error::NoOrigin`] where the file does not say.
    pub fn read(path: &Path) -> Result<Self> {
        let without = |why: String| Error::NoOrigin { path: path.to_path_buf(), why };
        let text = match super::PictureFormat::of(path) {
            Some(super::PictureFormat::Png) => text_of_png(path)?,
            Some(super::PictureFormat::Exr) => text_of_exr(path)?,
            None => return Err(without("it is neither a .png nor an .exr".into())),
        };
        let text =
            text.ok_or_else(|| without("thinlens did not write it, or another program has since".into()))?;
        serde_json::from_str(&text).map_err(|error| without(error.to_string()))
    }

    /// As text of plain ASCII, which every file format can hold.
    fn text(&self) -> String {
        let json = serde_json::to_string(self).expect("plain strings are JSON");
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

    /// As an EXR's attribute.
    pub(super) fn attribute(&self) -> (Text, AttributeValue) {
        (Text::from(KEY), AttributeValue::Text(Text::from(self.text().as_str())))
    }
}

fn cannot_read(path: &Path) -> impl Fn(std::io::Error) -> Error {
    move |source| Error::Read { path: path.to_path_buf(), source }
}

fn text_of_png(path: &Path) -> Result<Option<String>> {
    let file = std::fs::File::open(path).map_err(cannot_read(path))?;
    let reader = png::Decoder::new(BufReader::new(file)).read_info();
    let reader = reader.map_err(|error| cannot_read(path)(std::io::Error::other(error)))?;
    let texts = &reader.info().uncompressed_latin1_text;
    Ok(texts.iter().find(|text| text.keyword == KEY).map(|text| text.text.clone()))
}

fn text_of_exr(path: &Path) -> Result<Option<String>> {
    let file = std::fs::File::open(path).map_err(cannot_read(path))?;
    let meta = exr::meta::MetaData::read_from_buffered(BufReader::new(file), false);
    let meta = meta.map_err(|error| cannot_read(path)(std::io::Error::other(error)))?;
    let attributes = meta.headers.iter().flat_map(|header| &header.own_attributes.other);
    let text = attributes.into_iter().find(|(key, _)| **key == *KEY).map(|(_, value)| value);
    Ok(match text {
        Some(AttributeValue::Text(text)) => Some(text.to_string()),
        _ => None,
    })
}
