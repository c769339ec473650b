//! Files that others made: opened and read within bounds, decoded behind a guard, and called what they are.

use crate::error::{Error, Result, cannot_read};
use std::cell::Cell;
use std::fs::File;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Once;

/// The largest file that is read whole, in bytes.
pub(crate) const MAX_BYTES: u64 = u32::MAX as u64;

/// Opens a plain file. Pipes and devices are refused: scenes and pictures name files, and one that never answers
/// or never ends would hold the program up for good.
///
/// # Errors
/// [`Error::Read`].
pub(crate) fn open(path: &Path) -> Result<File> {
    let is = std::fs::metadata(path).map_err(|error| cannot_read(path, &error))?;
    if is.is_dir() {
        return Err(cannot_read(path, &std::io::ErrorKind::IsADirectory.into()));
    }
    if !is.is_file() {
        let reason = "it is a pipe, a socket or a device; save what comes out of it to a file, and name that";
        return Err(Error::Read { path: path.to_path_buf(), reason: reason.into() });
    }
    File::open(path).map_err(|error| cannot_read(path, &error))
}

/// Reads a plain file of at most so many bytes.
///
/// # Errors
/// [`Error::Read`].
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    let mut file = open(path)?;
    let mut bytes = Vec::new();
    let claimed = file.metadata().map_or(0, |is| is.len());
    if claimed <= most {
        // One byte more than is allowed tells that there are too many: a file may grow, or have no size.
        let read = (&mut file).take(most + 1).read_to_end(&mut bytes);
        read.map_err(|error| cannot_read(path, &error))?;
    }
    if claimed.max(bytes.len() as u64) > most {
        let reason = format!("it is larger than {} MiB, which is the most", most.div_ceil(1 << 20));
        return Err(Error::Read { path: path.to_path_buf(), reason });
    }
    Ok(bytes)
}

/// Runs another crate's decoder on bytes that anybody may have made. Nothing, if it panics: then the file is
/// damaged in a way that the decoder does not know. The panic prints nothing.
pub(crate) fn guarded<T>(decode: impl FnOnce() -> T) -> Option<T> {
    thread_local! {
        static GUARDED: Cell<bool> = const { Cell::new(false) };
    }
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let print = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            if !GUARDED.get() {
                print(panic);
            }
        }));
    });
    let outer = GUARDED.replace(true);
    // What the decoder was at is dropped with it.
    let outcome = catch_unwind(AssertUnwindSafe(decode));
    GUARDED.set(outer);
    outcome.ok()
}

pub(crate) const PNG: &str = "a PNG picture";
pub(crate) const EXR: &str = "an OpenEXR picture";
pub(crate) const WEB_PAGE: &str = "a web page, perhaps what a server sent instead of the file";

/// How files of some kinds begin, and what they are, in words that follow "it is".
const BEGINNINGS: [(&[u8], &str); 42] = [
    (b"\x89PNG\r\n\x1a\n", PNG),
    (b"\x76\x2f\x31\x01", EXR),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"RIFF", "a WebP picture, or another RIFF file"),
    (b"BM", "a BMP picture"),
    (b"II*\0", "a TIFF picture"),
    (b"MM\0*", "a TIFF picture"),
    (b"#?RADIANCE", "a Radiance HDR picture"),
    (b"8BPS", "a Photoshop picture"),
    (b"\0\0\0\x0cJXL ", "a JPEG XL picture"),
    (b"<svg", "an SVG drawing"),
    (b"%PDF", "a PDF document"),
    (b"<!DOCTYPE", WEB_PAGE),
    (b"<!doctype", WEB_PAGE),
    (b"<html", WEB_PAGE),
    (b"version https://git-lfs", "a pointer of Git LFS, not the file itself; fetch that with git lfs pull"),
    (b"PK\x03\x04", "a zip archive; unpack it first"),
    (b"\x1f\x8b", "packed with gzip; unpack it first"),
    (b"BZh", "packed with bzip2; unpack it first"),
    (b"\xfd7zXZ", "packed with xz; unpack it first"),
    (b"\x28\xb5\x2f\xfd", "packed with zstd; unpack it first"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive; unpack it first"),
    (b"Rar!", "a RAR archive; unpack it first"),
    (b"ply\n", "a PLY mesh; convert it to OBJ with a modeller such as Blender"),
    (b"ply\r", "a PLY mesh; convert it to OBJ with a modeller such as Blender"),
    (b"solid", "an STL mesh; convert it to OBJ with a modeller such as Blender"),
    (b"OFF\n", "an OFF mesh; convert it to OBJ with a modeller such as Blender"),
    (b"OFF\r", "an OFF mesh; convert it to OBJ with a modeller such as Blender"),
    (b"xof ", "a DirectX mesh; convert it to OBJ with a modeller such as Blender"),
    (b"glTF", "a binary glTF model; convert it to OBJ with a modeller such as Blender"),
    (b"Kaydara FBX", "an FBX scene; convert it to OBJ with a modeller such as Blender"),
    (b"; FBX", "an FBX scene; convert it to OBJ with a modeller such as Blender"),
    (b"#usda 1", "a USD scene; convert it to OBJ with a modeller such as Blender"),
    (b"PXR-USDC", "a USD scene; convert it to OBJ with a modeller such as Blender"),
    (b"#VRML V", "a VRML scene; convert it to OBJ with a modeller such as Blender"),
    (b"#Inventor V", "an Inventor scene; convert it to OBJ with a modeller such as Blender"),
    (b"BLENDER", "a Blender scene; open it in Blender and export it as OBJ"),
    (b"\x7fELF", "a program or a compiler's object file"),
    (b"\x64\x86", "a compiler's object file"),
    (b"\x4c\x01", "a compiler's object file"),
    (b"MZ", "a program"),
];

/// What a file is by how it begins, if that can be told.
pub(crate) fn kind(bytes: &[u8]) -> Option<&'static str> {
    if bytes.is_empty() {
        return Some("empty");
    }
    if bytes.get(4..8) == Some(b"ftyp") {
        return Some("a HEIF or AVIF picture, or a video");
    }
    BEGINNINGS.iter().find(|(beginning, _)| bytes.starts_with(beginning)).map(|(_, kind)| *kind)
}

/// Opens a plain file, and returns its beginning too, which tells what it is.
///
/// # Errors
/// [`Error::Read`].
pub(crate) fn open_with_beginning(path: &Path) -> Result<(File, Vec<u8>)> {
    let mut file = open(path)?;
    let mut bytes = Vec::new();
    let read = (&mut file).take(64).read_to_end(&mut bytes);
    read.and_then(|_| std::io::Seek::rewind(&mut file)).map_err(|error| cannot_read(path, &error))?;
    Ok((file, bytes))
}
