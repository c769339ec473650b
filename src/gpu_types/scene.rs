//! A scene as the shaders want it.

use super::{Box, Environment, Light, Material, Plane, Sphere, TreeNode, TreeShape, Triangle};
use crate::interface::shape;
use crate::scene::{self, Bounded, Bvh, LightKind, Node, Record, SceneRef, Shaded};
use bytemuck::Zeroable;
use glam::{DVec3, Vec3};

/// More bounded shapes than these go into a tree: with fewer, trying each is faster.
const MOST_LISTED_SHAPES: usize = 64;

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
    /// Whether the origin of these coordinates is not the scene's own.
    pub shifted: bool,
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
    pub fn new(scene: &SceneRef, shutter: f32) -> Self {
        let smooth = scene.triangles.iter().any(|of| of.shape.normals.is_some());
        let bounded = scene.spheres.len() + scene.boxes.len() + scene.triangles.len();
        Self::with_tree(scene, shutter, smooth || bounded > MOST_LISTED_SHAPES)
    }

    /// Likewise, with the bounded shapes in a tree or in lists.
    pub fn with_tree(scene: &SceneRef, shutter: f32, tree: bool) -> Self {
        let origin = scene.middle();
        let mut spheres: Vec<_> =
            scene.spheres.iter().map(|of| of.map(|sphere| sphere.seen_from(origin))).collect();
        let mut boxes: Vec<_> = scene.boxes.iter().map(|of| of.map(|aabb| aabb.seen_from(origin))).collect();
        let seen = |triangle: scene::Triangle| triangle.seen_from(origin).from_widest_corner();
        let mut triangles: Vec<_> = scene.triangles.iter().map(|of| of.map(seen)).collect();
        let reach = reach(&spheres, &boxes, &triangles, shutter);
        let tree = tree.then(|| {
            let spheres = spheres.drain(..).map(|of| of.map(Bounded::Sphere));
            let boxes = boxes.drain(..).map(|of| of.map(Bounded::Box));
            let triangles = triangles.drain(..).map(|of| of.map(Bounded::Triangle));
            Bvh::new(spheres.chain(boxes).chain(triangles).collect(), shutter)
        });
        let tree = tree.flatten().map(|bvh| Tree::new(&bvh));
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
            velocities: velocities.filter(|_| moves).map(|velocity| with_zero(floats(velocity))).collect(),
            moves,
            shifted: origin != DVec3::ZERO,
            spheres: spheres.iter().map(|shaded| sphere(&shaded.shape)).collect(),
            boxes: boxes.iter().map(|shaded| aabb(&shaded.shape)).collect(),
            triangles: triangles.iter().map(|shaded| triangle(&shaded.shape)).collect(),
            planes: scene.planes.iter().map(|shaded| plane(&shaded.shape, origin)).collect(),
            material_of_shape: material_of_shape.collect(),
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
            tree.velocities = bvh.shapes.iter().map(|of| with_zero(floats(of.velocity))).collect();
        }
        let normals = |shape: &Bounded| match shape {
            Bounded::Triangle(triangle) => triangle.normals,
            Bounded::Sphere(_) | Bounded::Box(_) => None,
        };
        if bvh.shapes.iter().any(|of| normals(&of.shape).is_some()) {
            // Zero at each corner stands for the triangle's own.
            let corners = bvh.shapes.iter().map(|of| normals(&of.shape).unwrap_or_default());
            tree.normals = corners.map(|corners| corners.map(|normal| with_zero(floats(normal)))).collect();
            tree.kinds |= 1 << shape::SMOOTH;
        }
        tree
    }
}

/// The distance from the origin within which all of these stay while the shutter is open for so many seconds.
fn reach(
    spheres: &[Shaded<scene::Sphere>],
    boxes: &[Shaded<scene::Aabb>],
    triangles: &[Shaded<scene::Triangle>],
    shutter: f32,
) -> f32 {
    let moved = |distance: f64, velocity: Vec3| distance + f64::from(0.5 * shutter * velocity.length());
    let spheres = spheres.iter().map(|of| {
        let Shaded { shape: scene::Sphere { center, radius }, velocity, .. } = *of;
        moved(center.length() + f64::from(radius), velocity)
    });
    let boxes =
        boxes.iter().map(|of| moved(of.shape.lower.abs().max(of.shape.upper.abs()).length(), of.velocity));
    let triangles = triangles.iter().map(|of| {
        let farthest = of.shape.vertices.iter().map(|vertex| vertex.length()).fold(0.0, f64::max);
        moved(farthest, of.velocity)
    });
    let farthest = spheres.chain(boxes).chain(triangles).fold(0.0, f64::max);
    // With what f32 loses of the places of the shapes.
    (1.000_01 * farthest) as f32
}

/// As devices want it: without denormal numbers, which are a hundred times slower on some processors.
fn float(value: f32) -> f32 {
    if value.is_subnormal() { 0.0 } else { value }
}

/// Likewise.
fn floats(vector: Vec3) -> [f32; 3] {
    vector.to_array().map(float)
}

fn with_zero([x, y, z]: [f32; 3]) -> [f32; 4] {
    [x, y, z, 0.0]
}

fn kind(of: &Bounded) -> u32 {
    match of {
        Bounded::Sphere(_) => shape::SPHERE,
        Bounded::Box(_) => shape::BOX,
        Bounded::Triangle(_) => shape::TRIANGLE,
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
        origin: floats(node.origin),
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
        Bounded::Sphere(sphere) => (sphere.center.as_vec3(), Vec3::splat(sphere.radius), Vec3::ZERO),
        Bounded::Box(aabb) => (aabb.lower.as_vec3(), aabb.upper.as_vec3(), Vec3::ZERO),
        Bounded::Triangle(triangle) => {
            let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_vec3());
            (a, b - a, c - a)
        }
    };
    let [position, a, b] = [position, a, b].map(floats);
    TreeShape { position, material: *material, a, kind: kind(shape), b, index }
}

fn sphere(sphere: &scene::Sphere) -> Sphere {
    Sphere { center: floats(sphere.center.as_vec3()), radius: sphere.radius }
}

fn aabb(aabb: &scene::Aabb) -> Box {
    let [lower, upper] = [aabb.lower, aabb.upper].map(|corner| floats(corner.as_vec3()));
    Box { lower, upper, ..Zeroable::zeroed() }
}

fn triangle(triangle: &scene::Triangle) -> Triangle {
    let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_vec3());
    let [edge1, edge2] = [b - a, c - a];
    Triangle {
        vertex: floats(a),
        offset: float(edge1.cross(edge2).dot(a)),
        edge1: floats(edge1),
        size: edge1.abs().max(edge2.abs()).max_element(),
        edge2: floats(edge2),
        pad0: 0,
    }
}

fn plane(plane: &scene::Plane, origin: DVec3) -> Plane {
    let normal = plane.normal.as_dvec3().normalize();
    Plane { normal: floats(normal.as_vec3()), offset: float(normal.dot(plane.point - origin) as f32) }
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
