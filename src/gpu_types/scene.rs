//! A scene as the shaders want it.

use super::denormal::flush_denormals;
use super::shape::on_device;
use super::{Environment, Lamp, Light, Material, ShapeRecord, TreeNode};
use crate::interface::{SMALL_SCENE, shape};
use crate::scene::{Bvh, Node, Panorama, Record, SceneRef, Shaded, Shape, Triangle};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

/// If there are more bounded shapes than this, they go into a tree. With fewer, testing each shape is faster.
const MAX_LISTED_SHAPES: usize = 64;

/// A scene's buffers.
#[derive(Debug)]
pub struct SceneData {
    /// The tree's nodes and shapes, each a [`TreeNode`] or a [`ShapeRecord`], then the shapes of the list, sorted by
    /// their kinds.
    pub records: Vec<[u32; 12]>,
    pub counts: SceneCounts,
    /// A bit for each kind of shape in the list or in the tree.
    pub shape_kinds: u32,
    /// Three corner normals per shape of the tree. Empty if no triangle has normals.
    pub normals: Vec<[[f32; 4]; 3]>,
    /// The velocity of every shape in scene units per second, the shapes of the tree first. Empty if nothing moves.
    pub velocities: Vec<[f32; 4]>,
    /// The number of nodes on the longest path from the tree's root to a leaf; 0 where there is no tree.
    pub tree_depth: u32,
    pub colors: SceneColors,
    /// Whether any shape moves.
    pub moves: bool,
    /// Whether the origin of these coordinates is not the scene's own.
    pub shifted: bool,
}

/// The materials and the lights of a scene, which can change while its shapes stay.
#[derive(Debug)]
pub struct SceneColors {
    pub materials: Vec<Material>,
    /// A bit for each kind of material.
    pub material_kinds: u32,
    /// A bit for each kind of texture that a material has.
    pub texture_kinds: u32,
    /// The lights. Those that cast shadows come first.
    pub lights: Vec<Light>,
    /// The number of lights that cast shadows.
    pub shadow_lights: u32,
    /// A bit for each kind of light.
    pub light_kinds: u32,
    /// The shapes that emit light.
    pub lamps: Vec<Lamp>,
    /// The sum over the lamps of luminance times area.
    pub lamp_power: f32,
    pub environment: Environment,
    /// The image of the sky, if it has one.
    pub panorama: Option<Panorama>,
    /// Whether any material mirrors.
    pub reflects: bool,
}

/// The number of kinds of shapes, with room up to whole vectors of four.
const LIST_ENDS: usize = shape::NAMES.len().next_multiple_of(4);

/// `SceneCounts` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SceneCounts {
    /// Where the range of each kind ends in the list.
    pub list_ends: [u32; LIST_ENDS],
    pub list_begin: u32,
    pub lights: u32,
    pub shadow_lights: u32,
    pub max_tree_steps: u32,
    pub lamps: u32,
    pub lamp_power: f32,
    pub pad0: [u32; 2],
}

/// The block `Scene` of scene.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SceneBlock {
    pub environment: Environment,
    pub counts: SceneCounts,
    /// Of a small scene all lights, otherwise zeros.
    pub small_lights: [Light; SMALL_SCENE as usize],
    /// Of a small scene all shapes of the list, otherwise zeros.
    pub small_list: [ShapeRecord; SMALL_SCENE as usize],
}

impl SceneBlock {
    /// The block of a scene with these colors, and with the records of this list.
    pub fn new(colors: &SceneColors, counts: SceneCounts, list: &[[u32; 12]]) -> Self {
        let mut block = Self {
            environment: colors.environment,
            counts,
            small_lights: [Light::zeroed(); SMALL_SCENE as usize],
            small_list: [ShapeRecord::zeroed(); SMALL_SCENE as usize],
        };
        if colors.make_small(list) {
            block.small_lights[..colors.lights.len()].copy_from_slice(&colors.lights);
            for (at, shape) in block.small_list.iter_mut().zip(list) {
                *at = bytemuck::cast(*shape);
            }
        }
        block
    }
}

impl SceneColors {
    /// Whether a scene with these colors and this list has few enough listed shapes, materials and lights to be read from
    /// a uniform buffer, and for its loops to be unrolled.
    pub fn make_small(&self, list: &[[u32; 12]]) -> bool {
        list.len().max(self.materials.len()).max(self.lights.len()) <= SMALL_SCENE as usize
    }
}

impl SceneData {
    /// Every shape, material and light of a scene. The bounded shapes go into a tree if there are many of them or if
    /// some have normals at their corners. The boxes of the tree hold all positions that a moving shape takes while
    /// the shutter is open, which is `shutter` seconds.
    pub fn new(scene: &SceneRef, shutter: f32) -> Self {
        let smooth = scene.of_kind::<Triangle>().any(|(triangle, _)| triangle.normals.is_some());
        let bounded = scene.shapes.iter().filter(|of| of.shape.is_bounded()).count();
        Self::with_tree(scene, shutter, smooth || bounded > MAX_LISTED_SHAPES)
    }

    /// The records of the shapes that are in the list.
    pub fn list(&self) -> &[[u32; 12]] {
        &self.records[self.counts.list_begin as usize..]
    }

    /// Does the same as [`SceneData::new`], but the caller decides whether the bounded shapes go into a tree.
    pub fn with_tree(scene: &SceneRef, shutter: f32, tree: bool) -> Self {
        let origin = scene.middle();
        let shapes = scene.shapes.iter().map(|of| on_device(of, origin));
        let (bounded, unbounded): (Vec<_>, Vec<_>) = shapes.partition(|of| of.shape.is_bounded());
        let reach = reach(&bounded, shutter);
        let (in_tree, mut in_list) = if tree { (bounded, Vec::new()) } else { (Vec::new(), bounded) };
        in_list.extend(unbounded);
        in_list.sort_by_key(|of| ShapeRecord::kind(&of.shape));
        let bvh = Bvh::new(in_tree, shutter);
        let (in_tree, nodes, tree_depth) = match &bvh {
            // A lone leaf is a tree too.
            Some(bvh) => (&bvh.shapes[..], &bvh.records[..], bvh.depth.max(1)),
            None => (&[][..], &[][..], 0),
        };
        let all = || in_tree.iter().chain(&in_list);
        let shapes: Vec<_> = (0..).zip(all()).map(|(index, of)| ShapeRecord::new(of, index)).collect();
        let (of_tree, of_list) = shapes.split_at(in_tree.len());
        let record = |record: &Record| match record {
            Record::Node(node) => bytemuck::cast(tree_node(node)),
            Record::Leaf(index) => bytemuck::cast(of_tree[*index as usize]),
        };
        let mut records: Vec<[u32; 12]> = nodes.iter().map(record).collect();
        records.extend(of_list.iter().map(|shape| bytemuck::cast::<_, [u32; 12]>(*shape)));
        let count = |len: usize| u32::try_from(len).unwrap_or(u32::MAX);
        let mut list_ends = [0; LIST_ENDS];
        for (end, kind) in list_ends.iter_mut().zip(0..) {
            *end = count(of_list.partition_point(|shape| shape.kind <= kind));
        }
        let moves = scene.moves();
        let colors = SceneColors::new(scene, reach);
        Self {
            records,
            counts: SceneCounts {
                list_ends,
                list_begin: count(nodes.len()),
                lights: count(colors.lights.len()),
                shadow_lights: colors.shadow_lights,
                max_tree_steps: count(nodes.len()),
                lamps: count(colors.lamps.len()),
                lamp_power: colors.lamp_power,
                pad0: [0; 2],
            },
            shape_kinds: bits(shapes.iter().map(|shape| shape.kind)),
            normals: corner_normals(in_tree),
            velocities: all().filter(|_| moves).map(|of| with_zero(flush_denormals(of.velocity))).collect(),
            tree_depth,
            moves,
            shifted: origin != DVec3::ZERO,
            colors,
        }
    }
}

impl SceneColors {
    /// The materials and the lights of a scene whose bounded shapes lie within `reach` of the origin of the device's
    /// coordinates.
    pub fn new(scene: &SceneRef, reach: f32) -> Self {
        let origin = scene.middle();
        let shadowing = || scene.lights.iter().filter(|light| light.shadows);
        let lights = shadowing().chain(scene.lights.iter().filter(|light| !light.shadows));
        let lights: Vec<_> = lights.map(|of| Light::new(of, origin)).collect();
        let (lamps, lamp_power) = Lamp::all(scene, origin);
        let materials: Vec<_> = scene.materials.iter().map(|of| Material::new(of, origin)).collect();
        Self {
            reflects: scene.materials.iter().any(|of| of.reflectance() != Vec3::ZERO),
            material_kinds: bits(materials.iter().map(|material| material.kind)),
            texture_kinds: bits(materials.iter().map(|material| material.color.kind)),
            materials,
            light_kinds: bits(lights.iter().map(|light| light.kind)),
            shadow_lights: u32::try_from(shadowing().count()).unwrap_or(u32::MAX),
            lights,
            lamps,
            lamp_power: lamp_power as f32,
            environment: Environment::new(scene, reach),
            panorama: scene.background.panorama().cloned(),
        }
    }
}

/// The corner normals of each shape, or nothing if no shape has any. Zeros stand for the triangle's own normal.
fn corner_normals(shapes: &[Shaded]) -> Vec<[[f32; 4]; 3]> {
    let normals = |of: &Shaded| match &of.shape {
        Shape::Triangle(triangle) => triangle.normals,
        _ => None,
    };
    if !shapes.iter().any(|of| normals(of).is_some()) {
        return Vec::new();
    }
    let corners = shapes.iter().map(|of| normals(of).unwrap_or_default());
    corners.map(|corners| corners.map(|normal| with_zero(flush_denormals(normal)))).collect()
}

/// The distance from the origin within which all shapes stay while the shutter is open, which is `shutter` seconds.
fn reach(shapes: &[Shaded], shutter: f32) -> f32 {
    let moved = |of: &Shaded| of.shape.reach() + f64::from(0.5 * shutter * of.velocity.length());
    // The factor makes up for what f32 loses of the shapes' positions.
    (1.000_01 * shapes.iter().map(moved).fold(0.0, f64::max)) as f32
}

/// A bit for each of these kinds.
fn bits(kinds: impl Iterator<Item = u32>) -> u32 {
    kinds.fold(0, |bits, kind| bits | 1 << kind)
}

fn with_zero([x, y, z]: [f32; 3]) -> [f32; 4] {
    [x, y, z, 0.0]
}

fn tree_node(node: &Node) -> TreeNode {
    // With the bias that the exponent of an f32 has.
    let [x, y, z] = node.exponents.map(|exponent| (exponent + 127) as u32);
    let [planes_x, planes_y, planes_z] = node.planes.map(|planes| planes.map(u32::from_le_bytes));
    TreeNode {
        origin: flush_denormals(node.origin),
        exponents_and_child_count: x | y << 8 | z << 16 | node.children << 24,
        planes_x,
        planes_y,
        planes_z,
        pad0: 0,
        first: node.first,
    }
}
