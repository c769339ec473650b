//! Files that appear whole or not at all.

use crate::error::{Error, Result, cannot_write};
use crate::interrupt::Leftover;
use std::ffi::OsString;
use std::fs::{File, Metadata, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Links that lead to links are followed so far.
const MAX_LINKS: usize = 40;

/// A file that is written beside its place and renamed, so that nobody sees half of it. Made before
/// the work, so that a wrong path is known before it.
pub struct PendingFile {
    path: PathBuf,
    place: Place,
}

enum Place {
    /// A new file, which replaces the target once it is whole.
    Part { part: PathBuf, target: PathBuf, file: File, _leftover: Leftover },
    /// A pipe, a device or standard output, which takes the bytes as they are written.
    Stream(File),
}

/// What a path leads to, with its links followed.
enum Destination {
    /// A file, and the metadata of the one that is there already.
    File(PathBuf, Option<Metadata>),
    Stream(File),
}

impl PendingFile {
    /// Creates the file beside `path`, or beside what `path` is a link to. A file that is there keeps its
    /// rights. Nothing is created for a pipe or a device: these are opened.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn create(path: &Path) -> Result<Self> {
        let failed = |error: &std::io::Error| cannot_write(path, error);
        let (target, old) = match destination(path)? {
            Destination::Stream(file) => return Ok(Self { path: path.into(), place: Place::Stream(file) }),
            Destination::File(target, old) => (target, old),
        };
        if let Some(old) = &old {
            // Renaming over a write-protected file would succeed.
            if old.permissions().readonly() {
                let reason = "it is write-protected; choose another name, or permit writing (chmod u+w)";
                return Err(Error::Write { path: path.to_path_buf(), reason: reason.into() });
            }
            OpenOptions::new().write(true).open(&target).map_err(|error| failed(&error))?;
        }
        let (part, file, leftover) = new_part(&target, old.as_ref()).map_err(|error| failed(&error))?;
        let pending =
            Self { path: path.into(), place: Place::Part { part, target, file, _leftover: leftover } };
        if let (Place::Part { file, .. }, Some(old)) = (&pending.place, old) {
            keep_owner(file, &old);
            file.set_permissions(old.permissions()).map_err(|error| failed(&error))?;
        }
        Ok(pending)
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
        let written = match &mut self.place {
            Place::Part { part, target, file, .. } => file
                .write_all(bytes)
                .and_then(|()| file.sync_all())
                .and_then(|()| std::fs::rename(part, target)),
            Place::Stream(file) => file.write_all(bytes),
        };
        written.map_err(|error| cannot_write(&self.path, &error))
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        if let Place::Part { part, .. } = &self.place {
            // Gone already where it was put in its place.
            let _ = std::fs::remove_file(part);
        }
    }
}

/// A new file in the folder of `target`. Its name says whose it is, should the program be killed, and is short
/// whatever the target's. It is nobody else's to read where it is to get the rights of an older file.
fn new_part(target: &Path, old: Option<&Metadata>) -> std::io::Result<(PathBuf, File, Leftover)> {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    if old.is_some() {
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    }
    #[cfg(not(unix))]
    let _ = old;
    loop {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let part = target.with_file_name(format!(".thinlens-{}-{number}.part", std::process::id()));
        let remove = part.clone();
        let made = Leftover::of(|| options.open(&part), move || drop(std::fs::remove_file(remove)));
        match made {
            Ok((file, leftover)) => return Ok((part, file, leftover)),
            // Left behind by a process of the same number that was killed.
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// The owner and group of an older file, where the system lets them be given.
fn keep_owner(file: &File, old: &Metadata) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        if file.metadata().is_ok_and(|new| (new.uid(), new.gid()) != (old.uid(), old.gid())) {
            let _ = fchown(file, Some(old.uid()), Some(old.gid()));
        }
    }
    #[cfg(not(unix))]
    let _ = (file, old);
}

/// Follows links, whether or not there is anything at their end.
fn destination(path: &Path) -> Result<Destination> {
    let failed = |error: std::io::Error| cannot_write(path, &error);
    let refused = |reason: &str| Err(Error::Write { path: path.into(), reason: reason.into() });
    let mut at = path.to_path_buf();
    for _ in 0..MAX_LINKS {
        if at.file_name().is_none() && !at.is_dir() {
            return refused("it has no file name; name a file");
        }
        if let Some(stream) = standard_stream(&at) {
            return Ok(Destination::Stream(stream.map_err(failed)?));
        }
        let is = match std::fs::symlink_metadata(&at) {
            Ok(is) => is,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return Ok(Destination::File(at, None));
            }
            Err(error) => return Err(failed(error)),
        };
        if is.is_symlink() {
            at = at.with_file_name("").join(std::fs::read_link(&at).map_err(failed)?);
        } else if is.is_dir() {
            return Err(failed(std::io::ErrorKind::IsADirectory.into()));
        } else if is.is_file() {
            return Ok(Destination::File(at, Some(is)));
        } else if is_disk(&is) {
            return refused("it is a whole disk; name a file");
        } else {
            // A pipe waits here for its reader.
            let stream = OpenOptions::new().write(true).open(&at);
            return Ok(Destination::Stream(stream.map_err(failed)?));
        }
    }
    refused("its links lead to links without end; name the file itself")
}

fn is_disk(is: &Metadata) -> bool {
    #[cfg(unix)]
    {
        std::os::unix::fs::FileTypeExt::is_block_device(&is.file_type())
    }
    #[cfg(not(unix))]
    {
        let _ = is;
        false
    }
}

/// The process's own standard output or error, where the path means it. To open it anew would write over what
/// is in a file that it leads to, and so would a rename.
fn standard_stream(path: &Path) -> Option<std::io::Result<File>> {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        let folder = path.parent()?;
        let own = ["/dev/fd".into(), "/proc/self/fd".into(), format!("/proc/{}/fd", std::process::id())];
        if !own.iter().any(|own| folder == Path::new(own)) {
            return None;
        }
        let stream = match path.file_name()?.to_str()? {
            "1" => std::io::stdout().as_fd().try_clone_to_owned(),
            "2" => std::io::stderr().as_fd().try_clone_to_owned(),
            // Another one can only be opened by its name, and leads to a pipe, or to a file that is added to.
            _ => return Some(OpenOptions::new().append(true).open(path)),
        };
        Some(stream.map(File::from))
    }
    #[cfg(not(unix))]
    {
        let _ = path;
        None
    }
}

/// What tells whether two paths are one file.
#[derive(PartialEq)]
enum Identity {
    /// A file that is there, whatever its names.
    File(FileId),
    /// A file that will be there: its folder, and its name.
    New(FileId, OsString),
}

#[cfg(unix)]
type FileId = [u64; 2];
#[cfg(not(unix))]
type FileId = PathBuf;

fn file_id(path: &Path) -> Option<FileId> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        std::fs::metadata(path).ok().map(|is| [is.dev(), is.ino()])
    }
    #[cfg(not(unix))]
    {
        std::fs::canonicalize(path).ok()
    }
}

/// Nothing for what is no file, such as a pipe, into which several things can be written.
fn identity(path: &Path) -> Option<Identity> {
    if let Ok(is) = std::fs::metadata(path) {
        return if is.is_file() { file_id(path).map(Identity::File) } else { None };
    }
    let Ok(Destination::File(target, None)) = destination(path) else {
        return None;
    };
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let name = target.file_name()?;
    // These systems take names that differ in case alone for one.
    let ignores_case = cfg!(any(windows, target_os = "macos"));
    let name = if ignores_case { name.to_string_lossy().to_lowercase().into() } else { name.into() };
    Some(Identity::New(file_id(folder.unwrap_or(Path::new(".")))?, name))
}

/// Refuses to write two outputs to one file, or one over a file that it is made from. Each is given as what it is
/// called in a message, and its path.
///
/// # Errors
/// [`Error::SameFile`].
pub fn keep_apart(outputs: &[(&str, &Path)], inputs: &[(&str, &Path)]) -> Result<()> {
    for (index, (what, output)) in outputs.iter().enumerate() {
        let Some(is) = identity(output) else { continue };
        let same = |other: &&(&str, &Path)| identity(other.1).is_some_and(|other| other == is);
        if let Some((other, _)) = outputs[..index].iter().find(same) {
            let message = format!("{other} and {what} name the same file, {}", output.display());
            return Err(Error::SameFile(format!("{message}; give each its own")));
        }
        if let Some((other, _)) = inputs.iter().find(same) {
            let message = format!("{what} would write over {other}, {}", output.display());
            return Err(Error::SameFile(format!("{message}; choose another name")));
        }
    }
    Ok(())
}
