//! The scene file's tables. A table's name says what the thing is: `[[sphere]]`, `[matte.NAME]`,
//! `[[directional]]`. Unknown keys are errors.

use super::camera_format::{CameraTable, Shot, ViewTable, view};
use super::file::Fault;
use super::material_format::{LightColor, MaterialList, MatteTable, MirrorTable, Named, PhongTable, white};
use super::mesh::{Mesh, Placement};
use super::number::{Count, Extent, NonNegative, Positive, Rgb, Vector};
use super::{Aabb, Background, Light, LightKind, Plane, Scene, Shaded, Sphere, Triangle, View};
use glam::{DVec3, Vec3};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    #[serde(default = "default_size")]
    size: [Extent; 2],
    #[serde(default = "default_max_bounces")]
    max_bounces: Count,
    camera: Spanned<CameraTable>,
    #[serde(default)]
    view: Option<Spanned<ViewTable>>,
    #[serde(default)]
    background: Option<Spanned<BackgroundTable>>,
    #[serde(default)]
    ambient: Option<LightColor>,
    #[serde(default)]
    point: Vec<PointTable>,
    #[serde(default)]
    directional: Vec<DirectionalTable>,
    #[serde(default)]
    matte: Named<MatteTable>,
    #[serde(default)]
    phong: Named<PhongTable>,
    #[serde(default)]
    mirror: Named<MirrorTable>,
    #[serde(default)]
    emissive: Named<LightColor>,
    #[serde(default)]
    sphere: Vec<SphereTable>,
    #[serde(default, rename = "box")]
    boxes: Vec<BoxTable>,
    #[serde(default)]
    triangle: Vec<TriangleTable>,
    #[serde(default)]
    plane: Vec<PlaneTable>,
    #[serde(default)]
    mesh: Vec<MeshTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BackgroundTable {
    color: Option<Rgb>,
    horizon: Option<Rgb>,
    zenith: Option<Rgb>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PointTable {
    position: Vector,
    #[serde(default = "white")]
    color: Rgb,
    radiance: NonNegative,
    #[serde(default = "yes")]
    shadows: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DirectionalTable {
    direction: Spanned<Vector>,
    #[serde(default = "white")]
    color: Rgb,
    radiance: NonNegative,
    #[serde(default = "yes")]
    shadows: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereTable {
    center: Vector,
    radius: Positive,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BoxTable {
    lower: Vector,
    upper: Spanned<Vector>,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TriangleTable {
    vertices: Spanned<[Vector; 3]>,
    material: Spanned<String>,
    #[serde(default = "zero")]
    velocity: Vector,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneTable {
    point: Vector,
    normal: Spanned<Vector>,
    material: Spanned<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MeshTable {
    file: Spanned<String>,
    material: Option<Spanned<String>>,
    #[serde(default = "one")]
    scale: Positive,
    #[serde(default = "zero")]
    rotate_degrees: Vector,
    #[serde(default = "zero")]
    position: Vector,
    #[serde(default = "zero")]
    velocity: Vector,
}

fn default_size() -> [Extent; 2] {
    [Extent(1280), Extent(720)]
}

fn default_max_bounces() -> Count {
    Count(5)
}

fn one() -> Positive {
    Positive(1.0)
}

fn zero() -> Vector {
    Vector(DVec3::ZERO)
}

fn yes() -> bool {
    true
}

impl SceneFile {
    /// Files that the scene names lie in `folder`, unless their paths say otherwise.
    pub(super) fn into_scene(self, name: &str, folder: &Path) -> Result<Scene, Fault> {
        let size = [self.size[0].0, self.size[1].0];
        let Shot { camera, model, lens, hole, aperture, shutter, iso } =
            Shot::new(&self.camera, size, folder)?;
        let view = View { iso, ..view(self.view.as_ref())? };
        let background = background(self.background.as_ref())?;
        let ambient = self.ambient.as_ref().map_or(Vec3::ZERO, LightColor::radiance);
        let lights = self.lights()?;
        let mut list = MaterialList::default();
        list.add(self.matte)?;
        list.add(self.phong)?;
        list.add(self.mirror)?;
        list.add(self.emissive)?;

        let mut scene = Scene {
            name: name.to_owned(),
            source: PathBuf::new(),
            files: Vec::new(),
            camera,
            model,
            lens,
            hole,
            aperture,
            shutter,
            view,
            size,
            max_bounces: self.max_bounces.0,
            background,
            ambient,
            lights,
            materials: Vec::new(),
            material_names: Vec::new(),
            spheres: Vec::new(),
            boxes: Vec::new(),
            triangles: Vec::new(),
            planes: Vec::new(),
        };
        for table in &self.sphere {
            let shape = Sphere { center: table.center.0, radius: table.radius.f32() };
            let material = list.find(&table.material)?;
            scene.spheres.push(Shaded { shape, material, velocity: table.velocity.f32() });
        }
        for table in &self.boxes {
            let shape = Aabb { lower: table.lower.0, upper: table.upper.get_ref().0 };
            if !shape.lower.cmplt(shape.upper).all() {
                return Err(fault(&table.upper, "upper must be greater than lower on every axis"));
            }
            let material = list.find(&table.material)?;
            scene.boxes.push(Shaded { shape, material, velocity: table.velocity.f32() });
        }
        for table in &self.triangle {
            let vertices = [0, 1, 2].map(|corner| table.vertices.get_ref()[corner].0);
            let shape = Triangle { vertices, normals: None };
            if !shape.has_area() {
                return Err(fault(
                    &table.vertices,
                    "the three vertices lie on one line, or too near one another",
                ));
            }
            let material = list.find(&table.material)?;
            scene.triangles.push(Shaded { shape, material, velocity: table.velocity.f32() });
        }
        for table in &self.plane {
            let shape = Plane { point: table.point.0, normal: nonzero(&table.normal)? };
            let material = list.find(&table.material)?;
            scene.planes.push(Shaded::still(shape, material));
        }
        let of_mesh = |table: &MeshTable| table.material.as_ref().map(|name| list.find(name)).transpose();
        let of_meshes: Vec<Option<u32>> = self.mesh.iter().map(of_mesh).collect::<Result<_, _>>()?;
        (scene.materials, scene.material_names) = (list.materials, list.names);
        for (table, material) in self.mesh.iter().zip(of_meshes) {
            table
                .add_to(&mut scene, folder, material)
                .map_err(|error| fault(&table.file, &error.to_string()))?;
        }
        Ok(scene)
    }

    fn lights(&self) -> Result<Vec<Light>, Fault> {
        let mut lights = Vec::new();
        for table in &self.point {
            lights.push(Light {
                kind: LightKind::Point(table.position.0),
                radiance: table.color.0 * table.radiance.0,
                shadows: table.shadows,
            });
        }
        for table in &self.directional {
            lights.push(Light {
                kind: LightKind::Directional(nonzero(&table.direction)?),
                radiance: table.color.0 * table.radiance.0,
                shadows: table.shadows,
            });
        }
        Ok(lights)
    }
}

impl MeshTable {
    fn add_to(&self, scene: &mut Scene, folder: &Path, material: Option<u32>) -> crate::error::Result<()> {
        let mesh = Mesh::read(&folder.join(self.file.get_ref()))?;
        let placement = Placement::new(self.scale.f64(), self.rotate_degrees.0, self.position.0);
        mesh.add_to(scene, &placement, material, self.velocity.f32())
    }
}

fn background(table: Option<&Spanned<BackgroundTable>>) -> Result<Background, Fault> {
    let Some(span) = table else {
        return Ok(Background { horizon: Vec3::ZERO, zenith: Vec3::ZERO });
    };
    let table = span.get_ref();
    match (&table.color, &table.horizon, &table.zenith) {
        (Some(color), None, None) => Ok(Background { horizon: color.0, zenith: color.0 }),
        (None, Some(horizon), Some(zenith)) => Ok(Background { horizon: horizon.0, zenith: zenith.0 }),
        _ => Err(fault(span, "the background needs either color, or horizon and zenith")),
    }
}

fn nonzero(vector: &Spanned<Vector>) -> Result<Vec3, Fault> {
    match vector.get_ref().f32() {
        Vec3::ZERO => Err(fault(vector, "this vector must not be zero")),
        other => Ok(other),
    }
}

pub(super) fn fault<T>(at: &Spanned<T>, message: &str) -> Fault {
    Fault { span: at.span(), message: message.to_owned() }
}
