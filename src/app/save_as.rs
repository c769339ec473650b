//! The names of files that are opened and saved.

use std::path::Path;

/// The name that pictures have until another one is typed.
const PICTURE: &str = "thinlens.png";
/// The name that scenes have until another one is typed.
const SCENE: &str = "scene.toml";

/// What is typed into the panel's fields.
pub(super) struct Files {
    pub(super) open: String,
    pub(super) picture: SaveAs,
    pub(super) scene: SaveAs,
}

/// Where something is saved.
pub(super) struct SaveAs {
    pub(super) file: String,
    /// Whether nobody typed it: then no file is to be lost.
    pub(super) offered: bool,
}

impl SaveAs {
    pub(super) fn new(file: &str) -> Self {
        Self { file: free(file), offered: true }
    }

    /// The file, now that something is saved.
    pub(super) fn file(&mut self) -> String {
        if self.offered {
            // There may be one by now.
            self.file = free(&self.file);
        }
        self.file.clone()
    }
}

impl Default for Files {
    fn default() -> Self {
        Self { open: String::new(), picture: SaveAs::new(PICTURE), scene: SaveAs::new(SCENE) }
    }
}

/// The name, or one like it with a number, that no file has yet.
fn free(name: &str) -> String {
    let path = Path::new(name);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // What was numbered before counts on.
    let (stem, first) = match stem.rsplit_once('-').map(|(stem, number)| (stem, number.parse::<u32>())) {
        Some((stem, Ok(number))) => (stem.to_owned(), number),
        _ => (stem.into_owned(), 1),
    };
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let numbered = (first.max(2)..).map(|number| path.with_file_name(format!("{stem}-{number}.{extension}")));
    std::iter::once(path.to_path_buf())
        .chain(numbered)
        .find(|path| !path.exists())
        .map_or_else(|| name.to_owned(), |path| path.display().to_string())
}
