//! What is rendered, as plain values. Nothing here knows of a GPU.

mod aperture;
mod builtin;
mod bvh;
mod camera;
mod clusters;
mod crease;
mod file;
mod light;
mod material;
mod mesh;
mod middle;
mod obj;
mod optics;
mod overlay;
mod preset;
mod range;
mod shape;
mod stage;
mod texture;
mod toml;
mod view;

pub use aperture::*;
pub use builtin::{BUILTINS, Builtin};
pub use bvh::{Bvh, Node, Record};
pub use camera::{Camera, CameraModel, Frame, Hole, Lens};
pub use file::{Loaded, load, load_with_text};
pub use light::*;
pub use material::*;
pub use optics::{FRAME_HEIGHT_MM, vfov_of_focal_length};
pub use overlay::{FullScale, OVERLAYS, Overlay, Source};
pub use preset::{PRESETS, Preset};
pub use range::*;
pub use shape::*;
pub use texture::*;
pub use view::View;

use glam::{DVec3, Vec3};
use std::path::PathBuf;
use std::sync::Arc;

/// The largest width and height of a picture, in pixels.
pub const MAX_EXTENT: u32 = 16384;
/// The largest number of reflections that can be followed.
pub const MAX_BOUNCES: u32 = 64;

/// The smallest length that divides others, in scene units: its inverse stays finite in f32.
pub const MIN_LENGTH: f32 = 1e-6;
/// The largest length, colour or radiance: squares of cross products still fit in f32.
pub const MAX_LENGTH: f32 = 1e9;

/// A scene: shapes, materials, lights, and the camera and picture size it was composed for.
#[derive(Debug)]
pub struct Scene {
    /// The built-in's name, or the file's.
    pub name: String,
    /// The name that was given to [`load`]: a built-in's, or a path.
    pub source: PathBuf,
    /// The files that it was read from: its own, and those of its meshes.
    pub files: Vec<PathBuf>,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What forms the picture.
    pub model: CameraModel,
    /// The thin lens.
    pub lens: Lens,
    /// The hole of a camera without a lens.
    pub hole: Hole,
    /// The shape of the opening of the lens or the hole.
    pub aperture: Aperture,
    /// The picture's size in pixels, unless another is asked for.
    pub size: [u32; 2],
    /// How long the shutter is open, in seconds.
    pub shutter: f32,
    /// How it is shown at first. The brightness is given for the film's speed here, and for the lens and shutter
    /// above.
    pub view: View,
    /// How many reflections are followed, unless another number is asked for.
    pub max_bounces: u32,
    /// What is seen where nothing is hit.
    pub background: Background,
    /// Radiance of the ambient light.
    pub ambient: Vec3,
    /// Point and directional lights.
    pub lights: Vec<Light>,
    /// Materials, which shapes name by index.
    pub materials: Vec<Material>,
    /// The names of the materials.
    pub material_names: Vec<String>,
    /// The shapes, of all kinds.
    pub shapes: Vec<Shaded>,
}

/// How long the shutter is open, in seconds, unless the scene says otherwise.
const DEFAULT_SHUTTER: f32 = 1.0 / 60.0;

impl Scene {
    /// Whether anything in it moves.
    pub fn moves(&self) -> bool {
        self.shapes.iter().any(|of| of.velocity != Vec3::ZERO)
    }

    /// The shapes of a kind, each with all that belongs to it.
    pub fn of_kind<'a, T: 'a>(&'a self) -> impl Iterator<Item = (&'a T, &'a Shaded)>
    where
        &'a T: TryFrom<&'a Shape>,
    {
        self.shapes.iter().filter_map(|of| Some((<&T>::try_from(&of.shape).ok()?, of)))
    }

    /// Adds a material, and gives its index.
    fn add_material(&mut self, name: &str, material: Material) -> u32 {
        self.materials.push(material);
        self.material_names.push(name.to_owned());
        u32::try_from(self.materials.len() - 1).unwrap_or(u32::MAX)
    }
}

/// A loaded scene, shared. Two are equal when they are the same loading, whatever they hold.
#[derive(Debug, Clone)]
pub struct SceneRef(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    scene: Scene,
    middle: DVec3,
}

impl SceneRef {
    /// Shares a scene.
    pub fn new(scene: Scene) -> Self {
        let middle = middle::of(&scene);
        Self(Arc::new(Shared { scene, middle }))
    }

    /// The origin of the coordinates that a device computes with. It lies near the middle of the scene, for
    /// the f32 of a device keep few digits of what is far from their origin.
    pub fn middle(&self) -> DVec3 {
        self.0.middle
    }

    /// A point in a device's coordinates.
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
