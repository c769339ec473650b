//! The scene file's tables. A table's name says what the thing is: `[[sphere]]`, `[matte.NAME]`,
//! `[[directional]]`. Unknown keys are errors.

use super::file::Fault;
use super::material_format::{LightColor, MaterialList, MatteTable, MirrorTable, Named, PhongTable, white};
use super::mesh::{Mesh, Placement};
use super::number::{Count, Extent, NonNegative, Positive, Rgb, Vector};
use super::{
    Aabb, Aperture, ApertureImage, Background, Camera, CameraModel, DEFAULT_ISO, DEFAULT_SHUTTER, Hole, Lens,
    Light, LightKind, Plane, Scene, Shaded, Sphere, Triangle, VFOV_DEGREES,
};
use glam::Vec3;
use serde::Deserialize;
use std::path::Path;
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
struct CameraTable {
    eye: Vector,
    look_at: Vector,
    #[serde(default = "upwards")]
    up: Vector,
    vfov_degrees: Option<Positive>,
    view_distance: Option<Positive>,
    pixel_size: Option<Positive>,
    #[serde(default = "one")]
    metres_per_unit: Positive,
    #[serde(default)]
    model: ModelName,
    lens_diameter: Option<NonNegative>,
    f_number: Option<Positive>,
    focal_distance: Positive,
    hole_diameter: Option<NonNegative>,
    #[serde(default)]
    upright: bool,
    blades: Option<u32>,
    blade_rotation_degrees: Option<f32>,
    roundness: Option<f32>,
    anamorphic: Option<f32>,
    cats_eye: Option<f32>,
    aperture_image: Option<Spanned<String>>,
    shutter: Option<Positive>,
    iso: Option<Positive>,
}

#[derive(Deserialize, Default, Clone, Copy)]
#[serde(rename_all = "kebab-case")]
enum ModelName {
    #[default]
    ThinLens,
    Pinhole,
    Hole,
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

fn upwards() -> Vector {
    Vector(Vec3::Y)
}

fn one() -> Positive {
    Positive(1.0)
}

fn zero() -> Vector {
    Vector(Vec3::ZERO)
}

fn yes() -> bool {
    true
}

impl SceneFile {
    /// Files that the scene names lie in `folder`, unless their paths say otherwise.
    pub(super) fn into_scene(self, name: &str, folder: &Path) -> Result<Scene, Fault> {
        let size = [self.size[0].0, self.size[1].0];
        let View { camera, model, lens, hole, aperture, shutter, iso } = camera(&self.camera, size, folder)?;
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
            source: String::new(),
            camera,
            model,
            lens,
            hole,
            aperture,
            shutter,
            iso,
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
            scene.spheres.push(Shaded { shape, material, velocity: table.velocity.0 });
        }
        for table in &self.boxes {
            let shape = Aabb { lower: table.lower.0, upper: table.upper.get_ref().0 };
            if !shape.lower.cmplt(shape.upper).all() {
                return Err(fault(&table.upper, "upper must be greater than lower on every axis"));
            }
            let material = list.find(&table.material)?;
            scene.boxes.push(Shaded { shape, material, velocity: table.velocity.0 });
        }
        for table in &self.triangle {
            let vertices = [0, 1, 2].map(|corner| table.vertices.get_ref()[corner].0);
            let [a, b, c] = vertices;
            if (b - a).cross(c - a) == Vec3::ZERO {
                return Err(fault(&table.vertices, "the three vertices lie on one line"));
            }
            let material = list.find(&table.material)?;
            let shape = Triangle { vertices, normals: None };
            scene.triangles.push(Shaded { shape, material, velocity: table.velocity.0 });
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
        let (angles, position) = (self.rotate_degrees.0.as_dvec3(), self.position.0.as_dvec3());
        let placement = Placement::new(self.scale.f64(), angles, position);
        mesh.add_to(scene, &placement, material, self.velocity.0)
    }
}

fn camera(table: &Spanned<CameraTable>, size: [u32; 2], folder: &Path) -> Result<View, Fault> {
    let span = table;
    let table = table.get_ref();
    let vfov_radians = match (&table.vfov_degrees, &table.view_distance, &table.pixel_size) {
        (Some(degrees), None, None) => degrees.f64().to_radians(),
        (None, Some(distance), Some(pixel)) => {
            let half_height = 0.5 * f64::from(size[1]) * pixel.f64();
            2.0 * (half_height / distance.f64()).atan()
        }
        _ => {
            let message = "the camera needs either vfov_degrees, or view_distance and pixel_size";
            return Err(fault(span, message));
        }
    };
    if !VFOV_DEGREES.contains(&vfov_radians.to_degrees()) {
        let (degrees, low, high) = (vfov_radians.to_degrees(), VFOV_DEGREES.start(), VFOV_DEGREES.end());
        let message = format!("a vertical field of view of {degrees} degrees must be from {low} to {high}");
        return Err(fault(span, &message));
    }
    let (eye, look_at, up) = (table.eye.0, table.look_at.0, table.up.0);
    let camera = Camera { eye, look_at, up, vfov_radians, metres_per_unit: table.metres_per_unit.f64() };
    if let Some(message) = camera.fault() {
        return Err(fault(span, message));
    }
    let diameter = match (&table.lens_diameter, &table.f_number) {
        (Some(diameter), None) => diameter.0,
        (None, Some(f_number)) => camera.diameter_of_f_number(f_number.f64()) as f32,
        _ => return Err(fault(span, "the camera needs either lens_diameter or f_number")),
    };
    let hole = table.hole_diameter.as_ref().map_or(camera.default_hole_diameter(), |diameter| diameter.0);
    Ok(View {
        camera,
        model: match table.model {
            ModelName::ThinLens => CameraModel::ThinLens,
            ModelName::Pinhole => CameraModel::Pinhole,
            ModelName::Hole => CameraModel::Hole,
        },
        lens: Lens { diameter, focal_distance: table.focal_distance.f32() },
        hole: Hole { diameter: hole, upright: table.upright },
        aperture: aperture(span, folder)?,
        shutter: table.shutter.as_ref().map_or(DEFAULT_SHUTTER, Positive::f32),
        iso: table.iso.as_ref().map_or(DEFAULT_ISO, Positive::f32),
    })
}

fn aperture(table: &Spanned<CameraTable>, folder: &Path) -> Result<Aperture, Fault> {
    let CameraTable {
        blades, blade_rotation_degrees, roundness, anamorphic, cats_eye, aperture_image, ..
    } = table.get_ref();
    let read = |file: &Spanned<String>| {
        let image = ApertureImage::read(&folder.join(file.get_ref()));
        image.map_err(|error| fault(file, &error.to_string()))
    };
    let plain = Aperture::default();
    let aperture = Aperture {
        blades: blades.unwrap_or(plain.blades),
        rotation_degrees: blade_rotation_degrees.unwrap_or(plain.rotation_degrees),
        roundness: roundness.unwrap_or(plain.roundness),
        anamorphic: anamorphic.unwrap_or(plain.anamorphic),
        cats_eye: cats_eye.unwrap_or(plain.cats_eye),
        image: aperture_image.as_ref().map(read).transpose()?,
    };
    match aperture.fault() {
        Some(message) => Err(fault(table, &message)),
        None => Ok(aperture),
    }
}

/// What the camera's table says.
struct View {
    camera: Camera,
    model: CameraModel,
    lens: Lens,
    hole: Hole,
    aperture: Aperture,
    shutter: f32,
    iso: f32,
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
    match vector.get_ref().0 {
        Vec3::ZERO => Err(fault(vector, "this vector must not be zero")),
        other => Ok(other),
    }
}

pub(super) fn fault<T>(at: &Spanned<T>, message: &str) -> Fault {
    Fault { span: at.span(), message: message.to_owned() }
}
