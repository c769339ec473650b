//! Runs the shaders' functions one by one, on inputs of a test's choice.

use super::{Gpu, pixels};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};
use std::sync::Arc;
use thinlens::gpu_types::{SceneData, sampler_constant};
use thinlens::interface::{binding, constant, scene_in};
use thinlens::passes::{BlueNoiseTile, FacetAlbedo, SceneBuffers};
use thinlens::reference::Ray;
use thinlens::scene::SceneRef;
use thinlens::settings::Sampler;
use thinlens::vulkan::{Binding, BindingSet, Buffer, Commands, ComputePipeline, Residence};

/// Sample values are multiples of this.
pub const STEP: f64 = 1.0 / 16_777_216.0;

/// What the shader `tests/probes/NAME.comp` makes of each input.
pub fn probe<In: Pod, Out: Pod>(
    gpu: &Gpu,
    name: &'static str,
    scene: Option<&SceneRef>,
    push: &[u8],
    inputs: &[In],
) -> Vec<Out> {
    probe_as(gpu, name, Sampler::default(), scene, push, inputs)
}

/// Runs a probe that is compiled for a sampler.
pub fn probe_as<In: Pod, Out: Pod>(
    gpu: &Gpu,
    name: &'static str,
    sampler: Sampler,
    scene: Option<&SceneRef>,
    push: &[u8],
    inputs: &[In],
) -> Vec<Out> {
    let sampler = sampler_constant(sampler);
    let shader = gpu.shader(name);
    for (twin, size) in [("In", size_of::<In>()), ("Out", size_of::<Out>())] {
        let layout = shader.interface().structs.into_iter().find(|layout| layout.name == twin);
        assert_eq!(layout.and_then(|layout| layout.stride), Some(size), "{name}: {twin}");
    }
    let device = gpu.device();
    let input = Arc::new(Buffer::upload(device, "probe inputs", inputs).expect("a buffer"));
    let bytes = size_of::<Out>() * inputs.len();
    let output = Buffer::new(device, "probe outputs", bytes as u64, Residence::Host).expect("a buffer");
    let output = Arc::new(output);
    let scene =
        scene.map(|scene| SceneBuffers::new(device, &SceneData::new(scene, scene.shutter)).expect("a scene"));
    let (mut bindings, mut constants) = match &scene {
        Some(scene) => (scene.bindings(), scene.constants().to_vec()),
        None => (Vec::new(), Vec::new()),
    };
    constants.extend([
        sampler,
        (constant::HAS_MOVEMENTS, 0),
        (constant::HAS_PROFILE, 0),
        (constant::HAS_DISPERSION, 0),
    ]);
    bindings.push((binding::PROBE_INPUTS, Binding::Buffer(input)));
    bindings.push((binding::PROBE_OUTPUTS, Binding::Buffer(Arc::clone(&output))));
    // Few of the functions need sample values, or rough materials.
    let tables = [
        BlueNoiseTile::new(device).expect("a tile").binding(),
        FacetAlbedo::new(device).expect("a table").binding(),
    ];
    bindings.extend(tables.into_iter().filter(|of| shader.interface().resources.contains_key(&of.0)));
    let answers = |constants: &[(u32, u32)]| {
        let pipeline = ComputePipeline::new(device, shader, constants).expect("a pipeline");
        let bindings = BindingSet::new(&pipeline, &bindings).expect("bindings");
        let count = u32::try_from(inputs.len()).expect("not too many");
        run(gpu, &pipeline, &bindings, push, [count, 1]);
        output.bytes()[..bytes].to_vec()
    };
    let found = answers(&constants);
    // From where the scene is read may change nothing. The compilers of GPUs may fuse other operations in each case, and
    // to find a fault, one place is enough.
    let place = constants.iter().position(|(id, _)| *id == constant::SCENE_PLACE);
    if let Some(at) = place.filter(|_| gpu.fault.is_empty() && device.info().kind == "software") {
        for place in 0..constants[at].1 {
            constants[at].1 = place;
            let from = format!("from {}", scene_in::NAMES[place as usize]);
            let other = answers(&constants);
            let changed =
                found.chunks(size_of::<Out>()).zip(other.chunks(size_of::<Out>())).position(|(a, b)| a != b);
            let words = |bytes: &[u8], at: usize| -> Vec<u32> {
                bytemuck::allocation::pod_collect_to_vec(&bytes[at * size_of::<Out>()..][..size_of::<Out>()])
            };
            let differ = changed.map(|at| (at, words(&found, at), words(&other, at)));
            assert!(differ.is_none(), "{name}: reading the scene {from} changes what comes out: {differ:x?}");
        }
    }
    bytemuck::allocation::pod_collect_to_vec(&found)
}

/// A sample's place in the sequences of pixels and seeds.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Index {
    pub pixel: [u32; 2],
    pub sample_index: u32,
    pub seed: u32,
}

/// The device's values of these samples, in multiples of [`STEP`].
pub fn sample_bits(gpu: &Gpu, sampler: Sampler, indices: &[Index]) -> Vec<[u32; 4]> {
    probe_as(gpu, "sampler", sampler, None, &[], indices)
}

/// A sample of each pixel.
pub fn indices(size: [u32; 2], sample_index: u32, seed: u32) -> Vec<Index> {
    pixels(size).map(|pixel| Index { pixel, sample_index, seed }).collect()
}

/// One dispatch, until it is done.
pub fn run(gpu: &Gpu, pipeline: &ComputePipeline, bindings: &BindingSet, push: &[u8], extent: [u32; 2]) {
    let mut commands = Commands::new(gpu.device()).expect("commands");
    let mut recording = commands.begin().expect("a recording");
    recording.dispatch(pipeline, bindings, push, extent);
    recording.barrier();
    recording.submit().expect("a submission");
    commands.wait().expect("the device");
}

/// Two sample values for the film, two for the lens, and the jitter in pixels.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Values {
    pub film: [f32; 2],
    pub lens: [f32; 2],
    pub jitter: f32,
    pub pad0: u32,
}

/// Offset from the pixel's centre in pixels, the pixel landed in, and the point of the unit disk.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Warped {
    pub offset: [f32; 2],
    pub landing: [i32; 2],
    pub disk: [f32; 2],
}

/// Where the device puts samples of these values.
pub fn warp(gpu: &Gpu, values: &[Values]) -> Vec<Warped> {
    probe(gpu, "warps", None, &[], values)
}

/// The device's disk map.
pub fn disk(gpu: &Gpu, squares: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let values: Vec<_> = (squares.iter())
        .map(|square| Values { lens: square.map(|value| value as f32), ..Zeroable::zeroed() })
        .collect();
    warp(gpu, &values).iter().map(|warped| warped.disk.map(f64::from)).collect()
}

/// A ray for `tests/probes/intersect.comp`, and how far off it is asked whether anything is met.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct RayQuestion {
    pub origin: [f32; 3],
    pub pad0: u32,
    pub direction: [f32; 3],
    pub limit: f32,
}

/// What it meets.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct RayAnswer {
    pub normal: [f32; 3],
    pub distance: f32,
    pub material: u32,
    pub occluded: u32,
    pub uv: [f32; 2],
}

/// Beyond every hit.
pub const FAR: f32 = 1e29;

impl RayQuestion {
    /// Without a limit.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self {
            origin: origin.as_vec3().to_array(),
            pad0: 0,
            direction: direction.normalize().as_vec3().to_array(),
            limit: FAR,
        }
    }

    /// The ray as the device sees it, rounded.
    pub fn ray(&self) -> Ray {
        Ray {
            origin: Vec3::from_array(self.origin).as_dvec3(),
            direction: Vec3::from_array(self.direction).as_dvec3().normalize(),
            time: 0.0,
        }
    }
}
