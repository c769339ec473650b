//! The tables of a scene file. The name of a table says what it describes: `[[sphere]]`, `[matte.NAME]`,
//! `[[directional]]`. Unknown keys are errors.

mod camera;
pub(super) mod error;
mod material_list;
mod mesh;
mod messages;
pub(super) mod number;
mod quantity;
pub(super) mod text;
mod view;

use super::light::{self, BackgroundTable, LightTable, background, light_kinds};
use super::material::{self, material_kinds};
use super::shape::{self, ShapeTable, shape_kinds};
use super::{Integrator, Light, Scene, Shaded, View};
use camera::{CameraTable, Shot};
use error::{ParseError, named};
use glam::Vec3;
use material_list::{MaterialList, Named};
use mesh::MeshTable;
use number::{Count, Extent, LightColor};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;
use view::{ViewTable, view};

/// Reads the text of a scene file.
pub(super) fn read(text: &str) -> Result<SceneFile, ParseError> {
    messages::read(text)
}

macro_rules! define_scene_file {
    (
        [$(($shape:ident, $shape_table:ident, $shape_name:ident),)+],
        [$(($light:ident, $light_values:ident, $light_table:ident, $light_name:ident),)+],
        [$(($material:ident, $material_table:ident, $material_name:ident),)+]
    ) => {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct SceneFile {
            #[serde(default = "default_size")]
            size: [Extent; 2],
            #[serde(default)]
            integrator: Option<Spanned<String>>,
            max_bounces: Option<Count>,
            camera: Spanned<CameraTable>,
            #[serde(default)]
            view: Option<Spanned<ViewTable>>,
            #[serde(default)]
            background: Option<Spanned<BackgroundTable>>,
            #[serde(default)]
            ambient: Option<LightColor>,
            #[serde(default)]
            mesh: Vec<MeshTable>,
            $(#[serde(default)]
            $light_name: Vec<light::$light_table>,)+
            $(#[serde(default)]
            $material_name: Named<material::$material_table>,)+
            $(#[serde(default)]
            $shape_name: Vec<shape::$shape_table>,)+
        }

        impl SceneFile {
            /// The shapes, kind by kind.
            fn shapes(&self, materials: &MaterialList) -> Result<Vec<Shaded>, ParseError> {
                let mut shapes = Vec::new();
                $(for table in &self.$shape_name {
                    let (shape, material) = (table.shape()?, materials.find(table.material())?);
                    shapes.push(Shaded { shape, material, velocity: table.velocity() });
                })+
                Ok(shapes)
            }

            /// The lights, kind by kind.
            fn lights(&self) -> Result<Vec<Light>, ParseError> {
                let lights = std::iter::empty()$(.chain(self.$light_name.iter().map(LightTable::light)))+;
                lights.collect()
            }

            /// The materials, kind by kind, which are taken out of the tables.
            fn take_materials(&mut self) -> Result<MaterialList, ParseError> {
                let mut list = MaterialList::default();
                $(list.add(std::mem::take(&mut self.$material_name))?;)+
                Ok(list)
            }
        }
    };
}
macro_rules! and_lights {
    ($shapes:tt) => {
        light_kinds!(and_materials, $shapes);
    };
}
macro_rules! and_materials {
    ($shapes:tt, $lights:tt) => {
        material_kinds!(define_scene_file, $shapes, $lights);
    };
}
shape_kinds!(and_lights);

fn default_size() -> [Extent; 2] {
    [Extent(1280), Extent(720)]
}

impl SceneFile {
    /// Makes the scene. Paths in the tables are relative to `folder`.
    pub(super) fn into_scene(mut self, name: &str, folder: &Path) -> Result<Scene, ParseError> {
        let size = [self.size[0].0, self.size[1].0];
        let Shot { camera, model, lens, hole, aperture, shutter, iso } =
            Shot::new(&self.camera, size, folder)?;
        let view = View { iso, ..view(self.view.as_ref())? };
        let background = background(self.background.as_ref(), folder)?;
        let ambient = self.ambient.as_ref().map_or(Vec3::ZERO, LightColor::radiance);
        let integrator = self.integrator.as_ref();
        let integrator = integrator.map(|name| named(&Integrator::NAMES, name, "integrator")).transpose()?;
        let integrator = integrator.unwrap_or_default();
        let max_bounces = self.max_bounces.as_ref().map(|count| count.0);
        let lights = self.lights()?;
        let list = self.take_materials()?;

        let mut scene = Scene {
            name: name.to_owned(),
            source: PathBuf::new(),
            files: background.panorama().map(|sky| sky.image.file.clone()).into_iter().collect(),
            camera,
            model,
            lens,
            hole,
            aperture,
            shutter,
            view,
            size,
            integrator,
            max_bounces: max_bounces.unwrap_or(integrator.default_max_bounces()),
            background,
            ambient,
            lights,
            materials: Vec::new(),
            material_names: Vec::new(),
            shapes: Arc::new(self.shapes(&list)?),
            staged: None,
        };
        let of_mesh = |table: &MeshTable| table.material.as_ref().map(|name| list.find(name)).transpose();
        let of_meshes: Vec<Option<u32>> = self.mesh.iter().map(of_mesh).collect::<Result<_, _>>()?;
        (scene.materials, scene.material_names) = (list.materials, list.names);
        for (table, material) in self.mesh.iter().zip(of_meshes) {
            table
                .add_to(&mut scene, folder, material)
                .map_err(|error| ParseError::at(&table.file, &error.to_string()))?;
        }
        Ok(scene)
    }
}
