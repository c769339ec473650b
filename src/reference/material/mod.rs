//! What surfaces do with light: a file a kind, with the name of its shader in `shaders/material`.

mod emissive;
mod matte;
mod mirror;
mod phong;

use super::surface::Surface;
use crate::scene::Material;
use glam::DVec3;

/// What a kind of material does. See `shaders/material/record.glsl`.
pub(super) trait Kind {
    /// The radiance that it gives off.
    fn emission(&self) -> DVec3 {
        DVec3::ZERO
    }

    /// The share of the ambient light that it reflects.
    fn ambient(&self, _at: &Surface) -> DVec3 {
        DVec3::ZERO
    }

    /// The share of a light's radiance, by the cosine, that it reflects towards the viewer.
    fn f(&self, _at: &Surface, _to_light: DVec3, _to_viewer: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    /// Where a ray of this direction goes on, and by how much what arrives from there counts.
    fn sample(&self, _at: &Surface, _direction: DVec3) -> Option<(DVec3, DVec3)> {
        None
    }
}

/// What a material does.
pub(super) fn kind_of(material: &Material) -> &dyn Kind {
    match material {
        Material::Matte(of) => of,
        Material::Phong(of) => of,
        Material::Mirror(of) => of,
        Material::Emissive(of) => of,
    }
}
