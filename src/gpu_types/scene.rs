//! A scene as the shaders want it.

use super::{Box, Environment, Light, Material, Plane, Sphere, TreeNode, TreeShape, Triangle};
use crate::scene::{self, Bounded, Bvh, LightKind, Node, Record, Scene, Shaded};
use bytemuck::Zeroable;
use glam::Vec3;

/// More bounded shapes than these go into a tree: with fewer, trying each is faster.
const MOST_LISTED_SHAPES: usize = 64;

/// `KIND_SMOOTH` of bvh.glsl.
const SMOOTH: u32 = 3;

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
    /// Of the shapes in the lists but planes, in their order, if any moves: scene units a second.
    pub velocities: Vec<[f32; 4]>,
    /// Whether any shape moves.
    pub moves: bool,
    /// The bounded shapes, where they are in a tree instead of the lists above.
    pub tree: Option<Tree>,
}

/// A tree of bounded shapes: see bvh.glsl.
#[derive(Debug)]
pub struct Tree {
    /// Each a [`TreeNode`] or a [`TreeShape`].
    pub records: Vec<[u32; 12]>,
    /// Of the three corners of each shape, if any has some.
    pub normals: Vec<[[f32; 4]; 3]>,
    /// Of each shape, if any moves.
    pub velocities: Vec<[f32; 4]>,
    pub depth: u32,
    /// A bit for each kind of shape in it.
    pub kinds: u32,
}

impl SceneData {
    /// Every shape, material and light of a scene. Many bounded shapes, and those with normals at their
    /// corners, go into a tree, with all that they pass while the shutter is open for so many seconds.
    pub fn new(scene: &Scene, shutter: f32) -> Self {
        let smooth = scene.triangles.iter().any(|of| of.shape.normals.is_some());
        let bounded = scene.spheres.len() + scene.boxes.len() + scene.triangles.len();
        Self::with_tree(scene, shutter, smooth || bounded > MOST_LISTED_SHAPES)
    }

    /// Likewise, with the bounded shapes in a tree or in lists.
    pub fn with_tree(scene: &Scene, shutter: f32, tree: bool) -> Self {
        let tree = tree.then(|| Bvh::new(scene, shutter)).flatten().map(|bvh| Tree::new(&bvh));
        let listed = |shapes: usize| if tree.is_some() { 0 } else { shapes };
        let (spheres, boxes, triangles) = (
            &scene.spheres[..listed(scene.spheres.len())],
            &scene.boxes[..listed(scene.boxes.len())],
            &scene.triangles[..listed(scene.triangles.len())],
        );
        let shadowing = || scene.lights.iter().filter(|light| light.shadows);
        let material_of_shape = (spheres.iter().map(|shaded| shaded.material))
            .chain(boxes.iter().map(|shaded| shaded.material))
            .chain(triangles.iter().map(|shaded| shaded.material))
            .chain(scene.planes.iter().map(|shaded| shaded.material));
        let moves = scene.moves();
        let velocities = (spheres.iter().map(|shaded| shaded.velocity))
            .chain(boxes.iter().map(|shaded| shaded.velocity))
            .chain(triangles.iter().map(|shaded| shaded.velocity));
        Self {
            velocities: velocities
                .filter(|_| moves)
                .map(|velocity| velocity.extend(0.0).to_array())
                .collect(),
            moves,
            spheres: spheres.iter().map(|shaded| sphere(&shaded.shape)).collect(),
            boxes: boxes.iter().map(|shaded| aabb(&shaded.shape)).collect(),
            triangles: triangles.iter().map(|shaded| triangle(&shaded.shape)).collect(),
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
            tree,
        }
    }
}

impl Tree {
    fn new(bvh: &Bvh) -> Self {
        let mut tree = Self {
            records: bvh.records.iter().map(|record| tree_record(bvh, record)).collect(),
            normals: Vec::new(),
            depth: bvh.depth,
            velocities: Vec::new(),
            kinds: bvh.shapes.iter().fold(0, |kinds, of| kinds | 1 << kind(&of.shape)),
        };
        if bvh.shapes.iter().any(|of| of.velocity != Vec3::ZERO) {
            tree.velocities = bvh.shapes.iter().map(|of| of.velocity.extend(0.0).to_array()).collect();
        }
        let normals = |shape: &Bounded| match shape {
            Bounded::Triangle(triangle) => triangle.normals,
            Bounded::Sphere(_) | Bounded::Box(_) => None,
        };
        if bvh.shapes.iter().any(|of| normals(&of.shape).is_some()) {
            // Zero at each corner stands for the triangle's own.
            let corners = bvh.shapes.iter().map(|of| normals(&of.shape).unwrap_or_default());
            tree.normals =
                corners.map(|corners| corners.map(|normal| normal.extend(0.0).to_array())).collect();
            tree.kinds |= 1 << SMOOTH;
        }
        tree
    }
}

/// `KIND_SPHERE` and so on of bvh.glsl.
fn kind(shape: &Bounded) -> u32 {
    match shape {
        Bounded::Sphere(_) => 0,
        Bounded::Box(_) => 1,
        Bounded::Triangle(_) => 2,
    }
}

fn tree_record(bvh: &Bvh, record: &Record) -> [u32; 12] {
    match record {
        Record::Node(node) => bytemuck::cast(tree_node(node)),
        Record::Leaf(index) => bytemuck::cast(tree_shape(*index, &bvh.shapes[*index as usize])),
    }
}

fn tree_node(node: &Node) -> TreeNode {
    // As the exponent's bits of an f32.
    let [x, y, z] = node.exponents.map(|exponent| (exponent + 127) as u32);
    let [planes_x, planes_y, planes_z] = node.planes.map(|planes| planes.map(u32::from_le_bytes));
    TreeNode {
        origin: node.origin.to_array(),
        about: x | y << 8 | z << 16 | node.children << 24,
        planes_x,
        planes_y,
        planes_z,
        pad0: 0,
        first: node.first,
    }
}

fn tree_shape(index: u32, Shaded { shape, material, .. }: &Shaded<Bounded>) -> TreeShape {
    let (position, a, b) = match shape {
        Bounded::Sphere(sphere) => (sphere.center, Vec3::splat(sphere.radius), Vec3::ZERO),
        Bounded::Box(aabb) => (aabb.lower, aabb.upper, Vec3::ZERO),
        Bounded::Triangle(triangle) => {
            let [a, b, c] = triangle.vertices;
            (a, b - a, c - a)
        }
    };
    let [position, a, b] = [position, a, b].map(|vector| vector.to_array());
    TreeShape { position, material: *material, a, kind: kind(shape), b, index }
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
