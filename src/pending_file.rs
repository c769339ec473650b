//! Files that appear whole or not at all.

use crate::error::{Error, Result};
use std::ffi::OsString;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

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
            return Err(cannot_write(path, &"it is a folder"));
        }
        let mut name = OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(format!(".{}.part", std::process::id()));
        let part = path.with_file_name(name);
        let file = File::create(&part).map_err(|error| cannot_write(path, &error))?;
        Ok(Self { path: path.to_path_buf(), part, file })
    }

    /// Where it will be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes it whole and puts it in its place.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(mut self, bytes: &[u8]) -> Result<()> {
        let written = self.file.write_all(bytes).and_then(|()| self.file.sync_all());
        let placed = written.and_then(|()| std::fs::rename(&self.part, &self.path));
        placed.map_err(|error| cannot_write(&self.path, &error))
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        // Gone already where it was put in its place.
        let _ = std::fs::remove_file(&self.part);
    }
}

/// The error of a file that cannot be written, for this reason.
pub(crate) fn cannot_write(path: &Path, reason: &dyn std::fmt::Display) -> Error {
    Error::Write { path: path.to_path_buf(), reason: reason.to_string() }
}
