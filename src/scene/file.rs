//! From SCENE on the command line to a [`Scene`]: names, files, and errors with a line.

use super::format::SceneFile;
use super::mesh::Mesh;
use super::{BUILTINS, Builtin, Scene, stage};
use crate::error::{Error, Result};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What is wrong, and where in the text.
pub(super) struct Fault {
    pub(super) span: Range<usize>,
    pub(super) message: String,
}

/// Loads a built-in by its name, or a `.toml` scene or an `.obj` mesh by its path. A mesh is shown on a
/// ground, framed, lit and focused on its nearest point.
///
/// # Errors
/// [`Error::UnknownScene`] with near names, [`Error::Read`], [`Error::Scene`] with file and line, or
/// [`Error::Mesh`].
pub fn load(scene: &str) -> Result<Scene> {
    let mut loaded = load_named(scene)?;
    scene.clone_into(&mut loaded.source);
    Ok(loaded)
}

/// What a name stands for.
enum Source<'a> {
    Builtin(&'static Builtin),
    SceneFile(&'a Path),
    Mesh(&'a Path),
}

impl<'a> Source<'a> {
    fn named(scene: &'a str) -> Result<Self> {
        if let Some(builtin) = BUILTINS.iter().find(|builtin| builtin.name == scene) {
            return Ok(Self::Builtin(builtin));
        }
        let path = Path::new(scene);
        match path.extension() {
            Some(extension) if extension == "toml" => Ok(Self::SceneFile(path)),
            Some(extension) if extension.eq_ignore_ascii_case("obj") => Ok(Self::Mesh(path)),
            _ => Err(unknown(scene)),
        }
    }
}

fn load_named(scene: &str) -> Result<Scene> {
    match Source::named(scene)? {
        Source::Builtin(builtin) => parse(builtin.name, builtin.name, builtin.toml),
        Source::SceneFile(path) => {
            parse(&path.file_stem().unwrap_or_default().to_string_lossy(), scene, &read(path)?)
        }
        Source::Mesh(path) => {
            stage::around(&Mesh::read(path)?, &path.file_name().unwrap_or_default().to_string_lossy())
        }
    }
}

/// The text of a scene's file, and the folder that it sees others from. That of a mesh is of the stage that is
/// made around it.
///
/// # Errors
/// As [`load`].
pub fn text_of(scene: &str) -> Result<(String, PathBuf)> {
    let folder = |path: &Path| path.parent().unwrap_or(Path::new("")).to_path_buf();
    match Source::named(scene)? {
        Source::Builtin(builtin) => Ok((builtin.toml.to_owned(), PathBuf::new())),
        Source::SceneFile(path) => Ok((read(path)?, folder(path))),
        Source::Mesh(path) => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            Ok((stage::scene_file(&Mesh::read(path)?, &name)?, folder(path)))
        }
    }
}

fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(|source| Error::Read { path: path.to_path_buf(), source })
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
