//! Settings as a scene file: the scene's own, with the camera, its lens and the view as they are now.

use super::arguments::quoted;
use super::{EXPOSURES, Settings, in_range, name_of};
use crate::error::{Error, Result};
use crate::scene::{self, CameraModel, Loaded, Overlay, Scene};
use glam::DVec3;
use std::path::{Path, PathBuf};
use toml_edit::{Array, DocumentMut, Item, Table, TableLike, Value, value};

impl Settings {
    /// The text of a scene file in this folder that gives this picture, but for how it is sampled. What the
    /// scene's own file says otherwise stays, comments too. Where brightness is what changed, it goes into
    /// `exposure`, for a scene's brightness is relative to its own lens and shutter.
    ///
    /// # Errors
    /// Of reading the scene's own file, which may have changed since.
    pub fn scene_file(&self, folder: &Path) -> Result<String> {
        let source = &self.estimator.scene.source;
        // The file may have changed since it was loaded.
        let Loaded { scene, text, folder: own_folder } = scene::load_with_text(source)?;
        let unusable =
            |message: String| Error::Scene { file: source.display().to_string(), line: 1, message };
        // The text of the stage around a mesh has its name.
        let is_mesh = source.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj"));
        if is_mesh && source.file_name().is_some_and(|name| name.to_str().is_none()) {
            return Err(not_text(source));
        }
        let mut document: DocumentMut = text
            .parse()
            .map_err(|error: toml_edit::TomlError| unusable(error.message().replace('\n', "; ")))?;
        let files = Files { from: own_folder, to: folder.to_path_buf() };
        if self.estimator.size != scene.size {
            document["size"] = list(self.estimator.size.map(|extent| i64::from(extent).into()));
        }
        if self.estimator.max_bounces != scene.max_bounces {
            document["max_bounces"] = value(i64::from(self.estimator.max_bounces));
        }
        let camera = document.get_mut("camera").and_then(Item::as_table_like_mut);
        let camera = camera.ok_or_else(|| unusable("the file has no [camera] any more".into()))?;
        self.write_camera(&mut Keys(camera), &scene, &files)?;
        match document.get_mut("mesh") {
            Some(Item::ArrayOfTables(meshes)) => {
                meshes.iter_mut().try_for_each(|mesh| files.move_mesh(mesh))?;
            }
            Some(Item::Value(Value::Array(meshes))) => {
                let mut meshes = meshes.iter_mut().filter_map(Value::as_inline_table_mut);
                meshes.try_for_each(|mesh| files.move_mesh(mesh))?;
            }
            _ => {}
        }
        if let Some(view) = document.get_mut("view").and_then(Item::as_table_like_mut) {
            self.write_view(&mut Keys(view), &scene)?;
        } else {
            let mut view = Table::new();
            self.write_view(&mut Keys(&mut view), &scene)?;
            if !view.is_empty() {
                document["view"] = Item::Table(view);
            }
        }
        Ok(document.to_string())
    }

    fn write_camera(&self, keys: &mut Keys<'_>, scene: &Scene, files: &Files) -> Result<()> {
        let estimator = &self.estimator;
        let (camera, own) = (&estimator.camera, &scene.camera);
        keys.vector("eye", camera.eye, own.eye);
        keys.vector("look_at", camera.look_at, own.look_at);
        keys.vector("up", camera.up, own.up);
        keys.change("metres_per_unit", camera.metres_per_unit, own.metres_per_unit, |is| is);
        // Lengths that the file gives by way of these are given themselves once these change.
        let resized = estimator.size[1] != scene.size[1] && keys.0.contains_key("view_distance");
        let units = (camera.vfov_radians, camera.metres_per_unit) != (own.vfov_radians, own.metres_per_unit);
        let preset = keys.0.contains_key("preset");
        if camera.vfov_radians != own.vfov_radians || resized || preset {
            keys.put("vfov_degrees", camera.vfov_degrees(), &["view_distance", "pixel_size"]);
        }
        if estimator.model != scene.model || preset {
            keys.put("model", name_of(&CameraModel::NAMES, &estimator.model), &[]);
        }
        if estimator.lens.diameter != scene.lens.diameter || units || preset {
            keys.put("lens_diameter", digits(estimator.lens.diameter), &["f_number", "preset"]);
        }
        if estimator.hole.diameter != scene.hole.diameter || units {
            keys.put("hole_diameter", digits(estimator.hole.diameter), &[]);
        }
        keys.number("focal_distance", estimator.lens.focal_distance, scene.lens.focal_distance);
        keys.change("upright", estimator.hole.upright, scene.hole.upright, |is| is);

        let (aperture, own) = (&estimator.aperture, &scene.aperture);
        keys.change("blades", aperture.blades, own.blades, i64::from);
        keys.number("blade_rotation_degrees", aperture.rotation_degrees, own.rotation_degrees);
        keys.number("roundness", aperture.roundness, own.roundness);
        keys.number("anamorphic", aperture.anamorphic, own.anamorphic);
        keys.number("cats_eye", aperture.cats_eye, own.cats_eye);
        match &aperture.image {
            Some(image) => keys.put("aperture_image", files.seen(&image.file)?, &[]),
            None => drop(keys.0.remove("aperture_image")),
        }
        keys.number("shutter", estimator.shutter, scene.shutter);
        keys.number("iso", self.view.iso, scene.view.iso);
        Ok(())
    }

    fn write_view(&self, keys: &mut Keys<'_>, scene: &Scene) -> Result<()> {
        let (view, own) = (&self.view, &scene.view);
        let brightness = self.exposure();
        let relative = brightness != view.exposure_stops.exp2();
        let stops = if relative { brightness.log2() } else { view.exposure_stops };
        in_range(stops, EXPOSURES)
            .map_err(|fault| Error::OutOfRange(format!("exposure of the saved scene {fault}")))?;
        keys.number("exposure", stops, own.exposure_stops);
        keys.change("exposure_lock", view.exposure_lock, own.exposure_lock, |is| is);
        keys.number("tolerance", view.tolerance, own.tolerance);
        if view.overlay != own.overlay {
            match view.overlay {
                Some(overlay) => keys.put("overlay", name_of(&Overlay::NAMES, &overlay), &[]),
                None => drop(keys.0.remove("overlay")),
            }
        }
        Ok(())
    }
}

/// A table, of which only what changes is written.
struct Keys<'a>(&'a mut dyn TableLike);

impl Keys<'_> {
    /// Writes a key in place of others.
    fn put(&mut self, key: &str, is: impl Into<Value>, instead_of: &[&str]) {
        for other in instead_of {
            self.0.remove(other);
        }
        self.0.insert(key, value(is));
    }

    fn change<T: PartialEq, V: Into<Value>>(&mut self, key: &str, is: T, was: T, as_toml: impl Fn(T) -> V) {
        if is != was {
            self.put(key, as_toml(is), &[]);
        }
    }

    fn number(&mut self, key: &str, is: f32, was: f32) {
        self.change(key, is, was, digits);
    }

    fn vector(&mut self, key: &str, is: DVec3, was: DVec3) {
        if is != was {
            self.0.insert(key, list(is.to_array().map(Value::from)));
        }
    }
}

/// The number of as few digits that comes back as this f32.
fn digits(number: f32) -> f64 {
    number.to_string().parse().unwrap_or(f64::from(number))
}

fn list<const N: usize>(values: [Value; N]) -> Item {
    value(values.into_iter().collect::<Array>())
}

/// Where a scene's files are seen from.
struct Files {
    from: PathBuf,
    to: PathBuf,
}

impl Files {
    /// A mesh is found from the new scene.
    fn move_mesh(&self, mesh: &mut dyn TableLike) -> Result<()> {
        if let Some(file) = mesh.get("file").and_then(Item::as_str).map(|file| self.from.join(file)) {
            mesh.insert("file", value(self.seen(&file)?));
        }
        Ok(())
    }

    /// How a file is called in the new scene: from its folder if it lies in there, else by its whole path.
    fn seen(&self, file: &Path) -> Result<String> {
        let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let (file, folder) = (whole(file), whole(&self.to));
        let seen = file.strip_prefix(&folder).unwrap_or(&file);
        seen.to_str().map(str::to_owned).ok_or_else(|| not_text(seen))
    }
}

/// A scene file is text, and would name another file.
fn not_text(path: &Path) -> Error {
    let path = quoted(path.as_os_str());
    Error::OutOfRange(format!(
        "the scene cannot be saved: it names the file {path}, whose name is no UTF-8, and a scene file holds only \
         that; rename the file"
    ))
}
