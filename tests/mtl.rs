//! MTL files as the world writes them: how they are named and found, and the forms of colours.

use glam::{DVec3, Vec3};
use std::path::Path;
use thinlens::scene::{self, Shaded, Triangle};

const HEAD: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 9\n[[mesh]]\nfile = \"mesh.obj\"\n";
const RED: Vec3 = Vec3::X;
const BLUE: Vec3 = Vec3::Z;
const GREY: Vec3 = Vec3::splat(0.5);
const RED_FILE: &str = "newmtl red\nKd 1 0 0\n";
const BLUE_FILE: &str = "newmtl blue\nKd 0 0 1\n";

/// The colours of a mesh's faces, each of which uses one of the materials.
fn colors(head: &str, materials: &[&str], files: &[(&str, &str)]) -> Vec<Vec3> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut obj = format!("{head}\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    materials.iter().for_each(|name| obj += &format!("usemtl {name}\nf 1 2 3\n"));
    for (name, text) in [("scene.toml", HEAD), ("mesh.obj", &*obj)].iter().chain(files) {
        let path = folder.path().join(Path::new(name));
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a writable folder");
        std::fs::write(path, text).expect("a writable folder");
    }
    let path = folder.path().join("scene.toml");
    let scene = scene::load(path.to_str().expect("a plain path")).unwrap_or_else(|error| panic!("{error}"));
    // As it looks in white ambient light.
    let color =
        |of: &Shaded| scene.materials[of.material as usize].brightest(DVec3::ZERO, DVec3::ONE).as_vec3();
    scene.of_kind::<Triangle>().map(|(_, of)| color(of)).collect()
}

/// The colour that these lines of a material give.
fn color_of(lines: &str) -> Vec3 {
    let library = format!("newmtl a\n{lines}\nnewmtl b\nKd 0 1 0\n");
    colors("mtllib a.mtl", &["a"], &[("a.mtl", &library)])[0]
}

/// What a mesh is made of that has no colour.
fn clay() -> Vec3 {
    color_of("Ns 9")
}

/// Catches libraries that are lost where a line names several, has names with spaces, or both; in quotes, with
/// comments behind, and on lines of their own.
#[test]
fn a_line_names_one_library_or_several() {
    for (line, red, blue) in [
        ("mtllib red.mtl blue.mtl", "red.mtl", "blue.mtl"),
        ("mtllib red.mtl\t blue.MTL # both", "red.mtl", "blue.MTL"),
        ("mtllib red.mtl\nmtllib blue.mtl\nmtllib red.mtl", "red.mtl", "blue.mtl"),
        ("mtllib my red.mtl my blue.mtl", "my red.mtl", "my blue.mtl"),
        ("mtllib \"my red.mtl\" \"my blue.mtl\"", "my red.mtl", "my blue.mtl"),
        ("mtllib red colours blue", "colours", "blue"),
        ("mtllib gone.mtl red.mtl blue.mtl", "red.mtl", "blue.mtl"),
        ("mtllib a #1.mtl\nmtllib b.mtl # two", "a #1.mtl", "b.mtl"),
        ("mtllib a\\red.mtl a/blue.mtl", "a/red.mtl", "a/blue.mtl"),
    ] {
        let got = colors(line, &["red", "blue"], &[(red, RED_FILE), (blue, BLUE_FILE)]);
        assert_eq!(got, [RED, BLUE], "{line}");
    }
    // A name with spaces prevails over its words.
    let files = [("a b.mtl", "newmtl red\nKd 1 0 0\n"), ("b.mtl", "newmtl red\nKd 0 1 0\n")];
    assert_eq!(colors("mtllib a b.mtl", &["red"], &files), [RED]);
}

/// Catches libraries that lie beside the mesh and are not found by the path of another computer, another
/// separator or another case.
#[test]
fn libraries_are_found_by_any_path() {
    for (name, file) in [
        (".\\two.mtl", "two.mtl"),
        ("./two.mtl", "two.mtl"),
        ("D:\\scans\\2019\\two.mtl", "two.mtl"),
        ("D:/scans/two.mtl", "two.mtl"),
        ("/home/nobody/scans/two.mtl", "two.mtl"),
        ("\\\\server\\share\\my two.mtl", "my two.mtl"),
        ("TWO.MTL", "two.mtl"),
        ("two.mtl", "Two.Mtl"),
        ("\u{c9}T\u{c9}.mtl", "\u{e9}t\u{e9}.mtl"),
        ("Parts\\TWO.mtl", "parts/Two.mtl"),
        ("parts\\.\\two.mtl", "parts/two.mtl"),
        ("..\\elsewhere\\two.mtl", "two.mtl"),
    ] {
        assert_eq!(
            colors(&format!("mtllib {name}"), &["red"], &[(file, RED_FILE)]),
            [RED],
            "{name} for {file}"
        );
    }
    // The path as it is written prevails over the last part, and the case as it is written over others.
    let files = [("a/two.mtl", RED_FILE), ("two.mtl", "newmtl red\nKd 0 1 0\n"), ("TWO.mtl", BLUE_FILE)];
    assert_eq!(colors("mtllib a\\two.mtl", &["red"], &files), [RED]);
    assert_eq!(colors("mtllib TWO.mtl", &["blue"], &files), [BLUE]);
}

/// Catches comments behind names that become part of them, and names with a `#` that are cut.
#[test]
fn a_name_is_looked_up_whole_and_then_without_a_comment() {
    let library = "newmtl red # the first\nKd 1 0 0 # not blue\nnewmtl blue\t#\nKd 0 0 1#!\n";
    for names in [["red", "blue"], ["red # hot", "blue # cold # \u{e9}"], ["red # the first", "blue\t#"]] {
        assert_eq!(colors("mtllib a.mtl # x", &names, &[("a.mtl", library)]), [RED, BLUE], "{names:?}");
    }
    let numbered = "newmtl Steel #1\nKd 1 0 0\nnewmtl Steel #2\nKd 0 0 1\n";
    let got =
        colors("mtllib a.mtl", &["Steel #1", "Steel #2", "Steel #2 # cold", "Steel"], &[("a.mtl", numbered)]);
    assert_eq!(got, [RED, BLUE, BLUE, clay()]);
}

/// Catches forms of a colour that are passed over, or that give another material's colour.
#[test]
fn colours_have_all_forms_of_the_format() {
    assert_eq!(color_of("Kd 0.6 "), Vec3::splat(0.6));
    assert_eq!(color_of("kd 1 0 0"), RED);
    assert_eq!(color_of("Kd 0.2 0.3 \\\n0.4"), Vec3::new(0.2, 0.3, 0.4));
    assert_eq!(color_of("Kd 2 -1 0.5"), Vec3::new(1.0, 0.0, 0.5));
    // The white of sRGB, and its red, in CIE XYZ.
    assert!((color_of("Kd xyz 0.9505 1.0 1.089") - Vec3::ONE).length() < 1e-3);
    assert!((color_of("Kd xyz 0.4124 0.2126 0.0193") - RED).length() < 1e-3);
    assert!((color_of("Kd xyz 0.5") - Vec3::new(0.6025, 0.4742, 0.4544)).length() < 1e-3);
    for wrong in ["Kd", "Kd spectral file.rfl 1", "Kd 1 0", "Kd 1 0 red", "Kd nan", "Kd inf 0 0", "Kd xyz"] {
        assert_eq!(color_of(wrong), clay(), "{wrong}");
    }
}

/// Catches a black mesh, where the colours are in pictures, and one that is not black where it should be.
#[test]
fn black_under_a_picture_is_grey() {
    for lines in
        ["Kd 0 0 0\nmap_Kd a.png", "map_Kd -s 1 1 1 a b.png\nKd 0", "map_Kd a.png", "kd 0 0 0\nMAP_KD a.png"]
    {
        assert_eq!(color_of(lines), GREY, "{lines}");
    }
    assert_eq!(color_of("Kd 1 0 0\nmap_Kd a.png"), RED);
    assert_eq!(color_of("Kd 0 0 0"), Vec3::ZERO);
    assert_eq!(color_of("Kd 0 0 0\nmap_Kd\nmap_Bump a.png"), Vec3::ZERO);
}

/// Catches a mesh that is refused for what its library is.
#[test]
fn a_library_that_cannot_be_read_leaves_clay() {
    for text in ["", "version https://git-lfs.github.com/spec/v1\n", "<html>", "PK\u{3}\u{4}", "Kd 1 0 0\n"] {
        assert_eq!(colors("mtllib a.mtl", &["red"], &[("a.mtl", text)]), [clay()], "{text}");
    }
    assert_eq!(colors("mtllib gone.mtl", &["red"], &[]), [clay()]);
    assert_eq!(colors("mtllib .", &["red"], &[]), [clay()]);
    assert_eq!(colors("mtllib", &["red"], &[]), [clay()]);
}
