//! Lights in the form that the shaders read. Each kind of light has a match arm.

use super::ShapeRecord;
use super::denormal::{flush_denormal, flush_denormals};
use super::shape::on_device;
use crate::interface::light;
use crate::scene::{self, LightKind, Scene, Shaded, luminance};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

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
    pub panorama_size: [u32; 2],
    pub panorama_scale: f32,
    pub panorama_turns: f32,
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

/// `Lamp` of light/lamps.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Lamp {
    pub shape: ShapeRecord,
    pub radiance: [f32; 3],
    pub end: f32,
    pub velocity: [f32; 3],
    pub pad0: u32,
}

impl Lamp {
    /// The lamps of a scene in coordinates whose origin is `origin`, and the sum of luminance times area.
    pub fn all(scene: &Scene, origin: DVec3) -> (Vec<Self>, f64) {
        let emitted = |of: &Shaded| match &scene.materials[of.material as usize] {
            scene::Material::Emissive(lamp) => lamp.radiance,
            _ => Vec3::ZERO,
        };
        if !scene.materials.iter().any(|of| matches!(of, scene::Material::Emissive(_))) {
            return (Vec::new(), 0.0);
        }
        let mut power = 0.0;
        let mut ends = Vec::new();
        let mut lamps = Vec::new();
        for of in scene.shapes.iter() {
            let radiance = emitted(of);
            let of_lamp = luminance(radiance.as_dvec3()) * of.shape.area().unwrap_or(0.0);
            if of_lamp > 0.0 {
                power += of_lamp;
                ends.push(power);
                lamps.push(Self {
                    shape: ShapeRecord::new(&on_device(of, origin), 0),
                    radiance: flush_denormals(radiance),
                    end: 0.0,
                    velocity: flush_denormals(of.velocity),
                    pad0: 0,
                });
            }
        }
        for (lamp, end) in lamps.iter_mut().zip(ends) {
            lamp.end = (end / power) as f32;
        }
        (lamps, power)
    }
}

impl Environment {
    /// The sky and the ambient light of a scene whose bounded shapes lie within `bounding_radius` of the origin.
    pub fn new(scene: &Scene, bounding_radius: f32) -> Self {
        let sky = scene.background.gradient();
        let panorama = scene.background.panorama();
        Self {
            horizon: flush_denormals(sky.horizon),
            zenith: flush_denormals(sky.zenith),
            ambient: flush_denormals(scene.ambient),
            bounding_radius,
            panorama_size: panorama.map_or([0; 2], |of| of.image.size),
            panorama_scale: panorama.map_or(0.0, |of| flush_denormal(of.radiance * of.image.scale)),
            panorama_turns: panorama.map_or(0.0, |of| of.turn_degrees / 360.0),
            ..Zeroable::zeroed()
        }
    }
}
