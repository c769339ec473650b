//! Writes settings to a scene file: the scene's own file, with the current camera, lens and view.

use super::arguments::quoted;
use super::setting::NONE;
use super::{Key, Role, Setting, Settings, Value, list};
use crate::error::{Error, Result};
use crate::scene::{self, EXPOSURES, Loaded, SceneRef, Tolerance, in_range};
use std::path::{Path, PathBuf};
use toml_edit::{Array, DocumentMut, Item, TableLike, value};

impl Settings {
    /// The text of a scene file in this folder that gives this picture, except for how it is sampled. Everything else
    /// in the scene's own file stays, including comments. If lens or shutter have changed the brightness, `exposure`
    /// makes up for it, because the brightness of a scene is relative to its own lens and shutter.
    ///
    /// # Errors
    /// Errors of reading the scene's own file, which may have changed since it was loaded.
    pub fn scene_file(&self, folder: &Path) -> Result<String> {
        let source = &self.estimator.scene.source;
        // The file may have changed since it was loaded.
        let Loaded { scene, text, folder: own_folder } =
            scene::load_with_text(source, &self.estimator.stage)?;
        let unusable =
            |message: String| Error::Scene { file: source.display().to_string(), line: 1, message };
        // The text of the scene around a mesh contains the name of the mesh, relative to the old folder.
        let is_mesh = source.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj"));
        if is_mesh && source.file_name().is_some_and(|name| name.to_str().is_none()) {
            return Err(not_text(source));
        }
        let mut document: DocumentMut = text
            .parse()
            .map_err(|error: toml_edit::TomlError| unusable(error.message().replace('\n', "; ")))?;
        let files = Files { from: own_folder, to: folder.to_path_buf() };
        let plain = Self::of_scene(SceneRef::new(scene));
        let saved = self.with_whole_exposure()?;
        let expanded = remove_aliases(&mut document);
        for setting in list::own() {
            let Some(key) = &setting.key else { continue };
            let changed = |flag: &str| {
                let of = list::setting(flag);
                of.get(&saved) != of.get(&plain)
            };
            let value = setting.get(&saved);
            let given = table(&mut document, key).is_some_and(|table| table.contains_key(key.name));
            // A length that is written in metres is another one in scene units if the unit changes.
            let in_metres = changed("metres-per-unit")
                && matches!(value, Value::Single(_) | Value::Double(_))
                && has_text(&mut document, key);
            // The path of a file depends on the folder of the scene file.
            let moves = matches!(value, Value::File(_));
            let follows = || key.rests_on.iter().any(|flag| changed(flag)) && !given;
            if changed(setting.flag) || moves || in_metres || expanded.contains(&setting.flag) || follows() {
                write(&mut document, setting, key, item(&value, &files)?);
            }
        }
        match document.get_mut("mesh") {
            Some(Item::ArrayOfTables(meshes)) => {
                meshes.iter_mut().try_for_each(|mesh| files.move_file(mesh, "file"))?;
            }
            Some(Item::Value(toml_edit::Value::Array(meshes))) => {
                let mut meshes = meshes.iter_mut().filter_map(toml_edit::Value::as_inline_table_mut);
                meshes.try_for_each(|mesh| files.move_file(mesh, "file"))?;
            }
            _ => {}
        }
        if let Some(background) = document.get_mut("background").and_then(Item::as_table_like_mut) {
            files.move_file(background, "image")?;
        }
        Ok(document.to_string())
    }

    /// The same picture, with all of its brightness in `exposure`: the brightness of a scene is relative to its own
    /// lens and shutter.
    fn with_whole_exposure(&self) -> Result<Self> {
        let mut saved = self.clone();
        let brightness = self.exposure();
        if brightness != self.view.exposure_stops.exp2() {
            saved.view.exposure_stops = brightness.log2();
        }
        in_range(saved.view.exposure_stops, EXPOSURES)
            .map_err(|reason| Error::OutOfRange(format!("exposure of the saved scene {reason}")))?;
        Ok(saved)
    }
}

/// Removes the keys that stand for several settings, such as a known lens, and returns the flags of these settings, to
/// be written one by one, because any of them may have changed.
fn remove_aliases(document: &mut DocumentMut) -> Vec<&'static str> {
    let mut expanded = Vec::new();
    for alias in list::all() {
        if let (Role::Alias(of @ [_, _, ..]), Some(key)) = (alias.role, &alias.key)
            && table(document, key).and_then(|table| table.remove(key.name)).is_some()
        {
            expanded.extend(of);
        }
    }
    expanded
}

/// The table of a key, if the file has it.
fn table<'a>(document: &'a mut DocumentMut, key: &Key) -> Option<&'a mut dyn TableLike> {
    match key.table {
        "" => Some(document.as_table_mut()),
        name => document.get_mut(name)?.as_table_like_mut(),
    }
}

/// Whether the file has the number of a key as a text with a unit.
fn has_text(document: &mut DocumentMut, key: &Key) -> bool {
    let names = std::iter::once(key.name).chain(key.otherwise.iter().copied());
    let Some(table) = table(document, key) else { return false };
    names.filter_map(|name| table.get(name)).any(Item::is_str)
}

/// Writes a key and removes other keys for the same setting. Without a value, only removes.
fn write(document: &mut DocumentMut, setting: &Setting, key: &Key, item: Option<Item>) {
    if item.is_some() && table(document, key).is_none() {
        document.insert(key.table, toml_edit::table());
    }
    let Some(table) = table(document, key) else { return };
    let alias = |other: &&Setting| matches!(other.role, Role::Alias([of]) if *of == setting.flag);
    let aliases = list::all().filter(alias).filter_map(|other| other.key.as_ref());
    for other in aliases.map(|other| other.name).chain(key.otherwise.iter().copied()) {
        table.remove(other);
    }
    match item {
        Some(item) => table.insert(key.name, item),
        None => table.remove(key.name),
    };
}

/// A value as it is written in a scene file. `None` if the key is left out.
fn item(is: &Value, files: &Files) -> Result<Option<Item>> {
    Ok(Some(match is {
        Value::Single(number) => value(digits(*number)),
        Value::Double(number) => value(*number),
        Value::Whole(number) => value(i64::from(*number)),
        Value::Switch(is) => value(*is),
        Value::Vector(place) => list(place.to_array()),
        Value::Size(size) => list(size.map(i64::from)),
        Value::Name(NONE) | Value::File(None) | Value::Metres(_) => return Ok(None),
        Value::Name(name) => value(*name),
        Value::Tolerance(Tolerance::Pixels(pixels)) => value(digits(*pixels)),
        Value::Sensor(sensor) => value(sensor.to_string()),
        Value::Tolerance(tolerance) => value(tolerance.to_string()),
        Value::File(Some(file)) => value(files.seen(file)?),
    }))
}

/// The number with the fewest digits that is read back as this f32.
fn digits(number: f32) -> f64 {
    number.to_string().parse().unwrap_or(f64::from(number))
}

fn list<T: Into<toml_edit::Value>>(values: impl IntoIterator<Item = T>) -> Item {
    value(values.into_iter().collect::<Array>())
}

/// The folders of the old and the new scene file.
struct Files {
    from: PathBuf,
    to: PathBuf,
}

impl Files {
    /// Changes the path that a table has under this key, so that the new scene file finds it.
    fn move_file(&self, table: &mut dyn TableLike, key: &str) -> Result<()> {
        if let Some(file) = table.get(key).and_then(Item::as_str).map(|file| self.from.join(file)) {
            table.insert(key, value(self.seen(&file)?));
        }
        Ok(())
    }

    /// The path of a file in the new scene: relative if the file lies in the folder of the scene, or else absolute.
    fn seen(&self, file: &Path) -> Result<String> {
        let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let (file, folder) = (whole(file), whole(&self.to));
        let seen = file.strip_prefix(&folder).unwrap_or(&file);
        seen.to_str().map(str::to_owned).ok_or_else(|| not_text(seen))
    }
}

/// An error for a file name that is not text: a scene file is text, and would name another file.
fn not_text(path: &Path) -> Error {
    let path = quoted(path.as_os_str());
    Error::OutOfRange(format!(
        "the scene cannot be saved: it names the file {path}, whose name is not UTF-8, and a scene file holds only \
         that; rename the file"
    ))
}
