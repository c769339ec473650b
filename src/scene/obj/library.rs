//! The colours of MTL texts (Wavefront, *Material Library File*).

use super::Tally;
use super::text::{self, Foreign, keyword, length_of, lines, name, readings, words};
use glam::{Mat3, Vec3};
use std::collections::HashMap;

/// The grey that stands for a texture image: those are not read.
const GREY: Vec3 = Vec3::splat(0.5);

/// Black is no colour where a texture image should be: files leave such a material black.
const BLACK: f32 = 1e-3;

/// From CIE XYZ to linear sRGB, by columns (IEC 61966-2-1).
const LINEAR_OF_XYZ: Mat3 = Mat3::from_cols(
    Vec3::new(3.2406, -0.9689, 0.0557),
    Vec3::new(-1.5372, 1.8758, -0.2040),
    Vec3::new(-0.4986, 0.0415, 1.0570),
);

/// What is read of a material.
#[derive(Clone, Copy, Default)]
pub(in super::super) struct Paint {
    diffuse: Option<Vec3>,
    /// Whether a texture image gives the colour.
    pub(in super::super) pictured: bool,
}

/// The materials of MTL texts.
#[derive(Default)]
pub(in super::super) struct Library {
    materials: HashMap<Vec<u8>, Paint>,
    /// The index by a name without what may be a comment, or none where two names become the same.
    short_names: HashMap<Vec<u8>, Option<Vec<u8>>>,
    /// How many colours cannot be read, and what is wrong with the first.
    pub(in super::super) unreadable: Tally,
    pub(in super::super) first_error: String,
}

impl Paint {
    /// The diffuse colour. A material with a texture image is grey, for files leave its colour black.
    pub(in super::super) fn color(&self) -> Option<Vec3> {
        match self.diffuse {
            Some(color) if !self.pictured || color.max_element() > BLACK => Some(color),
            _ => self.pictured.then_some(GREY),
        }
    }
}

/// Reads MTL text in any encoding. Colours that cannot be read are passed over and counted.
pub(in super::super) fn parse_library(bytes: &[u8]) -> Result<Library, Foreign> {
    let text = text::decode(bytes)?;
    let mut library = Library::default();
    let mut current: Option<&mut Paint> = None;
    for (number, line) in lines(&text) {
        let (keyword, rest) = keyword(&line);
        // Programs write keywords in any case of letters, and no two keywords differ by it alone.
        match &*keyword.to_ascii_lowercase() {
            b"newmtl" => current = Some(library.materials.entry(name(rest).to_vec()).or_default()),
            b"kd" => match color(rest) {
                Ok(color) => {
                    if let Some(paint) = &mut current {
                        paint.diffuse = Some(color.clamp(Vec3::ZERO, Vec3::ONE));
                    }
                }
                Err(message) => {
                    if library.unreadable.note(number) {
                        library.first_error = message;
                    }
                }
            },
            b"map_kd" | b"map_ka" => {
                if let (Some(paint), Some(_)) = (&mut current, words(rest).next()) {
                    paint.pictured = true;
                }
            }
            _ => {}
        }
    }
    if library.materials.is_empty() {
        return Err(Foreign("text without a material (newmtl); export the mesh with its materials"));
    }
    Ok(library)
}

/// `r`, `r g b`, or either after `xyz`.
fn color(rest: &[u8]) -> Result<Vec3, String> {
    let mut words = words(rest).peekable();
    let is_xyz = words.next_if(|word| word.eq_ignore_ascii_case(b"xyz")).is_some();
    if words.next_if(|word| word.eq_ignore_ascii_case(b"spectral")).is_some() {
        return Err("a colour from a spectral file is not read; write it as r g b".into());
    }
    let numbers: Vec<f64> = words.take(3).map(length_of).collect::<Result<_, _>>()?;
    let color = match *numbers {
        [grey] => Vec3::splat(grey as f32),
        [r, g, b] => Vec3::new(r as f32, g as f32, b as f32),
        _ => return Err("a colour is one number or three".into()),
    };
    Ok(if is_xyz { LINEAR_OF_XYZ * color } else { color })
}

impl Library {
    /// Adds the materials of another library. Where both have a name, the other one's material is used.
    pub(in super::super) fn extend(&mut self, other: Self) {
        for name in other.materials.keys() {
            for short in readings(name).skip(1) {
                let of = self.short_names.entry(short.to_vec()).or_insert_with(|| Some(name.clone()));
                if of.as_ref() != Some(name) {
                    *of = None;
                }
            }
        }
        self.materials.extend(other.materials);
    }

    /// The material of this name as it is written, or else one that is the same but for a comment behind either name.
    pub(in super::super) fn find(&self, name: &[u8]) -> Option<Paint> {
        let whole = || readings(name).find_map(|reading| self.materials.get(reading));
        let short = || readings(name).find_map(|reading| self.short_names.get(reading)?.as_ref());
        whole().or_else(|| self.materials.get(short()?)).copied()
    }
}
