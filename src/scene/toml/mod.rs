//! The scene file's tables. A table's name says what the thing is: `[[sphere]]`, `[matte.NAME]`,
//! `[[directional]]`. Unknown keys are errors.

mod camera;
pub(super) mod fault;
mod material;
mod mesh;
pub(super) mod number;
pub(super) mod text;
mod view;
mod words;

use super::shape::{self, ShapeTable, shape_kinds};
use super::{Background, Light, LightKind, Scene, Shaded, View};
use camera::{CameraTable, Shot};
use fault::{Fault, fault};
use glam::Vec3;
use material::{LightColor, MaterialList, MatteTable, MirrorTable, Named, PhongTable, white};
use mesh::MeshTable;
use number::{Count, Extent, NonNegative, Rgb, Vector, nonzero};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use toml::Spanned;
use view::{ViewTable, view};

/// Reads the text of a scene file.
pub(super) fn read(text: &str) -> Result<SceneFile, Fault> {
    words::read(text)
}

macro_rules! define_scene_file {
    ($(($kind:ident, $table:ident, $name:ident),)+) => {
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
            mesh: Vec<MeshTable>,
            $(#[serde(default)]
            $name: Vec<shape::$table>,)+
        }

        impl SceneFile {
            /// The shapes, kind by kind.
            fn shapes(&self, materials: &MaterialList) -> Result<Vec<Shaded>, Fault> {
                let mut shapes = Vec::new();
                $(for table in &self.$name {
                    let (shape, material) = (table.shape()?, materials.find(table.material())?);
                    shapes.push(Shaded { shape, material, velocity: table.velocity() });
                })+
                Ok(shapes)
            }
        }
    };
}
shape_kinds!(define_scene_file);

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

fn default_size() -> [Extent; 2] {
    [Extent(1280), Extent(720)]
}

fn default_max_bounces() -> Count {
    Count(5)
}

fn yes() -> bool {
    true
}

impl SceneFile {
    /// Files that the scene names lie in `folder`, unless their paths say otherwise.
    pub(super) fn into_scene(mut self, name: &str, folder: &Path) -> Result<Scene, Fault> {
        let size = [self.size[0].0, self.size[1].0];
        let Shot { camera, model, lens, hole, aperture, shutter, iso } =
            Shot::new(&self.camera, size, folder)?;
        let view = View { iso, ..view(self.view.as_ref())? };
        let background = background(self.background.as_ref())?;
        let ambient = self.ambient.as_ref().map_or(Vec3::ZERO, LightColor::radiance);
        let lights = self.lights()?;
        let mut list = MaterialList::default();
        list.add(std::mem::take(&mut self.matte))?;
        list.add(std::mem::take(&mut self.phong))?;
        list.add(std::mem::take(&mut self.mirror))?;
        list.add(std::mem::take(&mut self.emissive))?;

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
            shapes: Vec::new(),
        };
        scene.shapes = self.shapes(&list)?;
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
