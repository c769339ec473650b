//! The names of files that are opened and saved.

use std::path::{Path, PathBuf};

/// The name of a saved picture, unless the user types another.
const PICTURE: &str = "thinlens.png";
/// The name of a saved scene, unless the user types another.
const SCENE: &str = "scene.toml";

/// The content of the panel's fields for file names.
pub(super) struct Files {
    pub(super) open: String,
    pub(super) picture: SaveAs,
    pub(super) scene: SaveAs,
}

/// The name of a file to save to.
pub(super) struct SaveAs {
    pub(super) file: String,
    /// Whether the name is a suggestion, and not typed by the user. Then the next name that is free will do as well.
    pub(super) offered: bool,
    /// Whether the user wants to replace the file that has the name.
    pub(super) replaces: bool,
}

impl SaveAs {
    pub(super) fn new(file: &str) -> Self {
        Self { file: unused_name(file), offered: true, replaces: false }
    }

    /// The path of the file to save to now. An error has the path of a file that is there already and that the user has
    /// not asked to replace.
    pub(super) fn file(&mut self) -> Result<PathBuf, PathBuf> {
        if self.offered {
            // The file may have been created since the name was suggested.
            self.file = unused_name(&self.file);
        }
        let file = typed(Path::new(self.file.trim()));
        if self.replaces || !file.exists() { Ok(file) } else { Err(file) }
    }

    /// The path to suggest in a dialog.
    pub(super) fn suggestion(&self) -> PathBuf {
        typed(Path::new(self.file.trim()))
    }

    /// Takes the file that was chosen in a dialog, which has asked whether to replace it. A name without an ending gets
    /// that of the name before, and nobody was asked about that file. A path that is no text does not fit into the field
    /// of the panel: the error says so, and the name stays.
    pub(super) fn choose(&mut self, file: PathBuf) -> Result<(), String> {
        let ending = Path::new(&self.file).extension().map(ToOwned::to_owned);
        let (file, replaces) = match (file.extension(), ending) {
            (None, Some(ending)) => (file.with_extension(ending), false),
            _ => (file, true),
        };
        let Some(name) = file.to_str() else {
            let shown = file.display();
            return Err(format!(
                "{shown} is not written, because its path is no text in UTF-8. Choose another name or folder."
            ));
        };
        *self = Self { file: name.to_owned(), offered: false, replaces };
        Ok(())
    }

    /// Suggests a new name, after the file was saved.
    pub(super) fn suggest_next(&mut self) {
        *self = Self::new(&self.file);
    }
}

impl Default for Files {
    fn default() -> Self {
        Self { open: String::new(), picture: SaveAs::new(PICTURE), scene: SaveAs::new(SCENE) }
    }
}

/// The absolute path of a file.
pub(super) fn absolute(file: &Path) -> PathBuf {
    std::path::absolute(file).unwrap_or_else(|_| file.to_path_buf())
}

/// The absolute path that was typed: `~` at its start means the user's own folder, as in a shell.
pub(super) fn typed(path: &Path) -> PathBuf {
    match (path.strip_prefix("~"), etcetera::home_dir()) {
        (Ok(inside), Ok(home)) => home.join(inside),
        _ => absolute(path),
    }
}

/// This name, or this name with a number, such that no file has it yet.
pub(super) fn unused_name(name: &str) -> String {
    let path = Path::new(name);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // A name that ends with a number continues from there.
    let (stem, first) = match stem.rsplit_once('-').map(|(stem, number)| (stem, number.parse::<u32>())) {
        Some((stem, Ok(number))) => (stem.to_owned(), number),
        _ => (stem.into_owned(), 1),
    };
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let numbered = (first.max(2)..).map(|number| path.with_file_name(format!("{stem}-{number}.{extension}")));
    std::iter::once(path.to_path_buf())
        .chain(numbered)
        .find(|path| !typed(path).exists())
        .map_or_else(|| name.to_owned(), |path| path.display().to_string())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    /// Catches a path that is saved under replaced letters, and one that is refused although it is text.
    #[test]
    fn a_chosen_path_is_kept_as_it_is_or_refused() {
        let mut name = SaveAs::new("one.png");
        for bytes in [&b"/some\xff/two.png"[..], b"/some/two\xff.png", b"/some/two\xff"] {
            let refused = name.choose(PathBuf::from(OsStr::from_bytes(bytes)));
            assert!(refused.is_err_and(|why| why.contains("UTF-8")));
            assert!(name.file == "one.png" && name.offered && !name.replaces, "the name is another now");
        }
        assert_eq!(name.choose("/some/zw\u{f6}lf".into()), Ok(()));
        assert_eq!(name.file, "/some/zw\u{f6}lf.png");
    }
}
