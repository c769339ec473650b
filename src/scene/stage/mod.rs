//! How a lone mesh is shown: which way it stands, its material, its ground, its sky and its light.

mod around;
mod text;

pub(super) use around::around;
pub(super) use text::text;

use super::mesh::{self, Mesh};
use super::{Emissive, Material, Matte, Mirror, Phong, Scene, Texture};
use crate::error::Result;
use glam::DVec3;
use std::sync::Arc;

/// The smallest and the largest turn of a model about the vertical, in degrees.
pub const TURNS: [f32; 2] = [-360.0, 360.0];
/// The weakest and the strongest key light. 1 is as strong as it is by default.
pub const LIGHT_STRENGTHS: [f32; 2] = [0.0, 1000.0];
/// The darkest and the brightest value of a channel of a colour, linear.
pub const COLORS: [f64; 2] = [0.0, 1.0];

/// How a lone mesh, which is called a model, is shown. All colours are linear r, g, b.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// The axis of the file that points up.
    pub up: UpAxis,
    /// How far the model is turned about the vertical, in degrees.
    pub turn_degrees: f32,
    /// What the model is made of.
    pub material: ModelMaterial,
    /// The colour of the material.
    pub color: DVec3,
    /// Whether it stands on a ground.
    pub ground: bool,
    /// The radiance of the sky straight up.
    pub sky: DVec3,
    /// The radiance of the sky at and below the horizon.
    pub horizon: DVec3,
    /// The direction towards the key light, of any length but zero.
    pub light_direction: DVec3,
    /// The strength of the key light, relative to the default.
    pub light_strength: f32,
}

impl Default for Stage {
    fn default() -> Self {
        Self {
            up: UpAxis::Y,
            turn_degrees: 0.0,
            material: ModelMaterial::Own,
            color: mesh::CLAY,
            ground: true,
            sky: DVec3::new(0.24, 0.44, 0.78),
            horizon: DVec3::new(0.92, 0.9, 0.87),
            // From the left, above and behind the camera.
            light_direction: DVec3::new(-0.5, 1.0, 0.65),
            light_strength: 1.0,
        }
    }
}

/// An axis of a mesh file. Its sign says in which direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the axes")]
pub enum UpAxis {
    Y,
    Z,
    X,
    MinusY,
    MinusZ,
    MinusX,
}

impl UpAxis {
    /// Every axis, by its name.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("y", Self::Y),
        ("z", Self::Z),
        ("x", Self::X),
        ("-y", Self::MinusY),
        ("-z", Self::MinusZ),
        ("-x", Self::MinusX),
    ];

    /// The angles about x, y and z, applied in this order, that make this axis point up and then turn the model about
    /// the vertical. After the axis x was made to point up, the vertical is the axis x of the turned model.
    fn rotate_degrees(self, turn: f64) -> DVec3 {
        match self {
            Self::Y => DVec3::new(0.0, turn, 0.0),
            Self::MinusY => DVec3::new(180.0, turn, 0.0),
            Self::Z => DVec3::new(-90.0, turn, 0.0),
            Self::MinusZ => DVec3::new(90.0, turn, 0.0),
            Self::X => DVec3::new(turn, 0.0, 90.0),
            Self::MinusX => DVec3::new(-turn, 0.0, -90.0),
        }
    }
}

/// What a model is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelMaterial {
    /// The colours of its MTL files. Without such colours, it is clay.
    Own,
    /// A matte material with a faint gloss.
    Clay,
    /// A material that reflects light evenly.
    Matte,
    /// A material with a bright highlight.
    Glossy,
    /// A mirror.
    Mirror,
    /// A material that emits light and reflects none.
    Glowing,
}

impl ModelMaterial {
    /// Every material, by its name.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("own", Self::Own),
        ("clay", Self::Clay),
        ("matte", Self::Matte),
        ("glossy", Self::Glossy),
        ("mirror", Self::Mirror),
        ("glowing", Self::Glowing),
    ];
}

impl Stage {
    /// The material of the whole mesh and its name. `None` if the mesh keeps the colours of its own files.
    fn material(&self, mesh: &Mesh) -> Option<(&'static str, Material)> {
        let texture = Texture::constant(self.color.as_vec3());
        let matte = Matte { color: texture, ka: 1.0, kd: 1.0 };
        let glossy = |ks, exponent| Phong { color: texture, ka: 1.0, kd: 1.0, ks, exponent }.into();
        Some(match self.material {
            ModelMaterial::Own if mesh.has_colors() => return None,
            ModelMaterial::Own | ModelMaterial::Clay => ("clay", mesh::clay(texture)),
            ModelMaterial::Matte => ("matte", matte.into()),
            ModelMaterial::Glossy => ("glossy", glossy(0.5, 120.0)),
            ModelMaterial::Mirror => {
                let reflectance = self.color.as_vec3();
                ("mirror", Mirror { reflectance, ks: 0.3, exponent: 400.0 }.into())
            }
            ModelMaterial::Glowing => ("glowing", Emissive { radiance: self.color.as_vec3() }.into()),
        })
    }

    /// Whether shapes, and which material each has, are the same as those of another stage for this mesh.
    fn has_shapes_of(&self, other: &Self, mesh: &Mesh) -> bool {
        let parts = |of: &Self| (of.up, of.turn_degrees, of.ground, of.material(mesh).is_some());
        parts(self) == parts(other)
    }
}

/// A mesh and how it is shown.
#[derive(Debug, Clone)]
pub(super) struct Staged {
    mesh: Arc<Mesh>,
    stage: Stage,
}

impl Scene {
    /// How the lone mesh of the scene is shown. `None` for a scene of another kind.
    pub fn stage(&self) -> Option<&Stage> {
        self.staged.as_ref().map(|staged| &staged.stage)
    }

    /// Whether the colour of the stage is the colour of the model.
    pub fn uses_color(&self) -> bool {
        self.staged.as_ref().is_some_and(|staged| staged.stage.material(&staged.mesh).is_some())
    }

    /// Whether only colours and lights change if the model is shown like this.
    pub fn keeps_shapes(&self, stage: &Stage) -> bool {
        self.staged.as_ref().is_some_and(|staged| stage.has_shapes_of(&staged.stage, &staged.mesh))
    }

    /// The scene with its model shown like this. `None` for a scene without a model.
    ///
    /// # Errors
    /// [`crate::error::Error::Mesh`] if the model cannot be shown.
    pub fn with_stage(&self, stage: &Stage) -> Result<Option<Self>> {
        self.staged.as_ref().map(|staged| around::again(self, staged, stage)).transpose()
    }
}
