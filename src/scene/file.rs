//! From SCENE on the command line to a [`Scene`]: names, files, and errors with a line.

use super::format::SceneFile;
use super::{BUILTINS, Scene};
use crate::error::{Error, Result};
use std::ops::Range;
use std::path::Path;

/// What is wrong, and where in the text.
pub(super) struct Fault {
    pub(super) span: Range<usize>,
    pub(super) message: String,
}

/// Loads a built-in by its name, or a `.toml` file by its path.
///
/// # Errors
/// [`Error::UnknownScene`] with near names, [`Error::Read`], or [`Error::Scene`] with file and line.
pub fn load(scene: &str) -> Result<Scene> {
    if let Some(builtin) = BUILTINS.iter().find(|builtin| builtin.name == scene) {
        return parse(builtin.name, builtin.name, builtin.toml);
    }
    let path = Path::new(scene);
    if path.extension().is_none_or(|extension| extension != "toml") {
        return Err(unknown(scene));
    }
    let text =
        std::fs::read_to_string(path).map_err(|source| Error::Read { path: path.to_path_buf(), source })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    parse(&name, scene, &text)
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
    tables.into_scene(name).map_err(|fault| at(fault.span, fault.message))
}

fn unknown(scene: &str) -> Error {
    let names = || BUILTINS.iter().map(|builtin| builtin.name);
    let near: Vec<&str> =
        names().filter(|name| name.contains(scene) || strsim::jaro_winkler(name, scene) > 0.8).collect();
    let hint = if near.is_empty() {
        format!("the built-in ones are {}, or give a .toml file", names().collect::<Vec<_>>().join(", "))
    } else {
        format!("did you mean {}?", near.join(" or "))
    };
    Error::UnknownScene { name: scene.to_owned(), hint }
}
