//! Lights in the form that the shaders read. Each kind of light has a match arm.

use super::denormal::flush_denormals;
use crate::interface::light;
use crate::scene::{self, LightKind, Scene};
use bytemuck::{Pod, Zeroable};
use glam::DVec3;

/// `Light` of light/record.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Light {
    pub radiance: [f32; 3],
    pub kind: u32,
    pub position_or_direction: [f32; 3],
    pub pad0: u32,
}

/// `Environment` of light/record.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Environment {
    pub horizon: [f32; 3],
    pub pad0: u32,
    pub zenith: [f32; 3],
    pub pad1: u32,
    pub ambient: [f32; 3],
    pub bounding_radius: f32,
}

impl Light {
    /// The light in coordinates whose origin is `origin`.
    pub fn new(of: &scene::Light, origin: DVec3) -> Self {
        let (kind, position_or_direction) = match of.kind {
            LightKind::Point(point) => (light::POINT, (point.position - origin).as_vec3()),
            LightKind::Directional(sun) => {
                (light::DIRECTIONAL, sun.direction.as_dvec3().normalize().as_vec3())
            }
        };
        Self {
            radiance: flush_denormals(of.radiance),
            kind,
            position_or_direction: flush_denormals(position_or_direction),
            pad0: 0,
        }
    }
}

impl Environment {
    /// The sky and the ambient light of a scene whose bounded shapes lie within `bounding_radius` of the origin.
    pub fn new(scene: &Scene, bounding_radius: f32) -> Self {
        Self {
            horizon: flush_denormals(scene.background.horizon),
            zenith: flush_denormals(scene.background.zenith),
            ambient: flush_denormals(scene.ambient),
            bounding_radius,
            ..Zeroable::zeroed()
        }
    }
}
