//! Finds the MTL files that an OBJ file names: lists of names, names with spaces, and paths of other
//! computers.

use super::text::readings;
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The files that these lines name in a mesh's folder, each once, and the names that are not found.
pub(in super::super) fn find_libraries(folder: &Path, lines: &[Vec<u8>]) -> (Vec<PathBuf>, Vec<Vec<u8>>) {
    let mut search = Search { folder, listings: HashMap::new() };
    let (mut found, mut missing) = (Vec::new(), Vec::new());
    let mut known = HashSet::new();
    let mut note = |path: PathBuf| {
        if known.insert(path.clone()) {
            found.push(path);
        }
    };
    for line in lines {
        if let Some(path) = readings(line).find_map(|name| search.find(name)) {
            note(path);
            continue;
        }
        let line = readings(line).last().unwrap_or_default();
        for name in names(line) {
            let words = || name.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            match search.find(name) {
                Some(path) => note(path),
                None if words().nth(1).is_none() => missing.push(name.to_vec()),
                None => words().for_each(|word| match search.find(word) {
                    Some(path) => note(path),
                    None => missing.push(word.to_vec()),
                }),
            }
        }
    }
    (found, missing)
}

/// The pieces of a line that end in `.mtl`, and what is left.
fn names(line: &[u8]) -> Vec<&[u8]> {
    let mut names = Vec::new();
    let mut start = 0;
    for end in 4..=line.len() {
        let is_end = line.get(end).is_none_or(|byte| byte.is_ascii_whitespace() || *byte == b'"');
        if is_end && end >= start + 4 && line[end - 4..end].eq_ignore_ascii_case(b".mtl") {
            let end = end + usize::from(line.get(end) == Some(&b'"'));
            names.push(line[start..end].trim_ascii());
            start = end;
        }
    }
    names.push(line[start..].trim_ascii());
    names.retain(|name| !name.is_empty());
    names
}

struct Search<'a> {
    folder: &'a Path,
    /// The files of folders by their names in lower case.
    listings: HashMap<PathBuf, HashMap<Vec<u8>, OsString>>,
}

impl Search<'_> {
    /// Finds a file by its name as it is written, or else with backslashes as separators and in any case of letters, or
    /// else by its last part in the mesh's folder.
    fn find(&mut self, name: &[u8]) -> Option<PathBuf> {
        let quoted = name.strip_prefix(b"\"").and_then(|name| name.strip_suffix(b"\""));
        let name = quoted.unwrap_or(name);
        let written = self.folder.join(os_str(name));
        if !name.is_empty() && written.is_file() {
            return Some(written);
        }
        let is_separator = |byte: &u8| matches!(byte, b'/' | b'\\');
        let parts: Vec<&[u8]> = name.split(is_separator).filter(|part| !part.is_empty()).collect();
        let last = parts.last()?;
        self.walk(&parts).or_else(|| self.walk(&[last]))
    }

    fn walk(&mut self, parts: &[&[u8]]) -> Option<PathBuf> {
        let mut path = self.folder.to_path_buf();
        for part in parts {
            path = self.child(path, part)?;
        }
        path.is_file().then_some(path)
    }

    fn child(&mut self, folder: PathBuf, name: &[u8]) -> Option<PathBuf> {
        let exact = folder.join(os_str(name));
        if exact.exists() {
            return Some(exact);
        }
        let listing = self.listings.entry(folder).or_insert_with_key(|folder| {
            // An empty path is the working folder.
            let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
            let mut names: Vec<OsString> = std::fs::read_dir(folder)
                .into_iter()
                .flatten()
                .flatten()
                .map(|entry| entry.file_name())
                .collect();
            // Where names differ only in case, every computer must choose the same one.
            names.sort_unstable_by(|a, b| b.cmp(a));
            names.into_iter().map(|name| (lower(name.as_encoded_bytes()), name)).collect()
        });
        let name = listing.get(&lower(name))?;
        Some(exact.with_file_name(name))
    }
}

fn lower(name: &[u8]) -> Vec<u8> {
    match std::str::from_utf8(name) {
        Ok(name) => name.to_lowercase().into_bytes(),
        Err(_) => name.to_ascii_lowercase(),
    }
}

/// A file's name from its bytes. On systems where names are not bytes, a name that is not UTF-8 is not found.
fn os_str(name: &[u8]) -> Cow<'_, Path> {
    #[cfg(unix)]
    return Cow::Borrowed(Path::new(<OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(name)));
    #[cfg(not(unix))]
    return Cow::Owned(String::from_utf8_lossy(name).into_owned().into());
}
