//! Materials and their textures in the form that the shaders read. Each kind has a match arm.

use super::denormal::{flush_denormal, flush_denormals};
use crate::interface::{material, texture};
use crate::scene::{self, Matte};
use bytemuck::{Pod, Zeroable};
use glam::DVec3;

/// `Material` of material/record.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Material {
    pub color: Texture,
    pub ka: f32,
    pub kd: f32,
    pub ks: f32,
    pub exponent: f32,
    pub kind: u32,
    pub roughness: f32,
    pub index: f32,
    pub metallic: f32,
}

/// `Texture` of texture/record.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Texture {
    pub color: [f32; 3],
    pub kind: u32,
    pub other_color: [f32; 3],
    pub inverse_size: f32,
    pub phase: [f32; 3],
    pub pad0: u32,
}

impl Material {
    /// The material in coordinates whose origin is `origin`.
    pub fn new(of: &scene::Material, origin: DVec3) -> Self {
        let matte = |kind: u32, of: &Matte| Self {
            color: Texture::new(&of.color, origin),
            ka: flush_denormal(of.ka),
            kd: flush_denormal(of.kd),
            kind,
            ..Zeroable::zeroed()
        };
        let constant = |kind: u32, color| Self {
            color: Texture::new(&scene::Texture::constant(color), origin),
            kind,
            ..Zeroable::zeroed()
        };
        match of {
            scene::Material::Matte(of) => matte(material::MATTE, of),
            scene::Material::Phong(of) => {
                let highlight = (flush_denormal(of.ks), flush_denormal(of.exponent));
                Self { ks: highlight.0, exponent: highlight.1, ..matte(material::PHONG, &of.matte()) }
            }
            scene::Material::Mirror(of) => Self {
                ks: flush_denormal(of.ks),
                exponent: flush_denormal(of.exponent),
                ..constant(material::MIRROR, of.reflectance)
            },
            scene::Material::Emissive(of) => constant(material::EMISSIVE, of.radiance),
            scene::Material::Metal(of) => Self {
                color: Texture::new(&of.color, origin),
                roughness: flush_denormal(of.roughness),
                kind: material::METAL,
                ..Zeroable::zeroed()
            },
            scene::Material::Plastic(of) => Self {
                color: Texture::new(&of.color, origin),
                roughness: flush_denormal(of.roughness),
                index: of.index,
                kind: material::PLASTIC,
                ..Zeroable::zeroed()
            },
            scene::Material::Standard(of) => Self {
                color: Texture::new(&of.color, origin),
                roughness: flush_denormal(of.roughness),
                metallic: flush_denormal(of.metallic),
                kind: material::STANDARD,
                ..Zeroable::zeroed()
            },
            scene::Material::Glass(of) => Self {
                roughness: flush_denormal(of.roughness),
                index: of.index,
                ..constant(material::GLASS, of.absorption())
            },
        }
    }
}

impl Texture {
    fn new(of: &scene::Texture, origin: DVec3) -> Self {
        match of {
            scene::Texture::Constant(of) => {
                Self { color: flush_denormals(of.color), kind: texture::CONSTANT, ..Zeroable::zeroed() }
            }
            scene::Texture::Checker(of) => {
                // The checker repeats after two cells along each axis.
                let phase = origin.map(|coordinate| coordinate.rem_euclid(2.0 * of.size));
                Self {
                    color: flush_denormals(of.even),
                    kind: texture::CHECKER,
                    other_color: flush_denormals(of.odd),
                    inverse_size: of.size.recip() as f32,
                    phase: flush_denormals(phase.as_vec3()),
                    pad0: 0,
                }
            }
        }
    }
}
