//! Scenes that take long or go deep where loading or the tree is quadratic somewhere: many faces around a
//! vertex, equal shapes, shapes in one another, and the same library again and again. Each of these tests takes
//! about a second, and minutes or hours with the fault that it is there for.

use glam::{DVec3, Vec3};
use std::fmt::Write;
use thinlens::scene::{self, Bvh, Matte, Record, Scene, Texture, Triangle};

const HEAD: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 9\n[emissive.m]\nradiance = 1\n";

fn load(files: &[(&str, &str)]) -> Scene {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a writable folder");
    }
    let path = folder.path().join(files[0].0);
    scene::load(path.to_str().expect("a plain path")).unwrap_or_else(|error| panic!("{error}"))
}

fn mesh(obj: &str) -> Scene {
    load(&[("a.toml", &format!("{HEAD}[[mesh]]\nfile = \"a.obj\"\n")), ("a.obj", obj)])
}

fn spheres(shapes: impl Iterator<Item = (Vec3, f32)>) -> Scene {
    let mut toml = HEAD.to_owned();
    for (center, radius) in shapes {
        let [x, y, z] = center.to_array();
        writeln!(toml, "[[sphere]]\ncenter = [{x:?}, {y:?}, {z:?}]\nradius = {radius:?}\nmaterial = \"m\"")
            .expect("text");
    }
    load(&[("a.toml", &toml)])
}

/// The tree of a scene's shapes, with a shutter that is open for a second.
fn bvh(scene: &Scene) -> Bvh {
    let bounded = scene.shapes.iter().filter(|of| of.shape.is_bounded());
    Bvh::new(bounded.copied().collect(), 1.0).expect("a tree")
}

/// The tree's depth and how many shapes are in it, after a look at its whole.
fn tree(scene: &Scene) -> (u32, usize) {
    let bvh = bvh(scene);
    let mut leaves: Vec<u32> = (bvh.records.iter())
        .filter_map(|record| if let Record::Leaf(shape) = record { Some(*shape) } else { None })
        .collect();
    let count = leaves.len();
    leaves.sort_unstable();
    leaves.dedup();
    assert_eq!(leaves.len(), count, "a shape is in the tree twice");
    (bvh.depth, count)
}

/// Catches normals that look at every pair of triangles around a vertex.
#[test]
fn many_faces_meet_in_a_vertex() {
    const COUNT: usize = 50_000;
    let mut ring = String::new();
    for corner in 0..COUNT {
        let (sin, cos) = (corner as f64 / COUNT as f64 * std::f64::consts::TAU).sin_cos();
        writeln!(ring, "v {cos} 0 {sin}").expect("text");
    }
    let mut fan = ring.clone() + "f";
    (1..=COUNT).for_each(|corner| write!(fan, " {corner}").expect("text"));
    let mut cone = ring + "v 0 1 0\n";
    let tip = COUNT + 1;
    (1..=COUNT).for_each(|corner| writeln!(cone, "f {tip} {} {corner}", corner % COUNT + 1).expect("text"));
    let equal = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(COUNT);
    for (name, obj) in [("fan", fan), ("cone", cone), ("equal", equal)] {
        let scene = mesh(&obj);
        let count = scene.of_kind::<Triangle>().count();
        assert!(count > COUNT - 10, "the {name} has {count} triangles");
        let (depth, _) = tree(&scene);
        assert!(depth <= 24, "the tree of the {name} is {depth} deep");
    }
}

/// Catches normals of crowded vertices that follow another rule than those of others: by brute force over a
/// vertex with 300 faces in all directions.
#[test]
fn crowded_vertices_have_the_crease_of_others() {
    let mut random = fastrand::Rng::with_seed(17);
    let mut obj = String::from("v 0 0 0\n");
    for face in 0..300 {
        for _ in 0..2 {
            let [x, y, z] = [0; 3].map(|_| random.f32() - 0.5);
            writeln!(obj, "v {x} {y} {z}").expect("text");
        }
        writeln!(obj, "f 1 {} {}", 2 * face + 2, 2 * face + 3).expect("text");
    }
    let scene = mesh(&obj);
    let sums: Vec<DVec3> = scene
        .of_kind::<Triangle>()
        .map(|(of, _)| of.vertices)
        .map(|[a, b, c]| (b - a).cross(c - a))
        .collect();
    for ((triangle, _), own) in scene.of_kind::<Triangle>().zip(&sums) {
        let own = own.normalize();
        let near = sums.iter().filter(|sum| sum.normalize().dot(own) >= 40_f64.to_radians().cos());
        let expected = near.sum::<DVec3>().normalize();
        let normal = triangle.normals.expect("normals")[0];
        assert!((normal.as_dvec3() - expected).length() < 1e-4, "{normal} is not {expected}");
    }
}

/// Catches a tree that is a chain, or takes quadratic time to build, where shapes are equal, nearly equal, in one
/// another, or in rows; and shapes that are lost from it.
#[test]
fn trees_of_crowded_shapes_are_shallow() {
    const COUNT: u32 = 50_000;
    let mut random = fastrand::Rng::with_seed(23);
    let each = || (0..COUNT).map(|index| index as f32);
    let mut near = || Vec3::new(random.f32(), random.f32(), random.f32()) * 1e-3;
    let cases = [
        ("equal", spheres(each().map(|_| (Vec3::ZERO, 1.0))), 1),
        ("concentric", spheres(each().map(|index| (Vec3::ZERO, 1.0 + 1e-4 * index))), COUNT as usize),
        (
            "in one corner",
            spheres(each().map(|index| (Vec3::splat(1.0 + index), 1.0 + index))),
            COUNT as usize,
        ),
        ("nearly equal", spheres(each().map(|_| (near(), 1.0))), COUNT as usize),
        ("in a row", spheres(each().map(|index| (Vec3::X * index, 0.25))), COUNT as usize),
        ("shrinking", spheres((0..320).map(|index| (Vec3::ZERO, 1e9 * 0.9_f32.powi(index)))), 320),
    ];
    for (name, scene, expected) in cases {
        let (depth, count) = tree(&scene);
        assert!(depth <= 24, "the tree of spheres {name} is {depth} deep");
        assert_eq!(count, expected, "{name}");
    }
}

/// Catches copies that are dropped though they are none: another size, place, velocity or kind; and a copy that
/// hides the first.
#[test]
fn only_copies_are_left_out_of_the_tree() {
    let sphere = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
    let moving = format!("{sphere}velocity = [1, 0, 0]\n");
    let larger = sphere.replace("radius = 1", "radius = 2");
    let cube = "[[box]]\nlower = [-1, -1, -1]\nupper = [1, 1, 1]\nmaterial = \"m\"\n";
    let triangle = |corners: &str| format!("[[triangle]]\nvertices = [{corners}]\nmaterial = \"m\"\n");
    let [one, turned, other] = [
        "[0, 0, 0], [1, 0, 0], [0, 1, 0]",
        "[0, 1, -0.0], [1, 0, 0], [0, 0, 0]",
        "[0, 0, 0], [1, 0, 0], [0, 0, 1]",
    ]
    .map(triangle);
    let rectangle = |at: &str| format!("[[rectangle]]\n{at}\nmaterial = \"m\"\n");
    let rectangles = [
        "corner = [0, 0, 0]\nedges = [[1, 0, 0], [0, 2, 0]]",
        "corner = [1, 2, 0]\nedges = [[0, -2, 0], [-1, 0, 0]]",
        "corner = [0, 0, 0]\nedges = [[1, 0, 0], [0, 0, 2]]",
    ]
    .map(rectangle);
    let disc = |normal: &str| {
        format!("[[disc]]\ncenter = [0, 0, 0]\nnormal = {normal}\nradius = 1\nmaterial = \"m\"\n")
    };
    let discs = ["[0, 1, 2]", "[0, -2, -4]", "[0, 1, -2]"].map(disc);
    let spheres = [sphere.repeat(3), moving.repeat(2), larger].concat();
    let triangles = [one, turned, other].concat();
    let text = [HEAD, &spheres, cube, cube, &triangles, &rectangles.concat(), &discs.concat()].concat();
    let scene = load(&[("a.toml", &text)]);
    let bvh = bvh(&scene);
    let mut leaves: Vec<u32> = (bvh.records.iter())
        .filter_map(|record| if let Record::Leaf(shape) = record { Some(*shape) } else { None })
        .collect();
    leaves.sort_unstable();
    // The spheres come first, then the boxes, the triangles, the rectangles and the discs.
    assert_eq!(leaves, [0, 3, 5, 6, 8, 10, 11, 13, 14, 16]);
}

/// Catches a library that is read again for every line that names it, and a folder that is listed again for
/// every name that is not in it.
#[test]
fn each_library_is_read_once() {
    let mut obj = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nnewmtl a\nKd 1 0 0\n");
    obj += &"mtllib a.obj\nmtllib ./a.obj\n".repeat(20_000);
    (0..5000).for_each(|number| writeln!(obj, "mtllib gone{number}.mtl").expect("text"));
    obj += &format!("mtllib {}\n", "a ".repeat(20_000));
    obj += &format!("usemtl a # b\nf 1 2 3\nusemtl a {}\nf 1 2 3\n", "# ".repeat(50_000));
    let scene = mesh(&obj);
    let material = scene.of_kind::<Triangle>().nth(1).expect("two").1.material;
    let red = Matte { color: Texture::constant(Vec3::X), ka: 1.0, kd: 1.0 };
    assert_eq!(scene.materials[material as usize], red.into());
}

/// Catches polygons that take long to cut: going round again and again, or to and fro.
#[test]
fn tangled_polygons_are_cut_in_time() {
    let dart = "v 0 0 0\nv 2 0 1\nv 0 0 2\nv 0.5 0 1\nf";
    let mut random = fastrand::Rng::with_seed(29);
    let mut noise = String::new();
    (0..8000).for_each(|_| writeln!(noise, "v {} 0 {}", random.f32(), random.f32()).expect("text"));
    noise += "f";
    (1..=8000).for_each(|corner| write!(noise, " {corner}").expect("text"));
    for obj in [
        dart.to_owned() + &" 1 2 3 4".repeat(20_000),
        dart.to_owned() + &" 1 2 3 4".repeat(20_000) + " 2",
        noise,
    ] {
        assert!(mesh(&obj).of_kind::<Triangle>().next().is_some());
    }
}
