//! A scene as the shaders want it.

use super::float::{float, floats};
use super::shape::on_device;
use super::{Environment, Light, Material, ShapeRecord, TreeNode};
use crate::interface::shape;
use crate::scene::{self, Bvh, LightKind, Node, Record, SceneRef, Shaded, Shape, Triangle};
use bytemuck::Zeroable;
use glam::{DVec3, Vec3};

/// More bounded shapes than these go into a tree: with fewer, trying each is faster.
const MOST_LISTED_SHAPES: usize = 64;

/// A scene's buffers.
#[derive(Debug)]
pub struct SceneData {
    /// The tree's nodes and shapes, each a [`TreeNode`] or a [`ShapeRecord`], then the shapes of the list, sorted by
    /// their kinds.
    pub records: Vec<[u32; 12]>,
    /// The record of the list's first shape.
    pub list_begin: u32,
    /// The ends of the kinds in the list, from its first shape on.
    pub list_ends: [u32; shape::NAMES.len()],
    /// A bit for each kind of shape in the list or in the tree.
    pub kinds: u32,
    /// Three corner normals per shape of the tree. Empty if no triangle has normals.
    pub normals: Vec<[[f32; 4]; 3]>,
    /// Velocity of every shape in scene units a second, of those of the tree first. Empty if nothing moves.
    pub velocities: Vec<[f32; 4]>,
    /// Nodes on the longest way from the tree's root to a leaf; 0 where there is no tree.
    pub tree_depth: u32,
    pub materials: Vec<Material>,
    /// Those that cast shadows come first.
    pub lights: Vec<Light>,
    pub shadow_lights: usize,
    pub environment: Environment,
    /// Whether any shape moves.
    pub moves: bool,
    /// Whether the origin of these coordinates is not the scene's own.
    pub shifted: bool,
}

impl SceneData {
    /// Every shape, material and light of a scene. Many bounded shapes, and those with normals at their
    /// corners, go into a tree, with all that they pass while the shutter is open for so many seconds.
    pub fn new(scene: &SceneRef, shutter: f32) -> Self {
        let smooth = scene.of_kind::<Triangle>().any(|(triangle, _)| triangle.normals.is_some());
        let bounded = scene.shapes.iter().filter(|of| of.shape.is_bounded()).count();
        Self::with_tree(scene, shutter, smooth || bounded > MOST_LISTED_SHAPES)
    }

    /// Likewise, with the bounded shapes in a tree or in the list.
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
        let mut list_ends = [0; shape::NAMES.len()];
        for (end, kind) in list_ends.iter_mut().zip(0..) {
            *end = count(of_list.partition_point(|shape| shape.kind <= kind));
        }
        let shadowing = || scene.lights.iter().filter(|light| light.shadows);
        let moves = scene.moves();
        Self {
            records,
            list_begin: count(nodes.len()),
            list_ends,
            kinds: shapes.iter().fold(0, |kinds, shape| kinds | 1 << shape.kind),
            normals: corner_normals(in_tree),
            velocities: all().filter(|_| moves).map(|of| with_zero(floats(of.velocity))).collect(),
            tree_depth,
            moves,
            shifted: origin != DVec3::ZERO,
            materials: scene.materials.iter().map(|of| material(of, origin)).collect(),
            lights: shadowing()
                .chain(scene.lights.iter().filter(|light| !light.shadows))
                .map(|of| light(of, origin))
                .collect(),
            shadow_lights: shadowing().count(),
            environment: Environment {
                horizon: floats(scene.background.horizon),
                zenith: floats(scene.background.zenith),
                ambient: floats(scene.ambient),
                reach,
                ..Zeroable::zeroed()
            },
        }
    }
}

/// Those of each shape, if any has some. Zero at each corner stands for the triangle's own.
fn corner_normals(shapes: &[Shaded]) -> Vec<[[f32; 4]; 3]> {
    let normals = |of: &Shaded| match &of.shape {
        Shape::Triangle(triangle) => triangle.normals,
        _ => None,
    };
    if !shapes.iter().any(|of| normals(of).is_some()) {
        return Vec::new();
    }
    let corners = shapes.iter().map(|of| normals(of).unwrap_or_default());
    corners.map(|corners| corners.map(|normal| with_zero(floats(normal)))).collect()
}

/// The distance from the origin within which all of these stay while the shutter is open for so many seconds.
fn reach(shapes: &[Shaded], shutter: f32) -> f32 {
    let moved = |of: &Shaded| of.shape.reach() + f64::from(0.5 * shutter * of.velocity.length());
    // With what f32 loses of the places of the shapes.
    (1.000_01 * shapes.iter().map(moved).fold(0.0, f64::max)) as f32
}

fn with_zero([x, y, z]: [f32; 3]) -> [f32; 4] {
    [x, y, z, 0.0]
}

fn tree_node(node: &Node) -> TreeNode {
    // As the exponent's bits of an f32.
    let [x, y, z] = node.exponents.map(|exponent| (exponent + 127) as u32);
    let [planes_x, planes_y, planes_z] = node.planes.map(|planes| planes.map(u32::from_le_bytes));
    TreeNode {
        origin: floats(node.origin),
        about: x | y << 8 | z << 16 | node.children << 24,
        planes_x,
        planes_y,
        planes_z,
        pad0: 0,
        first: node.first,
    }
}

fn material(material: &scene::Material, origin: DVec3) -> Material {
    let checker = material.checker.as_ref();
    // The checker is the same again two cells farther along each axis.
    let phase = |checker: &scene::Checker| {
        let period = 2.0 * checker.size;
        floats(origin.map(|coordinate| coordinate.rem_euclid(period)).as_vec3())
    };
    Material {
        color: floats(material.color),
        ka: float(material.ka),
        odd_color: floats(checker.map_or(Vec3::ZERO, |checker| checker.odd_color)),
        kd: float(material.kd),
        reflectance: floats(material.reflectance),
        ks: float(material.ks),
        emission: floats(material.emission),
        exponent: float(material.exponent),
        checker_phase: checker.map_or([0.0; 3], phase),
        inverse_checker_size: checker.map_or(0.0, |checker| checker.size.recip() as f32),
    }
}

fn light(light: &scene::Light, origin: DVec3) -> Light {
    let (position_or_direction, is_directional) = match light.kind {
        LightKind::Point(position) => ((position - origin).as_vec3(), 0),
        LightKind::Directional(direction) => (direction.as_dvec3().normalize().as_vec3(), 1),
    };
    Light {
        radiance: floats(light.radiance),
        is_directional,
        position_or_direction: floats(position_or_direction),
        pad0: 0,
    }
}
