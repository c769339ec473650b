//! From SCENE on the command line to a [`Scene`]: names, files, and errors with a line.

use super::format::SceneFile;
use super::mesh::Mesh;
use super::{BUILTINS, Scene, stage};
use crate::error::{Error, Result};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What is wrong, and where in the text.
pub(super) struct Fault {
    pub(super) span: Range<usize>,
    pub(super) message: String,
}

/// A scene, and its file.
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// What the file says. That of a mesh is of the stage that is made around it.
    pub text: String,
    /// Where the file sees others from.
    pub folder: PathBuf,
}

/// Loads a built-in by its name, or a `.toml` scene or an `.obj` mesh by its path. A mesh is shown on a
/// ground, framed, lit and focused on its nearest point.
///
/// # Errors
/// [`Error::UnknownScene`] with near names, [`Error::Read`], [`Error::Scene`] with file and line, or
/// [`Error::Mesh`].
pub fn load(scene: &str) -> Result<Scene> {
    Ok(load_with_text(scene)?.scene)
}

/// Likewise, with the text of its file.
///
/// # Errors
/// As [`load`].
pub fn load_with_text(scene: &str) -> Result<Loaded> {
    let mut loaded = load_named(scene)?;
    scene.clone_into(&mut loaded.scene.source);
    Ok(loaded)
}

fn load_named(scene: &str) -> Result<Loaded> {
    if let Some(builtin) = BUILTINS.iter().find(|builtin| builtin.name == scene) {
        let text = builtin.toml.to_owned();
        return Ok(Loaded { scene: parse(builtin.name, builtin.name, &text)?, text, folder: PathBuf::new() });
    }
    let path = Path::new(scene);
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    match path.extension() {
        Some(extension) if extension == "toml" => {
            let read = std::fs::read_to_string(path);
            let text = read.map_err(|source| Error::Read { path: path.to_path_buf(), source })?;
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            Ok(Loaded { scene: parse(&name, scene, &text)?, text, folder })
        }
        Some(extension) if extension.eq_ignore_ascii_case("obj") => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let (scene, text) = stage::around(&Mesh::read(path)?, &name)?;
            Ok(Loaded { scene, text, folder })
        }
        _ => Err(unknown(scene)),
    }
}

fn parse(name: &str, file: &str, text: &str) -> Result<Scene> {
    let at = |span: Range<usize>, message: String| Error::Scene {
        file: file.to_owned(),
        line: text[..span.start.min(text.len())].matches('\n').count() + 1,
        message,
    };
    let tables: SceneFile = toml::from_str(text).map_err(|error| {
        let message = error.message().replace('\n', "; ");
        at(error.span().unwrap_or(0..0), message)
    })?;
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    tables.into_scene(name, folder).map_err(|fault| at(fault.span, fault.message))
}

fn unknown(scene: &str) -> Error {
    let names = || BUILTINS.iter().map(|builtin| builtin.name);
    let near: Vec<&str> =
        names().filter(|name| name.contains(scene) || strsim::jaro_winkler(name, scene) > 0.8).collect();
    let hint = if near.is_empty() {
        format!(
            "the built-in ones are {}, or give a .toml scene or an .obj mesh",
            names().collect::<Vec<_>>().join(", ")
        )
    } else {
        format!("did you mean {}?", near.join(" or "))
    };
    Error::UnknownScene { name: scene.to_owned(), hint }
}
