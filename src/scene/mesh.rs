//! Triangle meshes from OBJ files.

use super::crease::crease_normals;
use super::obj::{self, Face, Foreign, Library, Obj, ObjError, Paint};
use super::{MAX_LENGTH, Material, Matte, Phong, Scene, Shaded, Texture, Triangle};
use crate::error::{Error, Result};
use crate::input_file;
use glam::{DQuat, DVec3, Vec3};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The material of a mesh that has no other: clay, with a faint gloss.
pub(super) fn clay(color: Texture) -> Material {
    Phong { color, ka: 1.0, kd: 1.0, ks: 0.12, exponent: 24.0 }.into()
}

/// The colour of clay, unless another is chosen.
pub(super) const CLAY: DVec3 = DVec3::new(0.75, 0.36, 0.2);

/// A mesh in the coordinates of its file.
#[derive(Debug)]
pub(super) struct Mesh {
    file: String,
    /// The files that it was read from.
    files: Vec<PathBuf>,
    obj: Obj,
    /// The diffuse colour of each of the file's materials, where it has one.
    colors: Vec<Option<Vec3>>,
}

/// Where a mesh is put: scaled, then turned, then moved.
pub(super) struct Placement {
    pub(super) scale: f64,
    pub(super) rotation: DQuat,
    pub(super) position: DVec3,
}

impl Placement {
    /// Turned about the world's x axis first, then y, then z, by these angles in degrees.
    pub(super) fn new(scale: f64, rotate_degrees: DVec3, position: DVec3) -> Self {
        let [x, y, z] = rotate_degrees.to_array().map(f64::to_radians);
        let rotation = DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
        Self { scale, rotation, position }
    }

    fn apply(&self, position: DVec3) -> DVec3 {
        self.rotation * (self.scale * position) + self.position
    }
}

impl Mesh {
    /// Reads an OBJ file, and the colours of the MTL files that it names.
    ///
    /// # Errors
    /// [`Error::Read`], [`Error::Scene`] with a line, or [`Error::Mesh`].
    pub(super) fn read(path: &Path) -> Result<Self> {
        let file = path.display().to_string();
        let text = input_file::read(path, input_file::MAX_BYTES)?;
        let obj = obj::parse(&text).map_err(|error| match error {
            ObjError::Line(line, message) => Error::Scene { file: file.clone(), line, message },
            ObjError::Foreign(Foreign(what)) => {
                Error::Mesh { file: file.clone(), message: format!("this is not an OBJ file, it is {what}") }
            }
        })?;
        if obj.faces.is_empty() {
            let message = "there are no faces ('f' lines); export the mesh as polygons".into();
            return Err(Error::Mesh { file, message });
        }
        let mut files = vec![path.to_path_buf()];
        let colors = colors(path, &file, &obj, &mut files);
        let mesh = Self { file, files, obj, colors };
        mesh.warn_of_repairs();
        Ok(mesh)
    }

    fn warn_of_repairs(&self) {
        let Self { file, obj, .. } = self;
        for (tally, what) in [
            (&obj.unusable_normals, "normals (vn) without a direction are replaced by computed ones"),
            (&obj.short_faces, "faces of fewer than three corners are left out"),
            (&obj.crossed_faces, "polygons whose edges cross may be cut into other triangles than meant"),
        ] {
            if tally.count > 0 {
                log::warn!("{file}:{}: {what} ({} in the file)", tally.line, tally.count);
            }
        }
    }

    /// An error about the mesh as a whole.
    pub(super) fn error(&self, message: String) -> Error {
        Error::Mesh { file: self.file.clone(), message }
    }

    /// Whether its files give any of its faces a colour.
    pub(super) fn has_colors(&self) -> bool {
        self.colors.iter().any(Option::is_some)
    }

    /// The corners of the box around the turned faces with the smallest and the largest coordinates.
    pub(super) fn bounds(&self, rotation: DQuat) -> [DVec3; 2] {
        let corners = self.obj.faces.iter().flat_map(|face| face.corners);
        let positions = corners.map(|corner| rotation * self.obj.positions[corner.position as usize]);
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        positions.fold(empty, |[lower, upper], position| [lower.min(position), upper.max(position)])
    }

    /// Adds the mesh to a scene: with `material` if there is one, or else with the file's colours, or else as clay.
    ///
    /// # Errors
    /// [`Error::Mesh`] if it is too large there, or nothing of it is left.
    pub(super) fn add_to(
        &self,
        scene: &mut Scene,
        placement: &Placement,
        material: Option<u32>,
        velocity: Vec3,
    ) -> Result<()> {
        let fail = |message: String| Err(self.error(message));
        let positions: Vec<DVec3> =
            self.obj.positions.iter().map(|position| placement.apply(*position)).collect();
        // The comparison is false for a NaN too.
        let inside = |position: &DVec3| position.abs().max_element() <= f64::from(MAX_LENGTH);
        if !positions.iter().all(inside) {
            return fail(format!(
                "it reaches beyond {MAX_LENGTH:e}, where it is put; give it a smaller scale"
            ));
        }
        let vertices = |face: &Face| face.corners.map(|corner| positions[corner.position as usize]);
        let shape = |face: &Face| Triangle { vertices: vertices(face), normals: None };
        let faces: Vec<&Face> = self.obj.faces.iter().filter(|face| shape(face).has_area()).collect();
        let dropped = self.obj.faces.len() - faces.len();
        if faces.is_empty() {
            return fail(
                "none of its triangles has an area; export it again, or give it a larger scale".into(),
            );
        }
        if dropped > 0 {
            log::warn!(
                "{}: {dropped} triangles have no area, or one too small for f32, and are left out",
                self.file
            );
        }
        let mut own_normals: Vec<Option<[Vec3; 3]>> =
            faces.iter().map(|face| self.file_normals(face, placement)).collect();
        if own_normals.iter().any(Option::is_none) {
            let corners: Vec<[DVec3; 3]> = faces.iter().map(|face| vertices(face)).collect();
            let computed = crease_normals(&corners);
            for (own, computed) in own_normals.iter_mut().zip(computed) {
                own.get_or_insert(computed);
            }
        }
        let material_of = self.add_materials(scene, material);
        let triangles = faces.iter().zip(own_normals).map(|(face, normals)| Shaded {
            shape: Triangle { vertices: vertices(face), normals }.into(),
            material: material_of(face.material),
            velocity,
        });
        Arc::make_mut(&mut scene.shapes).extend(triangles);
        scene.files.extend(self.files.iter().cloned());
        Ok(())
    }

    /// The unit normals that the file gives for a face's corners, if all three can be used.
    fn file_normals(&self, face: &Face, placement: &Placement) -> Option<[Vec3; 3]> {
        let unit = |normal: Option<NonZeroU32>| {
            let normal = self.obj.normals[normal?.get() as usize - 1].as_dvec3();
            (placement.rotation * normal).try_normalize().map(|normal| normal.as_vec3())
        };
        let [a, b, c] = face.corners.map(|corner| unit(corner.normal));
        Some([a?, b?, c?])
    }

    /// Adds the materials that are needed to the scene. For each of the file's materials, gives its index in the scene.
    fn add_materials(&self, scene: &mut Scene, material: Option<u32>) -> impl Fn(Option<u32>) -> u32 + use<> {
        let matte = |color| Matte { color: Texture::constant(color), ka: 1.0, kd: 1.0 }.into();
        let default =
            material.unwrap_or_else(|| scene.add_material("clay", clay(Texture::constant(CLAY.as_vec3()))));
        let own: Vec<u32> = match material {
            Some(_) => Vec::new(),
            None => {
                let named = self.obj.materials.iter().zip(&self.colors);
                named
                    .map(|(name, color)| {
                        let name = String::from_utf8_lossy(name);
                        color.map_or(default, |color| scene.add_material(&name, matte(color)))
                    })
                    .collect()
            }
        };
        move |index| index.and_then(|index| own.get(index as usize).copied()).unwrap_or(default)
    }
}

/// The diffuse colour of each of a mesh's materials, where its MTL files have one.
fn colors(path: &Path, file: &str, obj: &Obj, read: &mut Vec<PathBuf>) -> Vec<Option<Vec3>> {
    let (files, missing) = obj::find_libraries(path.parent().unwrap_or(Path::new("")), &obj.libraries);
    let mut library = Library::default();
    for path in &files {
        let name = path.display();
        match input_file::read(path, input_file::MAX_BYTES).map(|text| obj::parse_library(&text)) {
            Ok(Ok(part)) => {
                read.push(path.clone());
                let (unreadable, first) = (&part.unreadable, &part.first_error);
                if unreadable.count > 0 {
                    let (line, count) = (unreadable.line, unreadable.count);
                    log::warn!("{name}:{line}: {first} ({count} such colours in the file)");
                }
                library.extend(part);
            }
            Ok(Err(Foreign(what))) => {
                log::warn!("{file}: its colours in {name} are not read: it is {what}");
            }
            Err(error) => log::warn!("{file}: its colours are not read: {error}"),
        }
    }
    if let Some(first) = missing.first() {
        let (first, more) = (String::from_utf8_lossy(first), missing.len() - 1);
        let others = if more > 0 { format!(", nor are those in {more} others") } else { String::new() };
        log::warn!("{file}: its colours in '{first}' are not read{others}: put the MTL file beside the mesh");
    }
    let paints: Vec<Option<Paint>> = obj.materials.iter().map(|name| library.find(name)).collect();
    let unknown = obj.materials.iter().zip(&paints).filter(|(_, paint)| paint.is_none());
    if let (Some((name, _)), false) = (unknown.clone().next(), files.is_empty()) {
        let (name, count) = (String::from_utf8_lossy(name), unknown.count());
        log::warn!(
            "{file}: its MTL files lack {count} of its materials, the first is '{name}'; they are clay"
        );
    }
    let pictured = paints.iter().flatten().filter(|paint| paint.pictured).count();
    if pictured > 0 {
        log::warn!(
            "{file}: {pictured} of its materials have a picture (map_Kd), and pictures are not read; they are \
             shown in their colour Kd, or in grey where that is black or missing"
        );
    }
    paints.iter().map(|paint| paint.and_then(|paint| paint.color())).collect()
}
