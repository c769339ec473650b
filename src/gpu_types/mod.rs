//! The shaders' structs in Rust, byte for byte, with explicit padding, which no other module needs. A test compares
//! their offsets with those in the compiled shaders.
#![allow(missing_docs, reason = "the fields are documented where the shaders declare them")]

mod aperture;
mod brightest;
mod denormal;
mod light;
mod material;
mod scene;
mod shape;

pub use aperture::{Aperture, ApertureBuffer, aperture_constant, aperture_sums};
pub use brightest::Brightest;
pub use light::{Environment, Lamp, Light};
pub use material::{Material, Texture};
pub use scene::{SceneBlock, SceneColors, SceneCounts, SceneData};
pub use shape::ShapeRecord;

use crate::interface::{GROUP_SIZE, constant, integrator, sampler};
use crate::scene::{CameraModel, Integrator};
use crate::settings::{Estimator, Sampler, Settings};
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, UVec2};
use half::f16;

/// The three texels of a node in bvh.glsl. The upper byte of `exponents_and_child_count` is the number of children. A
/// [`ShapeRecord`] has its material there, an index so small that its upper byte is zero, which distinguishes shapes from
/// nodes. `first` is at a place where a shape has an integer too.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct TreeNode {
    pub origin: [f32; 3],
    pub exponents_and_child_count: u32,
    pub planes_x: [u32; 2],
    pub planes_y: [u32; 2],
    pub planes_z: [u32; 2],
    pub pad0: u32,
    pub first: u32,
}

/// `Counters` of trace_batch.glsl, added to by every dispatch.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, Default)]
pub struct Counters {
    pub rays: u32,
    pub rejected_samples: u32,
    pub listed_samples: u32,
}

/// `Camera` of thin_lens.glsl.
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
    pub tilt: [f32; 2],
    pub inverse_focal_length: f32,
    pub dispersion: f32,
}

/// `Lattice` of film.glsl: the pixels `origin + stride * i` inside `extent`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct Lattice {
    pub extent: [u32; 2],
    pub origin: [u32; 2],
    pub stride: u32,
    pub first_row: u32,
    pub row_step: u32,
    pub row_count: u32,
}

/// `TracePush` of trace_batch.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct TracePush {
    pub camera: Camera,
    pub lattice: Lattice,
    pub seed: u32,
    pub limits: u32,
    pub first_sample: u32,
    pub sample_count: u32,
}

/// What ends paths, as limits.glsl reads it.
pub fn limits(estimator: &Estimator) -> u32 {
    let clamp = f16::from_f32(estimator.clamp);
    estimator.max_bounces | estimator.diffuse_bounces << 8 | u32::from(clamp.to_bits()) << 16
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

/// `SelectPush` of select.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SelectPush {
    pub lattice: Lattice,
    pub threshold: f32,
    pub cell: u32,
}

/// `ResolvePush` of resolve.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct ResolvePush {
    pub extent: [u32; 2],
    pub preview_stride: u32,
    pub exposure: f32,
    pub overlay: OverlayScale,
    pub blue_first: u32,
}

/// `OverlayScale` of overlay.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq, Default)]
pub struct OverlayScale {
    pub kind: u32,
    pub full_scale: f32,
    pub blur: f32,
    pub inverse_image_distance: f32,
    pub inverse_focal_distance: f32,
    pub pad0: u32,
    pub gradient: [f32; 2],
    pub axis: [f32; 2],
}

/// `GeometryPush` of geometry.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct GeometryPush {
    pub camera: Camera,
    pub w: [f32; 3],
    pub top: u32,
    pub extent: [u32; 2],
}

/// `PickPush` of pick.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct PickPush {
    pub camera: Camera,
    pub extent: [u32; 2],
    pub position: [f32; 2],
    pub fan: u32,
    pub samples: u32,
    pub seed: u32,
}

/// `PickedRay` of pick.comp.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct PickedRay {
    pub origin: [f32; 3],
    pub distance: f32,
    pub direction: [f32; 3],
    pub material: u32,
    pub focus: [f32; 3],
    pub pad0: u32,
}

impl OverlayScale {
    /// How to draw the overlay of these settings. Without an overlay, the kind is `NONE`.
    pub fn new(settings: &Settings) -> Self {
        let Some(shown) = settings.view.overlay else {
            return Self::default();
        };
        let estimator = &settings.estimator;
        let camera = Camera::new(estimator);
        let pixels = DVec2::new(1.0, -1.0) / f64::from(camera.inverse_view_distance);
        let middle = 0.5 * (UVec2::from(estimator.size).as_dvec2() - 1.0);
        let shift = estimator.focused_camera().shift();
        let plane = estimator.focal_plane();
        let inverse_image_distance = match estimator.model {
            CameraModel::ThinLens => plane.inverse_distance as f32,
            CameraModel::Pinhole | CameraModel::Hole => camera.inverse_focal_distance,
        };
        Self {
            kind: shown as u32,
            full_scale: settings.overlay_scale(shown),
            blur: 2.0 * camera.lens_radius / camera.inverse_view_distance.abs(),
            inverse_image_distance,
            inverse_focal_distance: estimator.lens.focal_distance.recip(),
            gradient: (plane.slope / pixels).as_vec2().to_array(),
            axis: (middle - shift * pixels).as_vec2().to_array(),
            pad0: 0,
        }
    }
}

impl GeometryPush {
    /// For all pixels of a picture.
    pub fn new(estimator: &Estimator) -> Self {
        let w = estimator.camera.frame().w().as_vec3().to_array();
        Self { camera: Camera::new(estimator), w, top: 0, extent: estimator.size }
    }
}

/// The specialization constants of the passes that read nothing but the film and its samples.
pub fn film_constants(estimator: &Estimator) -> [(u32, u32); 2] {
    [sampler_constant(estimator.sampler), (constant::HAS_MOMENTS, estimator.has_moments().into())]
}

/// The specialization constants of the passes that trace rays through the lens, without those of the scene.
pub fn lens_constants(estimator: &Estimator) -> [(u32, u32); 6] {
    let [sampler, has_moments] = film_constants(estimator);
    let has_profile = estimator.aperture.profile_in_use(estimator.model) != 0.0;
    let profile = (constant::HAS_PROFILE, has_profile.into());
    let dispersion = (constant::HAS_DISPERSION, (estimator.dispersion() != 0.0).into());
    [sampler, has_moments, aperture_constant(estimator), movements_constant(estimator), profile, dispersion]
}

/// `HAS_MOVEMENTS` of movements.glsl. A pinhole and a hole see the same from every tilt, and need no code for a shift.
pub fn movements_constant(estimator: &Estimator) -> (u32, u32) {
    let moved = estimator.focal_plane().slope != DVec2::ZERO || estimator.camera.shift() != DVec2::ZERO;
    (constant::HAS_MOVEMENTS, (moved && estimator.model == CameraModel::ThinLens).into())
}

/// The number of an integrator in [`crate::interface::integrator`].
pub fn integrator_number(of: Integrator) -> u32 {
    match of {
        Integrator::Whitted => integrator::WHITTED,
        Integrator::Path => integrator::PATH,
    }
}

/// `SAMPLER` of sampling.glsl.
pub fn sampler_constant(chosen: Sampler) -> (u32, u32) {
    let code = match chosen {
        Sampler::Random => sampler::RANDOM,
        Sampler::Sobol => sampler::SOBOL,
        Sampler::BlueNoise => sampler::BLUE_NOISE,
    };
    (constant::SAMPLER, code)
}

impl Lattice {
    /// The row of workgroups that is visited after `number` others. The shaders have the same function.
    pub fn visited_row(&self, number: u32) -> u32 {
        (u64::from(number) * u64::from(self.row_step) % u64::from(self.row_count)) as u32
    }

    /// The part of the lattice that starts at the column `at[0]`, and at the row `at[1]` in the order in which its rows
    /// of workgroups are visited.
    pub fn from_tile(self, at: [u32; 2]) -> Self {
        let origin = [self.origin[0] + at[0] * self.stride, self.origin[1]];
        Self { origin, first_row: at[1] / GROUP_SIZE, ..self }
    }
}

impl Counters {
    /// Reads the counters from the start of a buffer's bytes.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        bytemuck::pod_read_unaligned(&bytes[..size_of::<Self>()])
    }
}

impl Camera {
    /// The camera in the form that the shaders read. All values are computed in f64 and rounded once.
    pub fn new(estimator: &Estimator) -> Self {
        let camera = &estimator.focused_camera();
        let frame = camera.frame();
        let (plane, shift) = (estimator.focal_plane(), camera.shift());
        let view_distance = camera.view_distance_pixels(estimator.size[1]);
        // A film point s at the distance v behind a hole sees through the point l of the hole along l - s. On the view
        // plane, s / v is -q, or q if the picture is turned upright. So this is the equation of a lens with -v for
        // the focal distance.
        let (diameter, inverse_focal_distance) = match estimator.model {
            CameraModel::ThinLens => (estimator.lens.diameter, plane.inverse_depth(shift) as f32),
            CameraModel::Pinhole => (0.0, 0.0),
            CameraModel::Hole => (estimator.hole.diameter, -camera.film_distance().recip() as f32),
        };
        let view_distance = if estimator.is_upside_down() { -view_distance } else { view_distance };
        Self {
            eye: estimator.scene.on_device(camera.eye).to_array(),
            lens_radius: 0.5 * diameter,
            u: frame.u().as_vec3().to_array(),
            inverse_focal_distance,
            v: frame.v().as_vec3().to_array(),
            inverse_view_distance: view_distance.recip() as f32,
            w: (frame.w() - shift.x * frame.u() - shift.y * frame.v()).as_vec3().to_array(),
            jitter: estimator.jitter,
            tilt: plane.tilt.as_vec2().to_array(),
            inverse_focal_length: plane.inverse_focal_length as f32,
            dispersion: estimator.dispersion() as f32,
        }
    }
}
