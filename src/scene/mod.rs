//! Scenes as plain values. This module does not know of a GPU.

mod aperture;
mod builtin;
mod bvh;
mod camera;
mod clusters;
mod color;
mod crease;
mod file;
mod image;
mod in_view;
mod integrator;
mod light;
mod material;
mod mesh;
mod middle;
mod movements;
mod obj;
mod optics;
mod overlay;
mod preset;
mod range;
mod sensor;
mod shape;
mod stage;
mod texture;
mod toml;
mod two_depths;
mod typed;
mod view;

pub use aperture::*;
pub use builtin::{BUILTINS, Builtin};
pub use bvh::{Bvh, Node, Record};
pub use camera::*;
pub(crate) use color::linear_of_srgb;
pub use color::luminance;
pub use file::{Loaded, load, load_with_text};
pub use image::{Image, Texels};
pub use in_view::{Depths, Extents};
pub use integrator::Integrator;
pub use light::*;
pub use material::*;
pub use movements::FocalPlane;
pub use overlay::{FullScale, OVERLAYS, Overlay, Source};
pub use preset::{PRESETS, Preset};
pub use range::{in_range, in_range_or_zero};
pub use sensor::*;
pub use shape::*;
pub use stage::{COLORS, LIGHT_STRENGTHS, ModelMaterial, Stage, TURNS, UpAxis};
pub use texture::*;
pub use typed::{Typed, Unit, metric, rounded};
pub use view::*;

use crate::error::Result;
use glam::{DVec3, Vec3};
use std::path::PathBuf;
use std::sync::Arc;

/// The largest width and height of a picture, in pixels.
pub const MAX_EXTENT: u32 = 16384;
/// The largest number of bounces that can be followed.
pub const MAX_BOUNCES: u32 = 64;

/// The time that the shutter is open, in seconds.
pub const SHUTTERS: [f32; 2] = [1e-6, 1e4];

/// The smallest length that others are divided by, in scene units. Its inverse is finite in f32.
pub const MIN_LENGTH: f32 = 1e-6;
/// The largest length, colour or radiance. Squares of cross products of such lengths still fit in f32.
pub const MAX_LENGTH: f32 = 1e9;
/// The coordinates of a position.
pub const PLACES: [f64; 2] = [-(MAX_LENGTH as f64), MAX_LENGTH as f64];

/// A scene: shapes, materials and lights, with a camera and a picture size.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The name of the built-in scene or of the file.
    pub name: String,
    /// What was given to [`load`]: the name of a built-in scene, or a path.
    pub source: PathBuf,
    /// The files that the scene was read from: its own file and those of its meshes.
    pub files: Vec<PathBuf>,
    /// The position and the field of view of the camera.
    pub camera: Camera,
    /// The camera model.
    pub model: CameraModel,
    /// The thin lens.
    pub lens: Lens,
    /// The hole of a camera without a lens.
    pub hole: Hole,
    /// The shape of the aperture of the lens or of the hole.
    pub aperture: Aperture,
    /// The default size of the picture in pixels.
    pub size: [u32; 2],
    /// How long the shutter is open, in seconds.
    pub shutter: f32,
    /// How the picture is shown by default. The exposure is relative to the lens and the shutter above and to the speed
    /// of the film given here.
    pub view: View,
    /// The integrator that the scene is made for.
    pub integrator: Integrator,
    /// The default number of bounces: see [`crate::settings::Estimator::max_bounces`].
    pub max_bounces: u32,
    /// What is seen where a ray hits nothing.
    pub background: Background,
    /// The radiance of the ambient light.
    pub ambient: Vec3,
    /// The point lights and directional lights.
    pub lights: Vec<Light>,
    /// The materials. Shapes refer to them by index.
    pub materials: Vec<Material>,
    /// The names of the materials.
    pub material_names: Vec<String>,
    /// The shapes of all kinds.
    pub shapes: Arc<Vec<Shaded>>,
    /// The lone mesh that the scene is made around, if it is.
    staged: Option<stage::Staged>,
}

/// The default time that the shutter is open, in seconds.
const DEFAULT_SHUTTER: f32 = 1.0 / 60.0;

impl Scene {
    /// The shapes of one kind, each with its material and its velocity.
    pub fn of_kind<'a, T: 'a>(&'a self) -> impl Iterator<Item = (&'a T, &'a Shaded)>
    where
        &'a T: TryFrom<&'a Shape>,
    {
        self.shapes.iter().filter_map(|of| Some((<&T>::try_from(&of.shape).ok()?, of)))
    }

    /// Adds a material and returns its index.
    fn add_material(&mut self, name: &str, material: Material) -> u32 {
        self.materials.push(material);
        self.material_names.push(name.to_owned());
        u32::try_from(self.materials.len() - 1).unwrap_or(u32::MAX)
    }
}

/// A shared scene. Two are equal if they come from the same loading, whatever their contents.
#[derive(Debug, Clone)]
pub struct SceneRef(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    scene: Scene,
    middle: DVec3,
    moves: bool,
}

impl SceneRef {
    /// Shares a scene.
    pub fn new(scene: Scene) -> Self {
        let middle = middle::of(&scene);
        let moves = scene.shapes.iter().any(|of| of.velocity != Vec3::ZERO);
        Self(Arc::new(Shared { scene, middle, moves }))
    }

    /// Shares this scene, whose shapes are those of another one.
    fn with_shapes_of(scene: Scene, other: &Self) -> Self {
        Self(Arc::new(Shared { scene, middle: other.middle(), moves: other.moves() }))
    }

    /// The scene with its model shown like this. `None` for a scene without a model.
    ///
    /// # Errors
    /// [`crate::error::Error::Mesh`] if the model cannot be shown.
    pub fn with_stage(&self, stage: &Stage) -> Result<Option<Self>> {
        Ok(self.0.scene.with_stage(stage)?.map(|scene| {
            if self.shares_shapes(&scene) { Self::with_shapes_of(scene, self) } else { Self::new(scene) }
        }))
    }

    /// Whether the shapes of both are the same in memory.
    pub fn shares_shapes(&self, other: &Scene) -> bool {
        Arc::ptr_eq(&self.shapes, &other.shapes)
    }

    /// The origin of the coordinates that a device computes with. It is near the middle of the scene, because f32 has
    /// few digits for points that are far from the origin.
    pub fn middle(&self) -> DVec3 {
        self.0.middle
    }

    /// Whether anything in the scene moves.
    pub fn moves(&self) -> bool {
        self.0.moves
    }

    /// A point in the coordinates of a device.
    pub fn on_device(&self, point: DVec3) -> Vec3 {
        (point - self.middle()).as_vec3()
    }
}

impl PartialEq for SceneRef {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl std::ops::Deref for SceneRef {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.0.scene
    }
}
