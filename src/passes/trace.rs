//! Traces a batch of samples for each pixel of a lattice into the tracing image.

use super::{Adaptive, BlueNoiseTile, Opening};
use crate::error::{Error, Result};
use crate::gpu_types::{SceneData, TracePush};
use crate::vulkan::{
    Binding, BindingSet, Buffer, ComputePipeline, Device, Image, Recording, SOFTWARE, Shader, TexelBuffer,
    shader,
};
use std::sync::Arc;

/// Pass 1. See `shaders/trace.comp`.
pub struct Trace {
    pipeline: ComputePipeline,
    tile: BlueNoiseTile,
}

/// With more shapes in lists, materials or lights than these the scene is not copied: what would be
/// unrolled grows too long.
const MOST_KEPT: usize = 64;

/// What a ray may take on a software device: nodes visited and shapes tried. In a tree of a million
/// triangles some dozens are usual. Were there no limit, nor could there be a safe batch.
const MOST_TREE_STEPS: usize = 1024;

/// The stack of bvh.glsl keeps the index of a record in 25 bits.
const MOST_TREE_RECORDS: usize = 1 << 25;

/// `SPELLED_OUT` of bvh.glsl: where the stack is deeper, a step goes through the rest of it in loops.
const SPELLED_OUT_STACK: u64 = 20;

/// The bits of a sample index, which the Sobol sequence goes through, and the searches in an aperture's image.
const SAMPLER_LOOP_STEPS: u64 = 24 + 16;

/// A scene on the device.
pub struct SceneBuffers {
    buffers: [Arc<Buffer>; 8],
    /// The tree, and the normals and velocities of its shapes.
    tree: [Arc<TexelBuffer>; 3],
    /// Of the shapes that are not in it.
    velocities: Arc<Buffer>,
    /// Whether any shape moves, and whether checkers have a phase.
    moves: bool,
    shifted: bool,
    /// The tree's depth, the kinds in it, and the most steps that a ray can take in it.
    tree_constants: [u32; 3],
    /// Spheres, boxes, triangles, planes, lights, lights that cast shadows, materials.
    counts: [u32; 7],
    /// Whether the shaders copy the scene before they start.
    kept: bool,
    /// Whether any material mirrors.
    reflects: bool,
}

impl SceneBuffers {
    /// Which of [`Self::constants`] says whether the shaders copy the scene before they start.
    pub const KEPT_CONSTANT: usize = 9;

    /// Uploads a scene.
    ///
    /// # Errors
    /// [`Error::Limit`] where it has more shapes than a tree can hold, [`Error::Memory`], or what Vulkan says.
    pub fn new(device: &Arc<Device>, scene: &SceneData) -> Result<Self> {
        let count = |len: usize| u32::try_from(len).unwrap_or(u32::MAX);
        let (records, normals, velocities, depth, kinds) = match &scene.tree {
            Some(tree) => (&*tree.records, &*tree.normals, &*tree.velocities, tree.depth, tree.kinds),
            None => (&[][..], &[][..], &[][..], 0, 0),
        };
        if records.len() > MOST_TREE_RECORDS {
            return Err(Error::Limit {
                what: "the tree of shapes",
                unit: "records",
                wanted: records.len() as u64,
                most: MOST_TREE_RECORDS as u64,
                limit: "of thinlens itself",
            });
        }
        let most_steps = if device.info().kind == SOFTWARE { MOST_TREE_STEPS } else { usize::MAX };
        let steps = count(records.len().min(most_steps));
        let few =
            scene.material_of_shape.len().max(scene.materials.len()).max(scene.lights.len()) <= MOST_KEPT;
        Ok(Self {
            buffers: [
                Arc::new(Buffer::upload(device, "spheres", &scene.spheres)?),
                Arc::new(Buffer::upload(device, "boxes", &scene.boxes)?),
                Arc::new(Buffer::upload(device, "triangles", &scene.triangles)?),
                Arc::new(Buffer::upload(device, "planes", &scene.planes)?),
                Arc::new(Buffer::upload(device, "material of shape", &scene.material_of_shape)?),
                Arc::new(Buffer::upload(device, "materials", &scene.materials)?),
                Arc::new(Buffer::upload(device, "lights", &scene.lights)?),
                Arc::new(Buffer::upload(device, "environment", &[scene.environment])?),
            ],
            tree: [
                Arc::new(TexelBuffer::upload(device, "tree", records)?),
                Arc::new(TexelBuffer::upload(device, "normals", normals)?),
                Arc::new(TexelBuffer::upload(device, "velocities in the tree", velocities)?),
            ],
            velocities: Arc::new(Buffer::upload(device, "velocities", &scene.velocities)?),
            moves: scene.moves,
            shifted: scene.shifted,
            tree_constants: [depth, kinds, steps],
            counts: [
                count(scene.spheres.len()),
                count(scene.boxes.len()),
                count(scene.triangles.len()),
                count(scene.planes.len()),
                count(scene.lights.len()),
                count(scene.shadow_lights),
                count(scene.materials.len().max(1)),
            ],
            kept: device.info().kind == SOFTWARE && few,
            reflects: scene.materials.iter().any(|material| material.reflectance != [0.0; 3]),
        })
    }

    /// The most rays that one sample can need: at each surface one onwards and one to each light.
    pub fn most_rays(&self, max_bounces: u32) -> u32 {
        self.most_surfaces(max_bounces).saturating_mul(1 + self.counts[4])
    }

    /// How often the loops of the trace pass can go round for one sample: over shapes for each ray,
    /// over lights and reflections, and in the sampler.
    pub fn most_loop_steps(&self, max_bounces: u32) -> u64 {
        let [spheres, boxes, triangles, planes, lights, ..] = self.counts.map(u64::from);
        let [depth, _, steps] = self.tree_constants.map(u64::from);
        let tree = steps * (1 + depth.saturating_sub(SPELLED_OUT_STACK));
        let shapes = spheres + boxes + triangles + planes + tree;
        SAMPLER_LOOP_STEPS + u64::from(self.most_surfaces(max_bounces)) * (1 + shapes + lights * (1 + shapes))
    }

    /// What the most steps of a sample come from.
    pub fn most_steps_in_words(&self, max_bounces: u32) -> String {
        let [spheres, boxes, triangles, planes, lights, ..] = self.counts;
        let shapes = match spheres + boxes + triangles {
            0 => format!("up to {} steps in the tree of shapes", self.tree_constants[2]),
            listed => format!("{listed} shapes"),
        };
        let reflections = self.most_surfaces(max_bounces) - 1;
        format!(
            "{reflections} reflections (--max-bounces), {lights} lights at each surface, and for every ray {planes} \
             planes and {shapes}"
        )
    }

    fn most_surfaces(&self, max_bounces: u32) -> u32 {
        if self.reflects { 1 + max_bounces } else { 1 }
    }

    /// Every binding of a shader that uses `shaders/include/scene.glsl`: the one or two resources that it
    /// works on, and the scene's buffers.
    pub fn bindings(&self, front: &[Binding]) -> Vec<(u32, Binding)> {
        let scene = self.buffers.iter().map(|buffer| Binding::Buffer(Arc::clone(buffer)));
        let tree = self.tree.iter().map(|buffer| Binding::Texels(Arc::clone(buffer)));
        let velocities = (19, Binding::Buffer(Arc::clone(&self.velocities)));
        (0..).zip(front.iter().cloned()).chain((2..).zip(scene.chain(tree))).chain([velocities]).collect()
    }

    /// The specialization constants: the two of the estimator, and those of
    /// `shaders/include/scene.glsl` and `bvh.glsl`.
    pub fn constants(&self, estimator: [u32; 2]) -> Vec<u32> {
        (estimator.into_iter())
            .chain(self.counts)
            .chain([self.kept.into()])
            .chain(self.tree_constants)
            .chain([self.moves.into(), self.shifted.into()])
            .collect()
    }

    /// Likewise, and that of `shaders/include/aperture.glsl`.
    pub fn constants_through(&self, estimator: [u32; 2], aperture: u32) -> Vec<u32> {
        let mut constants = self.constants(estimator);
        constants.push(aperture);
        constants
    }
}

impl Trace {
    /// The shader.
    pub const SHADER: Shader = shader!("trace");

    /// Compiles the pass from its shader, or one with the same interface, for the constants of an
    /// estimator and of its aperture, and a scene's numbers of things.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn new(
        device: &Arc<Device>,
        shader: Shader,
        estimator: [u32; 2],
        aperture: u32,
        scene: &SceneBuffers,
        tile: &BlueNoiseTile,
    ) -> Result<Self> {
        let pipeline = ComputePipeline::new(device, shader, &scene.constants_through(estimator, aperture))?;
        Ok(Self { pipeline, tile: tile.clone() })
    }

    /// From `scene`, seen through `opening`, into the tracing image `batch`, counting into `counters`. Once some pixels have stopped,
    /// `list` of `adaptive` holds those to trace.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn bind(
        &self,
        scene: &SceneBuffers,
        opening: &Opening,
        batch: &Arc<Image>,
        counters: &Arc<Buffer>,
        adaptive: &Adaptive,
        list: usize,
    ) -> Result<BindingSet> {
        let front = [Binding::Image(Arc::clone(batch)), Binding::Buffer(Arc::clone(counters))];
        let mut bindings = scene.bindings(&front);
        bindings.extend(opening.bindings());
        bindings.extend([adaptive.bind_list(13, list), adaptive.bind_batch_moments(), self.tile.binding()]);
        BindingSet::new(&self.pipeline, &bindings)
    }

    /// Width and height of a workgroup: tiles are cut at multiples of it.
    pub fn local_size(&self) -> [u32; 2] {
        self.pipeline.local_size()
    }

    /// Traces `extent` pixels of the push constants' lattice.
    pub fn record(
        &self,
        recording: &mut Recording<'_>,
        bindings: &BindingSet,
        push: &TracePush,
        extent: [u32; 2],
    ) {
        recording.dispatch(&self.pipeline, bindings, bytemuck::bytes_of(push), extent);
    }
}
