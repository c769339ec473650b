//! Everything that can go wrong for a user, each with what to do about it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The crate's result.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What went wrong. The display text is one line that says what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The Vulkan loader is not installed.
    #[error(
        "no Vulkan loader found ({0}); install one: ./setup.sh, or your system's package libvulkan1, \
         vulkan-loader or vulkan-icd-loader"
    )]
    NoLoader(String),
    /// The Khronos validation layer is not installed, or is one that cannot report what it sees.
    #[error(
        "validation was asked for, but the layer VK_LAYER_KHRONOS_validation with VK_EXT_debug_utils is not \
         installed; install it (./setup.sh, or the package vulkan-validationlayers), or leave out --validation"
    )]
    NoValidationLayer,
    /// No device can run the renderer. The text says why for each.
    #[error(
        "no usable Vulkan 1.3 device ({0}); install a driver for your GPU, or the software device \
         lavapipe: ./setup.sh, or the package mesa-vulkan-drivers"
    )]
    NoDevice(String),
    /// `--device` names no device.
    #[error("no device '{wanted}'; there are: {available}")]
    UnknownDevice {
        /// The text as it was given.
        wanted: String,
        /// The devices, as index and name.
        available: String,
    },
    /// A Vulkan call failed.
    #[error("Vulkan: {what} failed: {result}; try another device (thinlens devices), or update the driver")]
    Vulkan {
        /// What was tried.
        what: &'static str,
        /// Vulkan's code.
        result: ash::vk::Result,
    },
    /// The device stopped working.
    #[error(
        "the device was lost while it ran {passes}: its driver gave up on it, or it is gone; update the driver, or \
         choose another device (thinlens devices)"
    )]
    DeviceLost {
        /// The passes that were handed to it last.
        passes: String,
    },
    /// A picture or scene does not fit in memory.
    #[error("not enough memory for {what}; try a smaller --size, or another device (thinlens devices)")]
    Memory {
        /// What it was for.
        what: &'static str,
    },
    /// A scene or picture has more of something than there can be, however much memory there is.
    #[error(
        "{what} would take {wanted} {unit}, but can have {max} at most ({limit}); {advice}, or try another device \
         (thinlens devices)"
    )]
    Limit {
        /// What it was for.
        what: &'static str,
        /// What is counted.
        unit: &'static str,
        /// How many it would take.
        wanted: u64,
        /// How many there can be.
        max: u64,
        /// Which limit that is.
        limit: String,
        /// What to change.
        advice: &'static str,
    },
    /// The device that was asked for cannot be used.
    #[error("cannot use {0}; choose another one: thinlens devices")]
    UnusableDevice(String),
    /// The window system failed.
    #[error("window: {0}; to render without one: thinlens render -o picture.png")]
    Window(String),
    /// There is no display.
    #[error("no display ({0}); to render without one: thinlens render -o picture.png")]
    NoDisplay(String),
    /// SCENE is neither a built-in nor a file.
    #[error("no scene '{name}'; {hint}")]
    UnknownScene {
        /// The text as it was given.
        name: String,
        /// Similar names, or all names.
        hint: String,
    },
    /// SCENE is a file or folder of another kind.
    #[error(
        "{}: a scene is a .toml file, and a mesh an .obj file; the viewer also opens pictures that thinlens saved, \
         .png and .exr", .0.display()
    )]
    NotAScene(PathBuf),
    /// The name of the output ends in no known format.
    #[error("cannot write '{}': its name must end in .png or .exr", .0.display())]
    UnknownFormat(PathBuf),
    /// A picture file does not say how it was made.
    #[error("{} cannot be rendered again: {why}; give the scene and options instead", path.display())]
    NoOrigin {
        /// Which file.
        path: PathBuf,
        /// Why.
        why: String,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// Why, and what to do.
        reason: String,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// Why, and what to do.
        reason: String,
    },
    /// Two outputs are the same file, or an output is a file that it is made from.
    #[error("{0}")]
    SameFile(String),
    /// A scene file is wrong. Lines count from 1.
    #[error("{file}:{line}: {message}")]
    Scene {
        /// File name, or the built-in's name.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong there, and what would be right.
        message: String,
    },
    /// A mesh cannot be used, and no one line of its file is to blame.
    #[error("{file}: {message}")]
    Mesh {
        /// The mesh's file.
        file: String,
        /// What is wrong, and what to do.
        message: String,
    },
    /// An image cannot be used: as the sky, or as the shape of an aperture.
    #[error("{file}: {message}")]
    Image {
        /// The image's file.
        file: String,
        /// What is wrong, and what to do.
        message: String,
    },
    /// A setting is out of its range.
    #[error("{0}")]
    OutOfRange(String),
    /// The place to focus on shows the background.
    #[error("there is nothing to focus on at {x},{y}: it is the background; choose a pixel of an object")]
    NothingToFocusOn {
        /// In pixels from the left.
        x: f32,
        /// In pixels from the top.
        y: f32,
    },
    /// No lens is as sharp and as blurred at two places as was asked for.
    #[error("no lens does what was asked for: {0}")]
    NoLens(String),
    /// The validation layer reported problems. Holds how many.
    #[error("the validation layer gave {0} message(s), printed above; please report them as a bug")]
    Validation(usize),
    /// The device and the oracle do not agree.
    #[error(
        "{scene}: the device does not render what it should: {:.3}% of the samples differ and the picture is \
         {:+.3}% brighter; update its driver, or choose another device (thinlens devices)",
        100.0 * mismatches,
        100.0 * brightness
    )]
    Disagreement {
        /// The scene's name.
        scene: String,
        /// Share of samples that differ.
        mismatches: f64,
        /// How much brighter the device's picture is, as a share.
        brightness: f64,
    },
    /// Standard output cannot be written.
    #[error("cannot write to standard output: {0}; the picture, if one was asked for, is written")]
    Output(std::io::Error),
}

impl Error {
    /// The process's exit status: 2 for wrong use, 1 for a failure.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::UnknownScene { .. }
            | Self::NotAScene(_)
            | Self::UnknownFormat(_)
            | Self::OutOfRange(_)
            | Self::SameFile(_)
            | Self::NothingToFocusOn { .. }
            | Self::NoLens(_)
            | Self::NoOrigin { .. }
            | Self::UnknownDevice { .. } => 2,
            _ => 1,
        }
    }
}

/// Why a file cannot be read, and what to do about it.
pub(crate) fn cannot_read(path: &Path, error: &std::io::Error) -> Error {
    let reason = match error.kind() {
        ErrorKind::NotFound => missing(path, "check its name, and the folder that it starts from"),
        ErrorKind::PermissionDenied => {
            "you may not read it; ask its owner, or permit it (chmod u+r, and u+x for its folders)".into()
        }
        _ => reason(error),
    };
    Error::Read { path: path.to_path_buf(), reason }
}

/// Why a file cannot be written, and what to do about it.
pub(crate) fn cannot_write(path: &Path, error: &std::io::Error) -> Error {
    let reason = match error.kind() {
        ErrorKind::NotFound => missing(path, "make the folder first, or choose another place"),
        ErrorKind::PermissionDenied => {
            "you may not write there; choose another folder, or ask for the right to write in this one".into()
        }
        _ => reason(error),
    };
    Error::Write { path: path.to_path_buf(), reason }
}

/// The first part of a path that does not exist.
fn missing(path: &Path, advice: &str) -> String {
    if let Ok(target) = std::fs::read_link(path) {
        return format!("it is a link to {}, which does not exist; make the link anew", target.display());
    }
    match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        Some(folder) => format!("there is no folder {}; {advice}", folder.display()),
        None => format!("there is no such file; {advice}"),
    }
}

/// The reasons that reading and writing have in common.
fn reason(error: &std::io::Error) -> String {
    let known = match error.kind() {
        ErrorKind::IsADirectory => "it is a folder; name a file",
        ErrorKind::NotADirectory => "a part of its path is a file and no folder; check the path",
        ErrorKind::StorageFull => "the disk is full; free some space, or choose another disk",
        ErrorKind::QuotaExceeded => {
            "your share of the disk is used up; free some space, or choose another disk"
        }
        ErrorKind::FileTooLarge => {
            "it would be larger than files may be here; raise the limit (ulimit -f), choose another disk, or a \
             smaller --size"
        }
        ErrorKind::ReadOnlyFilesystem => "the disk is read-only; choose another one",
        ErrorKind::InvalidFilename => "the system does not take this name; choose a shorter or plainer one",
        ErrorKind::ResourceBusy | ErrorKind::ExecutableFileBusy => {
            "another program uses it; close it there, or choose another name"
        }
        ErrorKind::OutOfMemory => "it does not fit in memory; close other programs, or use a smaller file",
        ErrorKind::BrokenPipe => "whoever was to read it has ended; start that again",
        // The system's own words are better than a guess.
        _ => return error.to_string(),
    };
    known.into()
}
