//! Twins of the shaders' structs, byte for byte: the only place with padding. A test holds their
//! offsets against the compiled shaders.
#![allow(missing_docs, reason = "the fields are documented where the shaders declare them")]

use crate::scene::{self, LightKind, Scene};
use crate::settings::{Estimator, Sampler};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// `Sphere` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Sphere {
    pub center: [f32; 3],
    pub radius: f32,
}

/// `Box` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Box {
    pub lower: [f32; 3],
    pub pad0: u32,
    pub upper: [f32; 3],
    pub pad1: u32,
}

/// `Triangle` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Triangle {
    pub vertex: [f32; 3],
    pub pad0: u32,
    pub edge1: [f32; 3],
    pub pad1: u32,
    pub edge2: [f32; 3],
    pub pad2: u32,
}

/// `Plane` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Plane {
    pub normal: [f32; 3],
    pub offset: f32,
}

/// `Material` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Material {
    pub color: [f32; 3],
    pub ka: f32,
    pub odd_color: [f32; 3],
    pub kd: f32,
    pub reflectance: [f32; 3],
    pub ks: f32,
    pub emission: [f32; 3],
    pub exponent: f32,
    pub inverse_checker_size: f32,
    pub pad0: [u32; 3],
}

/// `Light` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Light {
    pub radiance: [f32; 3],
    pub is_directional: u32,
    pub position_or_direction: [f32; 3],
    pub pad0: u32,
}

/// `Environment` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Environment {
    pub horizon: [f32; 3],
    pub pad0: u32,
    pub zenith: [f32; 3],
    pub pad1: u32,
    pub ambient: [f32; 3],
    pub pad2: u32,
}

/// `Counters` of trace_batch.glsl, added to by every dispatch.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, Default)]
pub struct Counters {
    pub rays: u32,
    pub rejected_samples: u32,
}

/// `Camera` of camera.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Camera {
    pub eye: [f32; 3],
    pub lens_radius: f32,
    pub u: [f32; 3],
    pub inverse_focal_distance: f32,
    pub v: [f32; 3],
    pub inverse_view_distance: f32,
    pub w: [f32; 3],
    pub jitter: f32,
}

/// `Lattice` of film.glsl: the pixels `origin + stride * i` inside `extent`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct Lattice {
    pub extent: [u32; 2],
    pub origin: [u32; 2],
    pub stride: u32,
    pub pad0: u32,
}

/// `TracePush` of trace_batch.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct TracePush {
    pub camera: Camera,
    pub lattice: Lattice,
    pub seed: u32,
    pub max_bounces: u32,
    pub first_sample: u32,
    pub sample_count: u32,
}

/// `AccumulatePush` of accumulate.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct AccumulatePush {
    pub lattice: Lattice,
    pub seed: u32,
    pub first_sample: u32,
    pub jitter: f32,
    pub reach: i32,
}

/// `ResolvePush` of resolve.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct ResolvePush {
    pub extent: [u32; 2],
    pub preview_stride: u32,
    pub exposure: f32,
}

/// `SAMPLER` of sampling.glsl, the specialization constant 0.
pub fn sampler_constant(sampler: Sampler) -> u32 {
    match sampler {
        Sampler::Random => 0,
        Sampler::Sobol => 1,
    }
}

impl Counters {
    /// Reads them from the start of a buffer's bytes.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        bytemuck::pod_read_unaligned(&bytes[..size_of::<Self>()])
    }
}

/// A scene's buffers, in the shaders' order of shapes: spheres, boxes, triangles, planes.
#[derive(Debug)]
pub struct SceneData {
    pub spheres: Vec<Sphere>,
    pub boxes: Vec<Box>,
    pub triangles: Vec<Triangle>,
    pub planes: Vec<Plane>,
    pub material_of_shape: Vec<u32>,
    pub materials: Vec<Material>,
    /// Those that cast shadows come first.
    pub lights: Vec<Light>,
    pub shadow_lights: usize,
    pub environment: Environment,
}

impl Camera {
    /// The camera as the shaders want it. Derived in f64, rounded once.
    pub fn new(estimator: &Estimator) -> Self {
        let frame = estimator.camera.frame();
        let view_distance = estimator.camera.view_distance_pixels(estimator.size[1]);
        Self {
            eye: estimator.camera.eye.to_array(),
            lens_radius: 0.5 * estimator.lens.diameter,
            u: frame.u().as_vec3().to_array(),
            inverse_focal_distance: estimator.lens.focal_distance.recip(),
            v: frame.v().as_vec3().to_array(),
            inverse_view_distance: view_distance.recip() as f32,
            w: frame.w().as_vec3().to_array(),
            jitter: estimator.jitter,
        }
    }
}

impl SceneData {
    /// Every shape, material and light of a scene.
    pub fn new(scene: &Scene) -> Self {
        let shadowing = || scene.lights.iter().filter(|light| light.shadows);
        let material_of_shape = (scene.spheres.iter().map(|shaded| shaded.material))
            .chain(scene.boxes.iter().map(|shaded| shaded.material))
            .chain(scene.triangles.iter().map(|shaded| shaded.material))
            .chain(scene.planes.iter().map(|shaded| shaded.material));
        Self {
            spheres: scene.spheres.iter().map(|shaded| sphere(&shaded.shape)).collect(),
            boxes: scene.boxes.iter().map(|shaded| aabb(&shaded.shape)).collect(),
            triangles: scene.triangles.iter().map(|shaded| triangle(&shaded.shape)).collect(),
            planes: scene.planes.iter().map(|shaded| plane(&shaded.shape)).collect(),
            material_of_shape: material_of_shape.collect(),
            materials: scene.materials.iter().map(material).collect(),
            lights: shadowing()
                .chain(scene.lights.iter().filter(|light| !light.shadows))
                .map(light)
                .collect(),
            shadow_lights: shadowing().count(),
            environment: Environment {
                horizon: scene.background.horizon.to_array(),
                zenith: scene.background.zenith.to_array(),
                ambient: scene.ambient.to_array(),
                ..Zeroable::zeroed()
            },
        }
    }
}

fn sphere(sphere: &scene::Sphere) -> Sphere {
    Sphere { center: sphere.center.to_array(), radius: sphere.radius }
}

fn aabb(aabb: &scene::Aabb) -> Box {
    Box { lower: aabb.lower.to_array(), upper: aabb.upper.to_array(), ..Zeroable::zeroed() }
}

fn triangle(triangle: &scene::Triangle) -> Triangle {
    let [a, b, c] = triangle.vertices;
    Triangle {
        vertex: a.to_array(),
        edge1: (b - a).to_array(),
        edge2: (c - a).to_array(),
        ..Zeroable::zeroed()
    }
}

fn plane(plane: &scene::Plane) -> Plane {
    let normal = plane.normal.as_dvec3().normalize();
    Plane { normal: normal.as_vec3().to_array(), offset: normal.dot(plane.point.as_dvec3()) as f32 }
}

fn material(material: &scene::Material) -> Material {
    let checker = material.checker.as_ref();
    Material {
        color: material.color.to_array(),
        ka: material.ka,
        odd_color: checker.map_or(Vec3::ZERO, |checker| checker.odd_color).to_array(),
        kd: material.kd,
        reflectance: material.reflectance.to_array(),
        ks: material.ks,
        emission: material.emission.to_array(),
        exponent: material.exponent,
        inverse_checker_size: checker.map_or(0.0, |checker| checker.size.recip()),
        ..Zeroable::zeroed()
    }
}

fn light(light: &scene::Light) -> Light {
    let (position_or_direction, is_directional) = match light.kind {
        LightKind::Point(position) => (position, 0),
        LightKind::Directional(direction) => (direction.as_dvec3().normalize().as_vec3(), 1),
    };
    Light {
        radiance: light.radiance.to_array(),
        is_directional,
        position_or_direction: position_or_direction.to_array(),
        pad0: 0,
    }
}
