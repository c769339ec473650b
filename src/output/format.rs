//! What pictures are saved as.

use std::path::Path;

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
