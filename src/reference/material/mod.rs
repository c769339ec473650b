//! Materials, which say what surfaces do with light. Each kind is a file with the name of its shader in
//! `shaders/material`.

mod albedo;
mod emissive;
mod glass;
mod layers;
mod matte;
mod metal;
mod microfacet;
mod mirror;
mod phong;
mod plastic;
mod standard;

use super::surface::Surface;
use crate::scene::Material;
use glam::DVec3;

/// A direction from which light comes.
pub(super) struct Scatter {
    pub(super) direction: DVec3,
    /// The BRDF times the cosine, divided by the density.
    pub(super) weight: DVec3,
    /// Per solid angle. `None` if there is only one such direction.
    pub(super) density: Option<f64>,
}

/// What a kind of material does with light. See `shaders/material/record.glsl`.
pub(super) trait Kind {
    /// The radiance that the material emits.
    fn emission(&self) -> DVec3 {
        DVec3::ZERO
    }

    /// The share of the ambient light that the material reflects.
    fn ambient(&self, _at: &Surface) -> DVec3 {
        DVec3::ZERO
    }

    /// The BRDF: the radiance reflected towards the viewer, divided by the light's radiance and by the cosine.
    fn f(&self, _at: &Surface, _to_light: DVec3, _to_viewer: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    /// The direction of the mirror image that the viewer sees, and the weight of its radiance.
    fn mirrored(&self, _at: &Surface, _to_viewer: DVec3) -> Option<(DVec3, DVec3)> {
        None
    }

    /// A random direction from which light is scattered towards the viewer, chosen by three values in [0, 1).
    fn sample(&self, _at: &Surface, _to_viewer: DVec3, _xi: [f64; 3]) -> Option<Scatter> {
        None
    }

    /// The BRDF times the cosine for light from another direction, and the density with which [`Kind::sample`] chooses
    /// that direction, per solid angle. `None` if the material scatters into single directions.
    fn scattered(&self, _at: &Surface, _to_light: DVec3, _to_viewer: DVec3) -> Option<(DVec3, f64)> {
        None
    }
}

/// The functions of a material's kind.
pub(super) fn kind_of(material: &Material) -> &dyn Kind {
    match material {
        Material::Matte(of) => of,
        Material::Phong(of) => of,
        Material::Mirror(of) => of,
        Material::Emissive(of) => of,
        Material::Metal(of) => of,
        Material::Glass(of) => of,
        Material::Plastic(of) => of,
        Material::Standard(of) => of,
    }
}
