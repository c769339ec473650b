//! The tables `[[mesh]]`.

use super::number::{Positive, Vector, zero};
use crate::error::Result;
use crate::scene::Scene;
use crate::scene::mesh::{Mesh, Placement};
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshTable {
    pub(super) file: Spanned<String>,
    pub(super) material: Option<Spanned<String>>,
    #[serde(default = "one")]
    scale: Positive,
    #[serde(default = "zero")]
    rotate_degrees: Vector,
    #[serde(default = "zero")]
    position: Vector,
    #[serde(default = "zero")]
    velocity: Vector,
}

fn one() -> Positive {
    Positive(1.0)
}

impl MeshTable {
    /// Reads the mesh, whose path is relative to `folder`, and adds its triangles, with this material if there is one.
    pub(super) fn add_to(&self, scene: &mut Scene, folder: &Path, material: Option<u32>) -> Result<()> {
        let mesh = Mesh::read(&folder.join(self.file.get_ref()))?;
        let placement = Placement::new(self.scale.f64(), self.rotate_degrees.0, self.position.0);
        mesh.add_to(scene, &placement, material, self.velocity.f32())
    }
}
