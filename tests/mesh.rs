//! Meshes: what OBJ files mean, their normals, where they are put, and how a lone mesh is shown.

mod common;

use common::Gpu;
use glam::{DVec3, Vec3};
use std::fmt::Write;
use std::time::Duration;
use thinlens::error::Error;
use thinlens::output::loading_line;
use thinlens::reference::Ray;
use thinlens::reference::intersect::intersect;
use thinlens::reference::shading::radiance;
use thinlens::scene::{self, Plane, Scene, SceneRef, Triangle};
use thinlens::settings::Settings;

/// A scene file without shapes; nothing but the tables that follow gives light.
const HEAD: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 9\n";

/// Loads the first of these files, which lie in one folder.
fn load(files: &[(&str, &[u8])]) -> Result<Scene, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a writable temporary folder");
    }
    scene::load(folder.path().join(files[0].0).to_str().expect("a plain path"))
}

/// The triangles of an OBJ text, in its own coordinates.
fn triangles(obj: &str) -> Vec<Triangle> {
    let toml = format!("{HEAD}[[mesh]]\nfile = \"mesh.obj\"\n");
    let scene = load(&[("test.toml", toml.as_bytes()), ("mesh.obj", obj.as_bytes())]).expect("a mesh");
    scene.of_kind::<Triangle>().map(|(triangle, _)| *triangle).collect()
}

fn across(triangle: &Triangle) -> DVec3 {
    let [a, b, c] = triangle.vertices;
    (b - a).cross(c - a)
}

fn normals(triangle: &Triangle) -> [Vec3; 3] {
    triangle.normals.expect("a mesh's triangles have normals")
}

/// A sphere of radius one around the origin: each face of an octahedron in `n * n` triangles.
/// With `repeated`, each triangle has positions of its own; with `given`, the file has normals.
fn sphere(n: u32, repeated: bool, given: bool) -> String {
    let (mut text, mut faces, mut count) = (String::new(), String::new(), 0);
    let mut numbers = std::collections::HashMap::new();
    for octant in 0..8 {
        let sign = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let mut corner = |i: u32, j: u32| {
            let parts = [i, j, n - i - j].map(f64::from);
            let at = (DVec3::from_array(parts) * DVec3::new(sign(0), sign(1), sign(2))).normalize();
            let written = format!("{:.7} {:.7} {:.7}", at.x + 0.0, at.y + 0.0, at.z + 0.0);
            let number = numbers.get(&written).copied().filter(|_| !repeated).unwrap_or(count + 1);
            if number > count {
                count = number;
                writeln!(text, "v {written}").expect("text");
                if given {
                    writeln!(text, "vn {written}").expect("text");
                }
                numbers.insert(written, number);
            }
            if given { format!("{number}//{number}") } else { number.to_string() }
        };
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            let mut write = |mut corners: [String; 3]| {
                // A mirrored octant is wound the other way.
                if sign(0) * sign(1) * sign(2) < 0.0 {
                    corners.swap(1, 2);
                }
                writeln!(faces, "f {}", corners.join(" ")).expect("text");
            };
            write([corner(i, j), corner(i + 1, j), corner(i, j + 1)]);
            if i + j + 1 < n {
                write([corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
            }
        }
    }
    text + &faces
}

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 4 3 2 1\n\
                    f 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";

/// Catches polygons that lose a corner, and indices off by one: regular polygons keep their area and
/// their side, however their corners are written.
#[test]
fn polygons_become_triangles_of_the_same_area() {
    for corners in 3..12_i32 {
        let angle = std::f64::consts::TAU / f64::from(corners);
        let mut positions = String::from("v 9 9 9 # not used\nvt 0 0\nvn 0 0 -1\nvn 0 0 1\n");
        for corner in 0..corners {
            let (sin, cos) = (f64::from(corner) * angle).sin_cos();
            writeln!(positions, "v {cos} {sin} 5 0.1 0.2 0.3").expect("text");
        }
        let face = |corner: &dyn Fn(i32) -> String| {
            let words: Vec<String> = (0..corners).map(corner).collect();
            triangles(&format!("{positions}f {} # a face\n", words.join(" ")))
        };
        let forms: [&dyn Fn(i32) -> String; 6] = [
            &|corner| format!("{}", corner + 2),
            &|corner| format!("{}", corner - corners),
            &|corner| format!("{}/1", corner + 2),
            &|corner| format!("{}//2", corner + 2),
            &|corner| format!("{}/-1/-1", corner - corners),
            // Joined lines are one.
            &|corner| format!("{}/1/2 \\\r\n ", corner + 2),
        ];
        for form in forms {
            let triangles = face(form);
            assert_eq!(triangles.len(), corners as usize - 2);
            let area = triangles.iter().map(across).sum::<DVec3>() / 2.0;
            let expected = 0.5 * f64::from(corners) * angle.sin();
            assert!((area - DVec3::Z * expected).length() < 1e-5, "{corners}: {area}");
            for triangle in &triangles {
                assert!(triangle.vertices.iter().all(|vertex| vertex.z == 5.0));
                assert!(normals(triangle).iter().all(|normal| (*normal - Vec3::Z).length() < 1e-6));
            }
        }
    }
}

/// Catches normals of the file that are not used, not made unit vectors, or given to the wrong corner;
/// and ones that are taken where a corner has none.
#[test]
fn normals_of_the_file_are_kept() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 3\nvn 0 4 3\nvn -2 0 0\nvn 0 0 0\n";
    let own = triangles(&format!("{text}f 1//1 2//2 3//3\n"));
    let expected = [Vec3::Z, Vec3::new(0.0, 0.8, 0.6), -Vec3::X];
    for (normal, expected) in normals(&own[0]).into_iter().zip(expected) {
        assert!((normal - expected).length() < 1e-6, "{normal}");
    }
    for faces in ["f 1//2 2//2 3\n", "f 1//2 2//2 3//4\n"] {
        assert_eq!(normals(&triangles(&format!("{text}{faces}"))[0]), [Vec3::Z; 3], "{faces}");
    }
}

/// Catches a cube with round edges and a sphere with flat faces, also where a file repeats positions;
/// and a crease at another angle, or of one side only.
#[test]
fn missing_normals_are_smooth_up_to_the_crease() {
    for triangle in triangles(CUBE) {
        let own = across(&triangle).normalize();
        assert!(normals(&triangle).iter().all(|normal| (normal.as_dvec3() - own).length() < 1e-6));
    }
    for repeated in [false, true] {
        let triangles = triangles(&sphere(8, repeated, false));
        assert_eq!(triangles.len(), 512);
        let flat = |of: &Triangle| across(of).angle_between(of.vertices[0]).to_degrees();
        assert!(triangles.iter().any(|of| flat(of) > 4.0), "flat faces would pass");
        for (vertex, normal) in triangles.iter().flat_map(|of| of.vertices.into_iter().zip(normals(of))) {
            let off = normal.as_dvec3().angle_between(vertex).to_degrees();
            assert!(off < 3.0 && (normal.length() - 1.0).abs() < 1e-6, "{off} degrees at {vertex}");
        }
    }
    // Two unit squares that meet in the x axis; the second is half as wide, so it weighs half.
    for (degrees, smooth) in [(39.0_f64, true), (41.0, false), (-39.0, true), (-41.0, false)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (y, z) = (0.5 * cos, 0.5 * sin);
        let hinge = triangles(&format!(
            "v 0 0 0\nv 1 0 0\nv 1 -1 0\nv 0 -1 0\nv 1 {y} {z}\nv 0 {y} {z}\nf 4 3 2 1\nf 1 2 5 6\n"
        ));
        let tilted = DVec3::new(0.0, -sin, cos);
        for triangle in &hinge {
            let own = across(triangle).normalize();
            for (vertex, normal) in triangle.vertices.into_iter().zip(normals(triangle)) {
                // A corner of a square belongs to one or two of its triangles.
                let near = |weights: [f64; 2]| {
                    let mean = (weights[0] * DVec3::Z + weights[1] * tilted).normalize();
                    (normal.as_dvec3() - mean).length() < 1e-6
                };
                let meets = vertex.y == 0.0 && smooth;
                let weights = [[1.0, 0.5], [1.0, 1.0], [2.0, 0.5], [0.5, 0.5]];
                let found = if meets {
                    weights.into_iter().any(near)
                } else {
                    (normal.as_dvec3() - own).length() < 1e-6
                };
                assert!(found, "{degrees} degrees at {vertex}: {normal}");
            }
        }
    }
}

/// Catches another order of scale, turns and move, and normals that do not turn along.
#[test]
fn a_mesh_is_scaled_then_turned_about_x_y_z_then_moved() {
    let toml = format!(
        "{HEAD}[[mesh]]\nfile = \"m.obj\"\nscale = 2\nrotate_degrees = [90, 90, 90]\nposition = [10, 20, 30]\n"
    );
    let obj = b"v 1 2 3\nv 2 2 3\nv 1 3 3\nvn 0 0 1\nvn 1 0 0\nvn 0 1 0\nf 1//1 2//2 3//3\n";
    let scene = load(&[("test.toml", toml.as_bytes()), ("m.obj", obj)]).expect("a mesh");
    let triangle = *scene.of_kind::<Triangle>().next().expect("a triangle").0;
    // (2, 4, 6), about x (2, -6, 4), about y (4, -6, -2), about z (6, 4, -2).
    let expected = [[16.0, 24.0, 28.0], [16.0, 24.0, 26.0], [16.0, 26.0, 28.0]];
    // The normals: z to -y to -y to x; x to x to -z to -z; y to z to x to y.
    let expected_normals = [Vec3::X, -Vec3::Z, Vec3::Y];
    for corner in 0..3 {
        let (vertex, normal) = (triangle.vertices[corner], normals(&triangle)[corner]);
        assert!((vertex - DVec3::from_array(expected[corner])).length() < 1e-12, "{vertex}");
        assert!((normal - expected_normals[corner]).length() < 1e-6, "{normal}");
    }
}

/// Catches colours that are lost, or given to the wrong faces; and a material of the scene file that
/// does not prevail.
#[test]
fn colours_come_from_the_library_unless_the_scene_says_otherwise() {
    let obj = "mtllib my colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl the blue\n\
               f 1 2 3\nusemtl unknown\nf 1 2 3\nusemtl red\nf 1 2 3\n";
    let library =
        b"# \xe9\nnewmtl red\nNs 9\nKd 0.9 0.1 0\nnewmtl the blue\nKd 0 0 7\nKd 0.3 1\nnewmtl none\n";
    let colors = |material: &str| {
        let toml = format!("{HEAD}[emissive.lamp]\nradiance = 1\n[[mesh]]\nfile = \"m.obj\"\n{material}");
        let files: &[(&str, &[u8])] =
            &[("t.toml", toml.as_bytes()), ("m.obj", obj.as_bytes()), ("my colours.mtl", library)];
        let scene = load(files).expect("a mesh");
        scene.of_kind::<Triangle>().map(|(_, of)| scene.materials[of.material as usize]).collect::<Vec<_>>()
    };
    let own = colors("");
    assert_eq!(own[1].color, Vec3::new(0.9, 0.1, 0.0));
    assert_eq!(own[2].color, Vec3::Z);
    assert_eq!((own[0], own[4]), (own[3], own[1]));
    assert!(own.iter().all(|material| material.kd == 1.0));
    assert!(colors("material = \"lamp\"\n").iter().all(|material| material.emission == Vec3::ONE));
}

/// Catches errors without file and line, or that do not say what is wrong.
#[test]
fn an_error_names_file_and_line() {
    let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, line, part) in [
        ("v 0 0\n".to_owned(), 1, "three numbers"),
        ("# \n\nv 0 0 zero\n".to_owned(), 3, "'zero' is no number"),
        ("v 0 nan 0\n".to_owned(), 1, "'nan' is no number"),
        ("v 0 1e10 0\n".to_owned(), 1, "from -1e9 to 1e9"),
        ("v 0 0,5 0\n".to_owned(), 1, "a point for the comma"),
        (format!("{start}f 1 2 3\nf 1 2 4\n"), 5, "number 4 of the 3 positions"),
        (format!("f 1 2 9\n{start}f 1 2 4\n"), 1, "number 9 of the 3 positions"),
        (format!("{start}vn 0 0 1\nf 1//1 2//1 3//2\n"), 5, "number 2 of the 1 normals"),
        (format!("{start}f 1 2 \\\n-4\n"), 4, "'-4' is no corner"),
        (format!("{start}f 0 1 2\n"), 4, "'0' is no corner"),
        (format!("{start}f 1 2 3/1/1/1\n"), 4, "'3/1/1/1' is no corner"),
        (format!("{start}f 1 2 99999999999\n"), 4, "'99999999999' is no corner"),
        (format!("{start}f 1 2\n"), 0, "no faces"),
        (start.to_owned(), 0, "no faces"),
        (format!("{start}f 1 2 2\n"), 0, "has an area"),
        ("v 0 0 0\nv 1e-7 0 0\nv 0 1e-7 0\nf 1 2 3\n".to_owned(), 0, "must be from 1e-4 to 1e7"),
        ("v 0 0 0\nv 1e8 0 0\nv 0 1e8 0\nf 1 2 3\n".to_owned(), 0, "must be from 1e-4 to 1e7"),
    ] {
        let error = load(&[("test.obj", text.as_bytes())]).expect_err("the file is wrong");
        assert_eq!(error.exit_code(), 1);
        let shown = error.to_string();
        let place = if line == 0 { "test.obj: ".to_owned() } else { format!("test.obj:{line}: ") };
        assert!(shown.contains(&place) && shown.contains(part), "'{shown}' lacks '{place}' or '{part}'");
        assert!(!shown.contains('\n'), "{shown}");
        // In a scene file, the scene's line and the mesh's are named; size is no matter there.
        let toml = format!("{HEAD}[[mesh]]\nfile = \"test.obj\"\n");
        let inside = load(&[("a.toml", toml.as_bytes()), ("test.obj", text.as_bytes())]);
        if !part.contains("1e-4") {
            let shown = inside.expect_err("the file is wrong").to_string();
            assert!(shown.contains("a.toml:8: ") && shown.contains(&place), "{shown}");
        }
    }
    let missing = scene::load("nowhere/mesh.obj").expect_err("no such file");
    assert!(missing.to_string().contains("cannot read nowhere/mesh.obj"), "{missing}");
    let toml = format!("{HEAD}[[mesh]]\nfile = \"m.obj\"\nscale = 1e9\n");
    let obj = format!("{start}v 9 9 9\nf 1 2 4\n");
    let beyond = load(&[("a.toml", toml.as_bytes()), ("m.obj", obj.as_bytes())]).expect_err("too large");
    assert!(beyond.to_string().contains("smaller scale"), "{beyond}");
}

/// Catches triangles without area that would give normals without length.
#[test]
fn triangles_without_area_are_left_out() {
    let triangles = triangles("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\nf 3 2 1\n");
    assert_eq!(triangles.len(), 2);
    assert!(triangles.iter().flat_map(normals).all(|normal| (normal.length() - 1.0).abs() < 1e-6));
}

/// Catches a mesh that leaves the picture or is lost in it, floats above or sinks into the ground, or is
/// focused elsewhere than on its nearest point; for sizes from a tenth of a millimetre to ten thousand
/// kilometres, far from the origin, flat, thin, or a single triangle.
#[test]
fn a_lone_mesh_is_framed_and_in_focus_at_its_nearest_point() {
    let mut random = fastrand::Rng::with_seed(7);
    for case in 0..400 {
        let size = 10_f64.powf(random.f64() * 9.0 - 3.0);
        let mut extent = DVec3::new(random.f64(), random.f64(), random.f64()) * size;
        if case % 4 == 1 {
            extent[random.usize(0..3)] = 0.0;
        }
        let offset = DVec3::new(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5) * 20.0 * size;
        let count = if case % 5 == 2 { 3 } else { 30 };
        let mut obj = String::new();
        for _ in 0..count {
            let at = offset + extent * DVec3::new(random.f64(), random.f64(), random.f64());
            writeln!(obj, "v {} {} {}", at.x, at.y, at.z).expect("text");
        }
        (1..=count - 2).for_each(|i| writeln!(obj, "f {i} {} {}", i + 1, i + 2).expect("text"));
        let scene = match load(&[("some.obj", obj.as_bytes())]) {
            Ok(scene) => scene,
            Err(error) => panic!("{error} for size {size}"),
        };
        assert_eq!(scene.name, "some.obj");
        check_stage(&scene);
        Settings::of_scene(scene::SceneRef::new(scene)).check().expect("every number is in its range");
    }
}

fn check_stage(scene: &Scene) {
    let (camera, lens) = (&scene.camera, &scene.lens);
    let frame = camera.frame();
    let vertices: Vec<DVec3> =
        scene.of_kind::<Triangle>().flat_map(|(triangle, _)| triangle.vertices).collect();
    let lower = vertices.iter().copied().reduce(DVec3::min).expect("vertices");
    let upper = vertices.iter().copied().reduce(DVec3::max).expect("vertices");
    let diagonal = (upper - lower).length();
    let highest = (0.5 * camera.vfov_radians).tan();
    let widest = highest * f64::from(scene.size[0]) / f64::from(scene.size[1]);
    let mut fill = 0_f64;
    for corner in 0..8_u32 {
        let bits = DVec3::from_array([0, 1, 2].map(|bit| f64::from(corner >> bit & 1)));
        let at = lower + bits * (upper - lower) - camera.eye;
        let depth = -at.dot(frame.w());
        assert!(depth > 0.05 * diagonal, "the eye stands clear of the mesh");
        fill = fill.max((at.dot(frame.u()) / depth / widest).abs());
        fill = fill.max((at.dot(frame.v()) / depth / highest).abs());
    }
    // A box that the camera looks along is held farther away than it would need.
    assert!((0.3..0.85).contains(&fill), "the box fills {fill} of the picture");
    let ground = *scene.of_kind::<Plane>().next().expect("a plane").0;
    let gap = (lower.y - ground.point.y) / diagonal;
    assert!(ground.normal == Vec3::Y && (0.0..2e-3).contains(&gap), "the mesh is {gap} above the ground");
    let depths = vertices.iter().map(|vertex| frame.axial_depth(camera.eye, *vertex));
    let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(near, far), z| (near.min(z), far.max(z)));
    let focus = f64::from(lens.focal_distance);
    assert!((focus / near - 1.0).abs() < 1e-5, "{focus} is not {near}");
    let k = camera.view_distance_pixels(720);
    let blur = common::circle_of_confusion(f64::from(lens.diameter), focus, far, k);
    let distant = common::circle_of_confusion(f64::from(lens.diameter), focus, 1e3 * focus, k);
    assert!(blur < 18.1 && distant > 18.0, "blurred over {blur} pixels, the distance over {distant}");
    assert!(far < 1.2 * near || blur > 8.0, "blurred over {blur} pixels only, from {near} to {far}");
    assert!(
        scene.lights.iter().any(|light| light.shadows) && scene.lights.iter().any(|light| !light.shadows)
    );
}

/// Catches an oracle that shades with the wrong corner's normal, or with none: on a sphere's
/// triangles, the given normals are the sphere's, so at corners the shading normal is the position, and
/// in between the corners' mean.
#[test]
fn the_oracle_interpolates_normals() {
    let toml = format!("{HEAD}[[mesh]]\nfile = \"m.obj\"\n");
    let obj = sphere(3, false, true);
    let scene = load(&[("t.toml", toml.as_bytes()), ("m.obj", obj.as_bytes())]).expect("a mesh");
    let mut random = fastrand::Rng::with_seed(3);
    for (triangle, _) in scene.of_kind::<Triangle>() {
        let corners = triangle.vertices;
        let flat = across(triangle).normalize();
        let outward = if flat.dot(corners[0]) > 0.0 { flat } else { -flat };
        let mut weights = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        weights.extend((0..5).map(|_| {
            let (a, b) = (random.f64(), random.f64());
            if a + b < 1.0 { [a, b, 1.0 - a - b] } else { [1.0 - a, 1.0 - b, a + b - 1.0] }
        }));
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        for [a, b, c] in weights {
            // A little inwards, for a ray that meets an edge may pass by.
            let at = (a * corners[0] + b * corners[1] + c * corners[2]).lerp(middle, 1e-6);
            let expected = (a * corners[0] + b * corners[1] + c * corners[2]).normalize();
            for side in [1.0, -1.0] {
                let direction = -side * outward;
                let ray = Ray { origin: at - 0.1 * direction, direction, time: 0.0 };
                let hit = intersect(&scene, ray, 0.0).expect("it meets the triangle");
                assert!((hit.distance - 0.1).abs() < 1e-6, "{hit:?}");
                assert!((hit.normal - side * outward).length() < 1e-6, "{hit:?}");
                assert!((hit.shading_normal - side * expected).length() < 1e-5, "{hit:?}, not {expected}");
            }
        }
    }
}

/// Catches light and mirrors that use the wrong one of the two normals. The floor lies in y = 0; its
/// normals are those given.
#[test]
fn light_and_mirrors_see_the_shading_normal_above_the_surface() {
    let floor = |normals: [&str; 3], rest: &str| {
        let toml = format!("{HEAD}{rest}[[mesh]]\nfile = \"m.obj\"\nmaterial = \"m\"\n");
        let [a, b, c] = normals;
        let obj = format!("v -9 0 9\nv 9 0 9\nv 0 0 -9\nvn {a}\nvn {b}\nvn {c}\nf 1//1 2//2 3//3\n");
        load(&[("t.toml", toml.as_bytes()), ("m.obj", obj.as_bytes())]).expect("a mesh")
    };
    let light = |direction: &str| {
        format!(
            "[[directional]]\ndirection = {direction}\nradiance = 2\n[matte.m]\nka = 0\nkd = 1\ncolor = [1, 1, 1]\n"
        )
    };
    let down = Ray { origin: DVec3::Y, direction: -DVec3::Y, time: 0.0 };
    let matte = |cosine: f64| DVec3::splat(2.0 / std::f64::consts::PI * cosine);
    for (normal, direction, expected) in [
        ("0 1 0", "[0, 1, 0]", matte(1.0)),
        ("3 4 0", "[0, 1, 0]", matte(0.8)),
        ("-3 -4 0", "[0, 1, 0]", matte(0.8)),
        ("3 4 0", "[3, 4, 0]", matte(1.0)),
        // Below the surface, and behind the shading normal.
        ("4 3 0", "[4, -1, 0]", matte(0.0)),
        ("4 3 0", "[-4, 1, 0]", matte(0.0)),
    ] {
        let got = radiance(&floor([normal; 3], &light(direction)), down, 0);
        assert!((got - expected).length() < 1e-6, "{normal}, light from {direction}: {got}, not {expected}");
    }
    // A sum of zero falls back to the geometric normal.
    let zero = floor(["1 0 0", "-1 0 0", "0 0 1"], &light("[0, 1, 0]"));
    let ray = Ray { origin: DVec3::new(0.0, 1.0, 9.0 - 1e-9), direction: -DVec3::Y, time: 0.0 };
    assert!((radiance(&zero, ray, 0) - matte(0.0)).length() < 1e-3, "almost zero is not zero");
    let zero = floor(["1 0 0", "-1 0 0", "0 1 0"], &light("[0, 1, 0]"));
    let ray = Ray { origin: DVec3::new(0.0, 1.0, 9.0), direction: -DVec3::Y, time: 0.0 };
    assert!((radiance(&zero, ray, 0) - matte(1.0)).length() < 1e-6);

    let sky =
        "[background]\nhorizon = [0, 0, 0]\nzenith = [1, 1, 1]\n[mirror.m]\nkr = 1\ncolor = [1, 1, 1]\n";
    let slanted = Ray { origin: DVec3::Y, direction: DVec3::new(0.6, -0.8, 0.0), time: 0.0 };
    for (normal, height) in [
        ("0 1 0", 0.8_f64),
        // Turned by 10 degrees: the mirrored ray turns by 20.
        ("0.173648178 0.984807753 0", (53.130_102_f64 - 20.0).to_radians().sin()),
        // By 30: it would lead below, and leads above by as much.
        ("0.5 0.866025404 0", (60.0 - 53.130_102_f64).to_radians().sin()),
    ] {
        let got = radiance(&floor([normal; 3], sky), slanted, 1);
        let expected = height * (2.0 - height);
        assert!((got - DVec3::splat(expected)).length() < 1e-6, "{normal}: {got}, not {expected}");
    }
}

/// Catches a tree of a single shape that is taken for none: it was not shown.
#[test]
fn a_mesh_of_one_triangle_is_shown() {
    let gpu = Gpu::new();
    let scene = load(&[("one.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]).expect("a mesh");
    let mut settings = Settings::of_scene(SceneRef::new(scene));
    (settings.estimator.size, settings.samples) = ([64, 36], 4);
    thinlens::verify::verify(&mut gpu.renderer(), &settings).unwrap_or_else(|error| panic!("{error}"));
}

/// Catches a line after every small scene, and one that cannot be read.
#[test]
fn a_long_loading_is_said() {
    let line = |milliseconds| loading_line("mesh.obj", 1_048_576, Duration::from_millis(milliseconds));
    assert_eq!(line(400), None);
    assert_eq!(line(1230).as_deref(), Some("mesh.obj: 1,048,576 triangles read in 1.2 s"));
}

/// Catches a file that makes the reading panic: every prefix, and ten thousand mutations.
#[test]
fn no_file_panics() {
    let valid = "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 -0\nv 0 1e0 0\nv 1 1 1\nvn 0 0 1\nvn 0 1 0\nvt 0 0\n\
                 f 1 2 3 4\nf -1//1 -2//-1 \\\n 2//2\nf 1/1/1 2/1/2 4/1/1 # end\ng a\ns off\n";
    let library = "newmtl red\nKd 1 0.5 0\nnewmtl b\nKd 1\nmap_Kd a.png\n";
    let both = |obj: &[u8], library: &[u8]| load(&[("m.obj", obj), ("a.mtl", library)]);
    assert_eq!(both(valid.as_bytes(), library.as_bytes()).expect("valid").of_kind::<Triangle>().count(), 4);
    for end in 0..valid.len() {
        let _ = both(&valid.as_bytes()[..end], library.as_bytes());
    }
    let parts: [&[u8]; 16] = [
        b"\n",
        b"\\\n",
        b"\\",
        b"/",
        b"//",
        b"-",
        b"f ",
        b"v ",
        b" ",
        b"#",
        b"nan",
        b"1e999",
        b"0",
        b"usemtl",
        b"9223372036854775808",
        b"-9223372036854775808",
    ];
    let mut random = fastrand::Rng::with_seed(11);
    for _ in 0..10_000 {
        let mut texts = [valid.as_bytes().to_vec(), library.as_bytes().to_vec()];
        for _ in 0..random.usize(1..8) {
            let text = &mut texts[usize::from(random.u8(0..8) == 0)];
            let at = random.usize(0..=text.len());
            let end = (at + random.usize(0..6)).min(text.len());
            let new = match random.u8(0..3) {
                0 => vec![random.u8(..)],
                1 => parts[random.usize(0..parts.len())].to_vec(),
                _ => text[random.usize(0..=at)..at].to_vec(),
            };
            text.splice(at..end, new);
        }
        let _ = both(&texts[0], &texts[1]);
    }
}
