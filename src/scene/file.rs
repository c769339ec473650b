//! Loads scenes by the name or the path that the command line calls SCENE.

use super::mesh::Mesh;
use super::toml::{self, error::ParseError, text};
use super::{BUILTINS, Scene, Stage, stage};
use crate::error::{Error, Result};
use crate::input_file;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The largest size of a scene file in bytes. Parsing takes about fifty times as much memory.
const MAX_TEXT: u64 = 128 << 20;

/// A scene and its file.
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// The text of the scene file. For a mesh, it is the text of the scene that is made around the mesh.
    pub text: String,
    /// The folder of the scene file, which paths in the file are relative to.
    pub folder: PathBuf,
}

/// Loads a built-in scene by its name, or a `.toml` scene or an `.obj` mesh by its path. A mesh is shown on a ground,
/// lit, framed, and with its nearest point in focus.
///
/// # Errors
/// [`Error::UnknownScene`] with near names, [`Error::NotAScene`], [`Error::Read`], [`Error::Scene`] with file and line, or
/// [`Error::Mesh`].
pub fn load(scene: impl AsRef<Path>) -> Result<Scene> {
    Ok(load_with_text(scene, &Stage::default())?.scene)
}

/// Loads a scene as [`load`] does, and also returns the text of its file. A lone mesh is shown like this.
///
/// # Errors
/// As [`load`].
pub fn load_with_text(scene: impl AsRef<Path>, stage: &Stage) -> Result<Loaded> {
    let scene = scene.as_ref();
    let mut loaded = load_named(scene, stage)?;
    scene.clone_into(&mut loaded.scene.source);
    Ok(loaded)
}

fn load_named(scene: &Path, stage: &Stage) -> Result<Loaded> {
    if let Some(builtin) = BUILTINS.iter().find(|builtin| scene == Path::new(builtin.name)) {
        let text = builtin.toml.to_owned();
        return Ok(Loaded { scene: parse(builtin.name, scene, &text)?, text, folder: PathBuf::new() });
    }
    let folder = scene.parent().unwrap_or(Path::new("")).to_path_buf();
    match scene.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("toml") => {
            let text = text::decode(input_file::read(scene, MAX_TEXT)?);
            let text = text.map_err(|(line, message)| error_in(scene, line, message))?;
            let name = scene.file_stem().unwrap_or_default().to_string_lossy();
            let mut loaded = parse(&name, scene, &text)?;
            loaded.files.insert(0, scene.to_path_buf());
            Ok(Loaded { scene: loaded, text, folder })
        }
        Some(extension) if extension.eq_ignore_ascii_case("obj") => {
            let name = scene.file_name().unwrap_or_default().to_string_lossy();
            let scene = stage::around(Arc::new(Mesh::read(scene)?), stage, &name)?;
            let text = scene.staged.as_ref().map(|staged| stage::text(&scene, staged)).transpose()?;
            Ok(Loaded { scene, text: text.unwrap_or_default(), folder })
        }
        _ if scene.exists() => Err(Error::NotAScene(scene.to_path_buf())),
        _ => Err(unknown(scene)),
    }
}

fn error_in(file: &Path, line: usize, message: String) -> Error {
    Error::Scene { file: file.display().to_string(), line, message }
}

fn parse(name: &str, file: &Path, text: &str) -> Result<Scene> {
    let at = |error: ParseError| {
        let before = &text.as_bytes()[..error.span.start.min(text.len())];
        error_in(file, before.iter().filter(|byte| **byte == b'\n').count() + 1, error.message)
    };
    let tables = toml::read(text).map_err(at)?;
    let folder = file.parent().unwrap_or(Path::new(""));
    tables.into_scene(name, folder).map_err(at)
}

fn unknown(scene: &Path) -> Error {
    let scene = scene.to_string_lossy();
    let names = || BUILTINS.iter().map(|builtin| builtin.name);
    let near: Vec<&str> =
        names().filter(|name| name.contains(&*scene) || strsim::jaro_winkler(name, &scene) > 0.8).collect();
    let hint = if near.is_empty() {
        format!(
            "the built-in ones are {}, or give a .toml scene or an .obj mesh",
            names().collect::<Vec<_>>().join(", ")
        )
    } else {
        format!("did you mean {}?", near.join(" or "))
    };
    Error::UnknownScene { name: scene.into_owned(), hint }
}
