//! Triangle meshes from OBJ files.

use super::obj::{self, Face, Obj};
use super::{MAX_LENGTH, Material, Scene, Shaded, Triangle};
use crate::error::{Error, Result};
use crate::input_file;
use glam::{DQuat, DVec3, Vec3};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Where a mesh has no normals, an edge between faces whose normals differ by more stays an edge.
const CREASE_DEGREES: f32 = 40.0;

/// What a mesh is made of unless something else is said: a clay, with a faint gloss.
const CLAY: Material = Material {
    color: Vec3::new(0.75, 0.36, 0.2),
    checker: None,
    ka: 1.0,
    kd: 1.0,
    ks: 0.12,
    exponent: 24.0,
    reflectance: Vec3::ZERO,
    emission: Vec3::ZERO,
};

/// A mesh in the coordinates of its file.
pub(super) struct Mesh {
    file: String,
    /// The files it was read from.
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
        let text = input_file::read(path, input_file::MOST_BYTES)?;
        let obj = obj::parse(&text).map_err(|fault| Error::Scene {
            file: file.clone(),
            line: fault.line,
            message: fault.message,
        })?;
        if obj.faces.is_empty() {
            let message = "there are no faces ('f' lines); export the mesh as polygons".into();
            return Err(Error::Mesh { file, message });
        }
        let mut files = vec![path.to_path_buf()];
        let mut library = HashMap::new();
        for name in &obj.libraries {
            let path = path.with_file_name(name);
            match input_file::read(&path, input_file::MOST_BYTES) {
                Ok(text) => {
                    library.extend(obj::parse_library(&text));
                    files.push(path);
                }
                Err(error) => log::warn!("{file}: its colours are not read: {error}"),
            }
        }
        let colors = obj.materials.iter().map(|name| library.get(name).copied()).collect();
        Ok(Self { file, files, obj, colors })
    }

    /// What is wrong with it as a whole.
    pub(super) fn fault(&self, message: String) -> Error {
        Error::Mesh { file: self.file.clone(), message }
    }

    /// The corners of the box around the faces with the smallest and the largest coordinates.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        let corners = self.obj.faces.iter().flat_map(|face| face.positions);
        let positions = corners.map(|corner| self.obj.positions[corner as usize]);
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        positions.fold(empty, |[lower, upper], position| [lower.min(position), upper.max(position)])
    }

    /// Puts the mesh into a scene: in `material`, or else in the file's colours, or else in clay.
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
        let fail = |message: String| Err(self.fault(message));
        let positions: Vec<DVec3> =
            self.obj.positions.iter().map(|position| placement.apply(*position)).collect();
        // Also false for a NaN.
        let inside = |position: &DVec3| position.abs().max_element() <= f64::from(MAX_LENGTH);
        if !positions.iter().all(inside) {
            return fail(format!(
                "it reaches beyond {MAX_LENGTH:e}, where it is put; give it a smaller scale"
            ));
        }
        let vertices = |face: &Face| face.positions.map(|corner| positions[corner as usize]);
        let faces: Vec<&Face> = self.obj.faces.iter().filter(|face| has_area(vertices(face))).collect();
        let dropped = self.obj.faces.len() - faces.len();
        if faces.is_empty() {
            return fail(
                "none of its triangles has an area; export it again, or give it a larger scale".into(),
            );
        }
        if dropped > 0 {
            log::warn!("{}: {dropped} triangles have no area and are left out", self.file);
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
            shape: Triangle { vertices: vertices(face), normals },
            material: material_of(face.material),
            velocity,
        });
        scene.triangles.extend(triangles);
        scene.files.extend(self.files.iter().cloned());
        Ok(())
    }

    /// The unit normals of a face in the file, if it has three.
    fn file_normals(&self, face: &Face, placement: &Placement) -> Option<[Vec3; 3]> {
        let unit = |index: u32| {
            let normal = placement.rotation * self.obj.normals[index as usize].as_dvec3();
            normal.try_normalize().map(|normal| normal.as_vec3())
        };
        let [a, b, c] = face.normals?.map(unit);
        Some([a?, b?, c?])
    }

    /// Adds the materials that are needed, and gives the scene's index for the file's.
    fn add_materials(&self, scene: &mut Scene, material: Option<u32>) -> impl Fn(Option<u32>) -> u32 + use<> {
        let matte = |color| Material { color, ka: 1.0, kd: 1.0, ..Material::default() };
        let default = material.unwrap_or_else(|| scene.add_material("clay", CLAY));
        let own: Vec<u32> = match material {
            Some(_) => Vec::new(),
            None => {
                let named = self.obj.materials.iter().zip(&self.colors);
                named
                    .map(|(name, color)| {
                        color.map_or(default, |color| scene.add_material(name, matte(color)))
                    })
                    .collect()
            }
        };
        move |index| index.and_then(|index| own.get(index as usize).copied()).unwrap_or(default)
    }
}

/// Whether the normal of a triangle can be made a unit vector, in f32 too.
fn has_area([a, b, c]: [DVec3; 3]) -> bool {
    (b - a).cross(c - a).length_squared() >= f64::from(f32::MIN_POSITIVE)
}

/// Unit normals for triangles without: at each corner the mean over the triangles around its
/// position, by area, of those within the crease angle of this one.
fn crease_normals(triangles: &[[DVec3; 3]]) -> Vec<[Vec3; 3]> {
    let normals: Vec<(Vec3, f32)> = triangles
        .iter()
        .map(|[a, b, c]| {
            let across = (b - a).cross(c - a);
            let area = across.length();
            ((across / area).as_vec3(), area as f32)
        })
        .collect();
    let vertex_of_corner = merge(triangles.as_flattened());
    let vertex_count = vertex_of_corner.iter().max().map_or(0, |last| *last as usize + 1);
    // The triangles around vertex v are around[start[v] .. start[v + 1]].
    let mut start = vec![0_u32; vertex_count + 1];
    vertex_of_corner.iter().for_each(|vertex| start[*vertex as usize + 1] += 1);
    (0..vertex_count).for_each(|vertex| start[vertex + 1] += start[vertex]);
    let mut next = start.clone();
    let mut around = vec![0_u32; vertex_of_corner.len()];
    for (triangle, corners) in (0_u32..).zip(vertex_of_corner.chunks_exact(3)) {
        for vertex in corners {
            let slot = &mut next[*vertex as usize];
            around[*slot as usize] = triangle;
            *slot += 1;
        }
    }
    let least_cosine = CREASE_DEGREES.to_radians().cos();
    let corner_normal = |own: Vec3, vertex: u32| {
        let range = start[vertex as usize] as usize..start[vertex as usize + 1] as usize;
        let near = around[range].iter().map(|triangle| normals[*triangle as usize]);
        let sum = near.filter(|(normal, _)| normal.dot(own) >= least_cosine).map(|(n, area)| area * n);
        sum.sum::<Vec3>().try_normalize().unwrap_or(own)
    };
    let of_triangle = |((own, _), corners): (&(Vec3, f32), &[u32])| {
        [0, 1, 2].map(|corner: usize| corner_normal(*own, corners[corner]))
    };
    normals.iter().zip(vertex_of_corner.chunks_exact(3)).map(of_triangle).collect()
}

/// A number from 0 for each position, the same for equal ones: files repeat positions along seams.
fn merge(positions: &[DVec3]) -> Vec<u32> {
    let mut numbers = HashMap::with_capacity(positions.len() / 4);
    let number = |position: &DVec3| {
        // -0 and 0 are one place.
        let key = (*position + DVec3::ZERO).to_array().map(f64::to_bits);
        let next = u32::try_from(numbers.len()).unwrap_or(u32::MAX);
        *numbers.entry(key).or_insert(next)
    };
    positions.iter().map(number).collect()
}
