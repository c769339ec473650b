//! Meshes from OBJ files: their triangles, normals and colours, where they are put, and wrong files.

mod common;

use common::mesh::{HEAD, across, load, sphere};
use glam::{DVec3, Vec3};
use std::fmt::Write;
use std::time::Duration;
use thinlens::output::loading_line;
use thinlens::scene::{self, Emissive, Matte, Texture, Triangle};

/// The triangles of an OBJ text, in its own coordinates.
fn triangles(obj: &str) -> Vec<Triangle> {
    let toml = format!("{HEAD}[[mesh]]\nfile = \"mesh.obj\"\n");
    let scene = load(&[("test.toml", toml.as_bytes()), ("mesh.obj", obj.as_bytes())]).expect("a mesh");
    scene.of_kind::<Triangle>().map(|(triangle, _)| *triangle).collect()
}

fn normals(triangle: &Triangle) -> [Vec3; 3] {
    triangle.normals.expect("a mesh's triangles have normals")
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
    let matte = |color| Matte { color: Texture::constant(color), ka: 1.0, kd: 1.0 }.into();
    assert_eq!(own[1..3], [matte(Vec3::new(0.9, 0.1, 0.0)), matte(Vec3::Z)]);
    assert_eq!((own[0], own[4]), (own[3], own[1]));
    let lamp = Emissive { radiance: Vec3::ONE }.into();
    assert!(colors("material = \"lamp\"\n").iter().all(|material| *material == lamp));
}

/// Catches errors without file and line, or that do not say what is wrong.
#[test]
fn an_error_names_file_and_line() {
    let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, line, part) in [
        ("v 0 0\n".to_owned(), 1, "three numbers"),
        ("# \n\nv 0 0 zero\n".to_owned(), 3, "'zero' is not a number"),
        ("v 0 nan 0\n".to_owned(), 1, "'nan' is not a number"),
        ("v 0 1e10 0\n".to_owned(), 1, "from -1e9 to 1e9"),
        ("v 0 0,5 0\n".to_owned(), 1, "a point for the comma"),
        (format!("{start}f 1 2 3\nf 1 2 4\n"), 5, "number 4 of the 3 positions"),
        (format!("f 1 2 9\n{start}f 1 2 4\n"), 1, "number 9 of the 3 positions"),
        (format!("{start}vn 0 0 1\nf 1//1 2//1 3//2\n"), 5, "number 2 of the 1 normals"),
        (format!("{start}f 1 2 \\\n-4\n"), 4, "'-4' is not a corner"),
        (format!("{start}f 0 1 2\n"), 4, "'0' is not a corner"),
        (format!("{start}f 1 2 3/1/1/1\n"), 4, "'3/1/1/1' is not a corner"),
        (format!("{start}f 1 2 99999999999\n"), 4, "'99999999999' is not a corner"),
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
