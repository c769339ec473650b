//! A scene's buffers on the device, and upper bounds for the work that its rays take.

use crate::error::{Error, Result};
use crate::gpu_types::{SceneBlock, SceneColors, SceneCounts, SceneData};
use crate::interface::{SPELLED_OUT_STACK, STACK_INDEX_BITS, binding, constant, scene_in, shape};
use crate::vulkan::{Binding, Buffer, Device, TexelBuffer, UniformBuffer};
use bytemuck::Pod;
use half::f16;
use std::sync::Arc;

/// As many records as the bits for a record's index can tell apart in the stack of bvh.glsl.
const MAX_RECORDS: usize = 1 << STACK_INDEX_BITS;

/// Where the scene is not copied, stacks have multiples of so many entries, so that few pipelines serve all trees.
const STACK_STEP: u32 = 4;

/// The bits of a sample index, which the Sobol sequence goes through, and the searches in an aperture's image.
const SAMPLER_LOOP_STEPS: u64 = 24 + 16;

/// The most steps of the search for a lamp, or for a texel of the sky.
const LIGHT_SEARCH_STEPS: u64 = 32;

/// What the passes read of a scene, and the constants that they are compiled for.
pub struct SceneBuffers {
    shapes: Arc<ShapeBuffers>,
    bindings: Vec<(u32, Binding)>,
    /// What only integrators read that sample lights: lamps and the image of the sky.
    of_sampled_light: Vec<(u32, Binding)>,
    has_panorama: bool,
    constants: Vec<(u32, u32)>,
    counts: SceneCounts,
    /// How many entries the stack of the tree has; 0 where there is no tree.
    tree_depth: u32,
    /// Whether any material mirrors.
    reflects: bool,
}

/// The part of the buffers that depends on the shapes alone.
struct ShapeBuffers {
    records: Binding,
    normals: Binding,
    velocities: Binding,
    counts: SceneCounts,
    /// The records of the shapes in the list.
    list: Vec<[u32; 12]>,
    /// A bit for each kind of shape.
    kinds: u32,
    has_normals: bool,
    moves: bool,
    shifted: bool,
    tree_depth: u32,
    /// Whether the device copies a small scene to variables.
    can_be_kept: bool,
    /// The distance from the origin within which all bounded shapes stay.
    reach: f32,
}

impl SceneBuffers {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`Error::Limit`] where the scene has more shapes than a tree can hold.
    pub fn new(device: &Arc<Device>, scene: &SceneData) -> Result<Self> {
        if scene.records.len() > MAX_RECORDS {
            return Err(Error::Limit {
                what: "the list of shapes and the nodes of their tree",
                unit: "records",
                wanted: scene.records.len() as u64,
                max: MAX_RECORDS as u64,
                limit: "of thinlens itself".into(),
                advice: "use fewer shapes",
            });
        }
        let max_tree_steps =
            scene.counts.max_tree_steps.min(device.traits().max_tree_steps.unwrap_or(u32::MAX));
        let shapes = ShapeBuffers {
            records: texels(device, "shapes", &scene.records)?,
            normals: texels(device, "corner normals", &scene.normals)?,
            velocities: texels(device, "velocities", &scene.velocities)?,
            counts: SceneCounts { max_tree_steps, ..scene.counts },
            list: scene.list().to_vec(),
            kinds: scene.shape_kinds,
            has_normals: !scene.normals.is_empty(),
            moves: scene.moves,
            shifted: scene.shifted,
            tree_depth: scene.tree_depth,
            can_be_kept: device.traits().keeps_scene,
            reach: scene.colors.environment.bounding_radius,
        };
        Self::assemble(device, Arc::new(shapes), &scene.colors)
    }

    /// The buffers of a scene with the same shapes, which are shared, but other materials and lights.
    ///
    /// # Errors
    /// Those of [`crate::vulkan`].
    pub fn recolored(&self, device: &Arc<Device>, colors: &SceneColors) -> Result<Self> {
        Self::assemble(device, Arc::clone(&self.shapes), colors)
    }

    /// The distance from the origin within which all bounded shapes stay.
    pub fn reach(&self) -> f32 {
        self.shapes.reach
    }

    /// Whether a scene with the same shapes and these colors needs no other pipelines.
    pub fn shares_pipelines_with(&self, colors: &SceneColors) -> bool {
        self.shapes.constants(colors) == self.constants
    }

    fn assemble(device: &Arc<Device>, shapes: Arc<ShapeBuffers>, colors: &SceneColors) -> Result<Self> {
        let counts = shapes.counts(colors);
        let block = UniformBuffer::upload(device, "scene", &SceneBlock::new(colors, counts, &shapes.list))?;
        let bindings = vec![
            (binding::MATERIALS, buffer(device, "materials", &colors.materials)?),
            (binding::LIGHTS, buffer(device, "lights", &colors.lights)?),
            (binding::SCENE, Binding::Uniform(Arc::new(block))),
            (binding::RECORDS, shapes.records.clone()),
            (binding::CORNER_NORMALS, shapes.normals.clone()),
            (binding::VELOCITIES, shapes.velocities.clone()),
        ];
        let constants = shapes.constants(colors);
        let tree_depth = shapes.stack_size(shapes.place(colors));
        let panorama = colors.panorama.as_ref();
        let image: &[[f16; 4]] = panorama.map_or(&[], |sky| &sky.image.texels);
        let chances =
            panorama.map_or_else(Vec::new, |sky| [&sky.chances.rows[..], &sky.chances.columns].concat());
        let of_sampled_light = vec![
            (binding::LAMPS, buffer(device, "lamps", &colors.lamps)?),
            (binding::IMAGE_TEXELS, texels(device, "images", image)?),
            (binding::SKY_CHANCES, buffer(device, "the image of the sky", &chances)?),
        ];
        Ok(Self {
            shapes,
            bindings,
            of_sampled_light,
            has_panorama: panorama.is_some(),
            constants,
            counts,
            tree_depth,
            reflects: colors.reflects,
        })
    }

    /// Whether some of the scene's shapes are in a tree.
    pub fn has_tree(&self) -> bool {
        self.tree_depth > 0
    }

    /// Whether any material mirrors.
    pub fn reflects(&self) -> bool {
        self.reflects
    }

    /// The most rays that one sample can need, if rays bounce so often: for each surface, one that reaches it and one
    /// from there to each light.
    pub fn max_rays(&self, samples_lights: bool, bounces: u32) -> u32 {
        (1 + bounces).saturating_mul(1 + self.most_lights(samples_lights))
    }

    /// The most iterations that the loops of the trace pass can make for one sample, if rays bounce so often: over
    /// shapes for each ray, over lights and bounces, and in the sampler.
    pub fn max_loop_steps(&self, samples_lights: bool, bounces: u32) -> u64 {
        let too_deep = u64::from(self.tree_depth.saturating_sub(SPELLED_OUT_STACK));
        let tree = u64::from(self.counts.max_tree_steps) * (1 + too_deep);
        let shapes = u64::from(self.listed_shapes()) + tree;
        let lights = u64::from(self.most_lights(samples_lights));
        let search = if samples_lights { LIGHT_SEARCH_STEPS } else { 1 };
        SAMPLER_LOOP_STEPS + (1 + u64::from(bounces)) * (1 + shapes + lights * (search + shapes))
    }

    /// Explains [`SceneBuffers::max_loop_steps`] in words, for an error message.
    pub fn explain_max_loop_steps(&self, bounces: u32) -> String {
        // The range of the unbounded kinds is the last.
        let bounded = self.counts.list_ends[shape::FIRST_UNBOUNDED as usize - 1];
        let planes = self.listed_shapes() - bounded;
        let shapes = match bounded {
            0 => format!("up to {} steps in the tree of shapes", self.counts.max_tree_steps),
            listed => format!("{listed} shapes"),
        };
        let lights = self.counts.lights;
        format!(
            "{bounces} bounces (--max-bounces), {lights} lights at each surface, and for every ray {planes} \
             planes and {shapes}"
        )
    }

    /// The most lights that are looked at from a surface: each light, or for an integrator that samples lights, one lamp or
    /// the sky.
    fn most_lights(&self, samples_lights: bool) -> u32 {
        if samples_lights { (self.counts.lamps > 0 || self.has_panorama).into() } else { self.counts.lights }
    }

    /// The number of shapes in the list.
    fn listed_shapes(&self) -> u32 {
        self.counts.list_ends[shape::NAMES.len() - 1]
    }

    /// Every binding of `shaders/light/sky.glsl` and `lamps.glsl`.
    pub fn of_sampled_light(&self) -> Vec<(u32, Binding)> {
        self.of_sampled_light.clone()
    }

    /// Every binding of `shaders/scene/scene.glsl` and `bvh.glsl`.
    pub fn bindings(&self) -> Vec<(u32, Binding)> {
        self.bindings.clone()
    }

    /// Every specialization constant of `shaders/scene/scene.glsl` and `bvh.glsl`.
    pub fn constants(&self) -> &[(u32, u32)] {
        &self.constants
    }
}

impl ShapeBuffers {
    /// Where the lights and the listed shapes are read from: one of [`scene_in`].
    fn place(&self, colors: &SceneColors) -> u32 {
        match colors.make_small(&self.list) {
            true if self.can_be_kept => scene_in::VARIABLES,
            true => scene_in::UNIFORMS,
            false => scene_in::BUFFERS,
        }
    }

    fn counts(&self, colors: &SceneColors) -> SceneCounts {
        let (lights, shadow_lights) = (count(colors.lights.len()), colors.shadow_lights);
        let (lamps, lamp_power) = (count(colors.lamps.len()), colors.lamp_power);
        SceneCounts { lights, shadow_lights, lamps, lamp_power, ..self.counts }
    }

    /// How many entries the stack of the tree has; 0 where there is no tree.
    fn stack_size(&self, place: u32) -> u32 {
        if place == scene_in::VARIABLES {
            self.tree_depth
        } else {
            self.tree_depth.next_multiple_of(STACK_STEP)
        }
    }

    /// The specialization constants of a scene with these shapes and colors.
    fn constants(&self, colors: &SceneColors) -> Vec<(u32, u32)> {
        let (place, counts) = (self.place(colors), self.counts(colors));
        let kept = place == scene_in::VARIABLES;
        let small = place != scene_in::BUFFERS;
        // Numbers that shaders read from the buffer stay out of the constants, so that the same pipelines serve many
        // scenes.
        let known_if = |known: bool, number: u32| if known { number } else { 0 };
        let mut constants = vec![
            (constant::LIGHT_COUNT, known_if(small, counts.lights)),
            (constant::SHADOW_LIGHT_COUNT, known_if(small, counts.shadow_lights)),
            (constant::MATERIAL_COUNT, known_if(kept, count(colors.materials.len())).max(1)),
            (constant::SCENE_PLACE, place),
            (constant::SCENE_MOVES, self.moves.into()),
            (constant::SCENE_IS_SHIFTED, self.shifted.into()),
            (constant::TREE_DEPTH, self.stack_size(place)),
            (constant::LIST_BEGIN, known_if(kept, counts.list_begin)),
            (constant::SHAPE_KINDS, self.kinds),
            (constant::MATERIAL_KINDS, colors.material_kinds),
            (constant::TEXTURE_KINDS, colors.texture_kinds),
            (constant::LIGHT_KINDS, colors.light_kinds),
            (constant::HAS_LAMPS, (!colors.lamps.is_empty()).into()),
            (constant::HAS_PANORAMA, colors.panorama.is_some().into()),
            (constant::HAS_CORNER_NORMALS, self.has_normals.into()),
            (constant::MAX_TREE_STEPS, known_if(kept, counts.max_tree_steps)),
        ];
        let ends = &counts.list_ends[..shape::NAMES.len()];
        constants.extend((constant::SHAPE_END..).zip(ends.iter().map(|end| known_if(small, *end))));
        constants
    }
}

fn count(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}

fn buffer<T: Pod>(device: &Arc<Device>, name: &'static str, elements: &[T]) -> Result<Binding> {
    Ok(Binding::Buffer(Arc::new(Buffer::upload(device, name, elements)?)))
}

fn texels<T: Pod>(device: &Arc<Device>, name: &'static str, elements: &[T]) -> Result<Binding> {
    Ok(Binding::Texels(Arc::new(TexelBuffer::upload(device, name, elements)?)))
}
