//! OBJ texts as the world writes them: encodings, line ends, comments, continued lines, polygons, normals, and
//! files that are no OBJ.

use glam::{DVec3, Vec3};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use thinlens::error::Error;
use thinlens::scene::{self, Scene, Shaded, Triangle};

const HEAD: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0\n\
                    focal_distance = 9\n[[mesh]]\nfile = \"mesh.obj\"\n";

/// Loads a scene of a mesh, with other files beside it. A name is bytes.
fn load(obj: &[u8], files: &[(&[u8], &[u8])]) -> Result<Scene, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &[u8], text: &[u8]| {
        let path = folder.path().join(Path::new(OsStr::from_bytes(name)));
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a writable folder");
        std::fs::write(path, text).expect("a writable folder");
    };
    write(b"scene.toml", HEAD.as_bytes());
    write(b"mesh.obj", obj);
    files.iter().for_each(|(name, text)| write(name, text));
    scene::load(folder.path().join("scene.toml").to_str().expect("a plain path"))
}

fn triangles(obj: &[u8]) -> Vec<Triangle> {
    let scene = load(obj, &[]).unwrap_or_else(|error| panic!("{error}"));
    scene.of_kind::<Triangle>().map(|(triangle, _)| *triangle).collect()
}

/// The colours of the triangles.
fn colors(obj: &[u8], files: &[(&[u8], &[u8])]) -> Vec<Vec3> {
    let scene = load(obj, files).unwrap_or_else(|error| panic!("{error}"));
    // As it looks in white ambient light.
    let color =
        |of: &Shaded| scene.materials[of.material as usize].brightest(DVec3::ZERO, DVec3::ONE).as_vec3();
    scene.of_kind::<Triangle>().map(|(_, of)| color(of)).collect()
}

const RED: Vec3 = Vec3::X;
const BLUE: Vec3 = Vec3::Z;
const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const LIBRARY: &[u8] = b"newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";

fn red_and_blue(library_line: &str) -> String {
    format!("{library_line}\n{CORNERS}usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n")
}

fn utf16(text: &str, mark: bool, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let mark = mark.then_some(0xfeff);
    mark.into_iter().chain(text.encode_utf16()).flat_map(bytes).collect()
}

/// Catches a byte order mark that hides the first line, UTF-16 that is read as bytes, and an OBJ whose names
/// do not fit those of an MTL in another Unicode encoding.
#[test]
fn text_is_read_in_any_encoding_with_or_without_a_mark() {
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl 紅\nf 1 2 3\nusemtl 青\nf 1 2 3\n";
    let library = "newmtl 紅\nKd 1 0 0\nnewmtl 青\nKd 0 0 1\n";
    let forms = |text: &str| {
        [
            text.as_bytes().to_vec(),
            [b"\xef\xbb\xbf", text.as_bytes()].concat(),
            utf16(text, true, u16::to_le_bytes),
            utf16(text, true, u16::to_be_bytes),
            utf16(text, false, u16::to_le_bytes),
            utf16(text, false, u16::to_be_bytes),
        ]
    };
    for (number, obj) in forms(obj).iter().enumerate() {
        for (other, library) in forms(library).iter().enumerate() {
            assert_eq!(colors(obj, &[(b"a.mtl", library)]), [RED, BLUE], "OBJ {number}, MTL {other}");
        }
    }
    // The mark may stand before any first line.
    for line in
        ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 9 9 9\n", "# \u{e9}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"]
    {
        assert_eq!(
            triangles(format!("\u{feff}{line}").as_bytes())[0].vertices,
            [DVec3::ZERO, DVec3::X, DVec3::Y]
        );
    }
}

/// Catches names that are made UTF-8: different names in GBK, Shift_JIS or Latin-1, and halves of UTF-16 pairs,
/// would become one, and a file by such a name would not be found.
#[test]
fn names_are_bytes() {
    for [red, blue] in [[&b"\xc4\xa3"[..], b"\xc4\xa4"], [b"\xe9", b"\xe8"], [b"\x95\x5c", b"\x83\x5c"]] {
        let obj = [
            b"mtllib ",
            red,
            b".mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl ",
            red,
            b"\nf 1 2 3\nusemtl ",
            blue,
            b"\nf 1 2 3\n",
        ];
        let library = [b"newmtl ", red, b"\nKd 1 0 0\nnewmtl ", blue, b"\nKd 0 0 1\n"].concat();
        let name = [red, b".mtl"].concat();
        assert_eq!(colors(&obj.concat(), &[(&name, &library)]), [RED, BLUE], "{red:?}");
    }
    let wide = |text: &str| -> Vec<u16> { text.encode_utf16().collect() };
    let bytes = |units: &[&[u16]]| {
        [&[0xfeff], units.concat().as_slice()]
            .concat()
            .iter()
            .flat_map(|unit| unit.to_le_bytes())
            .collect::<Vec<u8>>()
    };
    let (one, other): (&[u16], &[u16]) = (&[0xd800], &[0xd801]);
    let obj = bytes(&[
        &wide("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl "),
        one,
        &wide("\nf 1 2 3\nusemtl "),
        other,
        &wide("\nf 1 2 3\n"),
    ]);
    let library = bytes(&[&wide("newmtl "), one, &wide("\nKd 1 0 0\nnewmtl "), other, &wide("\nKd 0 0 1\n")]);
    assert_eq!(colors(&obj, &[(b"a.mtl", &library)]), [RED, BLUE]);
}

/// Catches a text that is one line where its lines end in CR alone, in either file, and a wrong line in an error.
#[test]
fn lines_end_in_lf_cr_lf_or_cr() {
    let obj = red_and_blue("mtllib a.mtl");
    let library = String::from_utf8_lossy(LIBRARY);
    for end in ["\n", "\r\n", "\r"] {
        for other in ["\n", "\r\n", "\r"] {
            let (obj, library) = (obj.replace('\n', end), library.replace('\n', other));
            assert_eq!(
                colors(obj.as_bytes(), &[(b"a.mtl", library.as_bytes())]),
                [RED, BLUE],
                "{end:?} {other:?}"
            );
        }
        let wrong = format!("{CORNERS}\nf 1 2 x\n").replace('\n', end);
        let error = load(wrong.as_bytes(), &[]).expect_err("no corner").to_string();
        assert!(error.contains("mesh.obj:5: "), "{error}");
    }
    assert_eq!(triangles(b"v 0 0 0\r\nv 1 0 0\rv 0 1 0\nf\x0b1 2\x0c3\t\r\r\n").len(), 1);
}

/// Catches comments that swallow the next line, continued lines that are not joined, wherever the backslash
/// stands, and names whose last letter is one and that swallow what follows.
#[test]
fn a_backslash_joins_lines_only_where_a_statement_goes_on() {
    for text in [
        "# C:\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 9 9 9\n",
        "  # a \\\r\nv 0 0 0\nv 1 0 0 # b\\\nv 0 1 0\nf 1 2 3# c \\\nv 9 9 9\n",
        "v 0 0\\\n0\nv 1\\\n\t0 \\\n0\nv 0 1 0\nf 1\\\n2 3\n",
        "v 0 0 \\ \r\n0\r\nv 1 \\\r 0 0\rv 0 1 0\rf 1 \\\r\n2 \\\n3\\\n",
        "v 0 0 0\\\nv 1 0 0\\\n\nv 0 1 0\nf 1 2 3 \\\n# end\n",
        "g C:\\\nv 0 0 0\no a\\\nv 1 0 0\nv 0 1 0\nusemtl b\\\nf 1 2 3\nmtllib C:\\\n\n",
        "g one \\\n two\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
    ] {
        let triangles = triangles(text.as_bytes());
        assert_eq!(triangles.len(), 1, "{text:?}");
        assert_eq!(triangles[0].vertices, [DVec3::ZERO, DVec3::X, DVec3::Y], "{text:?}");
    }
    let obj =
        format!("mtllib a.mtl \\\n b.mtl\n{CORNERS}usemtl a\\\nf 1 2 3\nusemtl the \\\n  blue\nf 1 2 3\n");
    let files: &[(&[u8], &[u8])] =
        &[(b"a.mtl", b"newmtl a\\\nKd 1 0 0\n"), (b"b.mtl", b"newmtl the blue\nKd 0 0 \\\n1\n")];
    assert_eq!(colors(obj.as_bytes(), files), [RED, BLUE]);
}

/// Catches fans that reach out of polygons that are not convex, triangles that are wound the other way than
/// their polygon, and corners that lose their normals: a polygon keeps its area, each of its triangles is wound
/// as it is, and none lies beyond it; in every turn, seen from either side, and in planes of every slant.
#[test]
fn polygons_are_cut_right() {
    let dart = vec![[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]];
    let comb = vec![
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [3.0, 2.0],
        [3.0, 3.0],
        [1.0, 3.0],
        [1.0, 4.0],
        [3.0, 4.0],
        [3.0, 5.0],
        [0.0, 5.0],
    ];
    // A hole, to which a line leads and from which it leads back.
    let ring = vec![
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    let star: Vec<[f64; 2]> = (0..50)
        .map(|corner| {
            let (sin, cos) = (f64::from(corner) * std::f64::consts::TAU / 50.0).sin_cos();
            let radius = if corner % 2 == 0 { 3.0 } else { 0.4 };
            [radius * cos, radius * sin]
        })
        .collect();
    let mut random = fastrand::Rng::with_seed(5);
    for polygon in [dart, comb, ring, star] {
        let count = polygon.len();
        let doubled_area: f64 = (0..count)
            .map(|corner| {
                let ([a, b], [c, d]) = (polygon[corner], polygon[(corner + 1) % count]);
                a * d - b * c
            })
            .sum();
        for turn in 0..2 * count {
            let axis = DVec3::new(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5).normalize();
            let u = axis.any_orthonormal_vector();
            let v = axis.cross(u);
            let mut corners: Vec<usize> = (0..count).map(|corner| (corner + turn) % count).collect();
            let wound = if turn >= count { -1.0 } else { 1.0 };
            if turn >= count {
                corners.reverse();
            }
            let mut obj = String::new();
            for [x, y] in &polygon {
                let at = u * *x + v * *y + 40.0 * axis;
                obj += &format!("v {} {} {}\nvn {} {} {}\n", at.x, at.y, at.z, at.x, at.y, at.z);
            }
            let words: Vec<String> = corners.iter().map(|corner| format!("{0}//{0}", corner + 1)).collect();
            // Going round more than once makes no other polygon.
            let rounds: u8 = if turn % 3 == 0 { 2 } else { 1 };
            obj += &format!("f {}\n", vec![words.join(" "); rounds.into()].join(" "));
            let triangles = triangles(obj.as_bytes());
            let normal = wound * axis;
            let area = |of: &Triangle| {
                let [a, b, c] = of.vertices;
                (b - a).cross(c - a).dot(normal)
            };
            assert!(triangles.iter().all(|of| area(of) > -1e-4), "turn {turn} of {count} corners");
            let sum: f64 = triangles.iter().map(area).sum();
            let expected = doubled_area.abs();
            let times = (sum / expected).round().max(1.0);
            assert!((sum - times * expected).abs() < 1e-3 * sum, "turn {turn} of {count} corners: {sum}");
            assert!(times <= f64::from(rounds), "turn {turn} of {count} corners");
            for (vertex, own) in
                triangles.iter().flat_map(|of| of.vertices.into_iter().zip(of.normals.expect("normals")))
            {
                assert!((vertex.normalize() - own.as_dvec3()).length() < 1e-5, "{vertex} has {own}");
            }
        }
    }
}

/// Catches a warped quadrilateral that is cut along the diagonal that folds it over.
#[test]
fn polygons_that_are_not_flat_are_cut_along_the_fitting_diagonal() {
    let own = triangles(b"v 0 0 0\nv 2 0 0.3\nv 2 2 0\nv 0 2 0.3\nf 1 2 3 4\n");
    assert_eq!(own.len(), 2);
    let dart = triangles(b"v 0 0 0\nv 2 1 0.1\nv 0 2 0\nv 0.5 1 0.2\nf 1 2 3 4\nf 4 3 2 1\n");
    assert_eq!(dart.len(), 4);
    for (number, triangle) in dart.iter().enumerate() {
        let [a, b, c] = triangle.vertices;
        assert!((b - a).cross(c - a).z * if number < 2 { 1.0 } else { -1.0 } > 0.1, "{triangle:?}");
    }
}

/// Catches a whole mesh that is refused for normals without a direction or for faces of two corners, indices
/// that are off by one behind them, and normals at the limits of f64 that are taken for none.
#[test]
fn unusable_normals_and_short_faces_are_left_out() {
    for bad in
        ["nan nan nan", "-nan(ind) -nan(ind) -nan(ind)", "0 0 0", "-0 0 0", "inf 0 0", "1 2", "", "1e999 0 0"]
    {
        let obj = format!(
            "{CORNERS}vt nan inf\nvn {bad}\nvn 1 0 0\nf 1/1/1 2//1 3//1\nf 1 2\nf 2\nf\nf 1//2 2//2 3//2\n"
        );
        let triangles = triangles(obj.as_bytes());
        let normals: Vec<_> = triangles.iter().map(|of| of.normals.expect("normals")).collect();
        assert_eq!(normals, [[Vec3::Z; 3], [Vec3::X; 3]], "{bad}");
    }
    for good in ["0 1e300 0", "0 1e-300 0", "0 5e-324 0", "0 1e10 0"] {
        let obj = format!("{CORNERS}vn {good}\nf 1//1 2//1 3//1\n");
        assert_eq!(triangles(obj.as_bytes())[0].normals, Some([Vec3::Y; 3]), "{good}");
    }
}

/// Catches files that are no OBJ and are blamed for having no faces; and advice that does not fit.
#[test]
fn what_is_no_obj_is_called_what_it_is() {
    let mut stl = vec![b' '; 80];
    stl.extend([1, 0, 0, 0]);
    stl.extend([0; 50]);
    for (bytes, part) in [
        (&b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 9\n"[..], "git lfs pull"),
        (b"\n  <!DOCTYPE html>\n<html>v 1 2 3</html>\n", "web page"),
        (b"\xef\xbb\xbf<html>\nf you\n", "web page"),
        (b"\x1f\x8b\x08\x00", "gzip"),
        (b"PK\x03\x04....", "zip"),
        (b"ply\nformat ascii 1.0\n", "PLY"),
        (b"solid a\nfacet normal 0 0 1\n", "STL"),
        (b"glTF\x02\0\0\0", "glTF"),
        (b"{\"asset\":{}}", "glTF"),
        (b"\x7fELF\x02\x01\x01\0v 1", "object file"),
        (b"\x64\x86\x02\0\0\0\0\0\nf 9", "object file"),
        (&stl, "binary"),
        (b"", "empty"),
        (b" \r\n", "empty"),
        (b"\xff\xfe", "empty"),
        (b"hello\nworld\n", "without a line of OBJ"),
    ] {
        let error = load(bytes, &[]).expect_err("no OBJ").to_string();
        assert!(
            error.contains("this is not an OBJ file, it is") && error.contains(part),
            "'{error}' lacks '{part}'"
        );
        assert!(!error.contains('\n') && error.contains("mesh.obj: "), "{error}");
    }
}

/// Catches OBJ texts that are taken for something else: half letters, noise behind the text, and comments that
/// name other formats.
#[test]
fn what_is_obj_is_read() {
    let text = format!("# solid <a> {{b}} version https://git-lfs\n{CORNERS}f 1 2 3\n");
    for end in [&b""[..], b"\x1a", b"\n\x1a\n", b"\xff\xfe\n", b"#"] {
        assert_eq!(triangles(&[text.as_bytes(), end].concat()).len(), 1);
    }
}

/// Catches a triangle of a scene file that is kept where one of a mesh would be left out.
#[test]
fn one_rule_tells_which_triangles_have_an_area() {
    let head = HEAD.split("[[mesh]]").next().expect("a head");
    for (size, has_area) in [(1e-9, true), (1e-10, false), (1e-20, false), (0.0, false)] {
        let obj = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 4 5\n");
        assert_eq!(triangles(obj.as_bytes()).len() == 2, has_area, "{size}");
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.toml");
        let toml = format!(
            "{head}[emissive.m]\nradiance = 1\n[[triangle]]\nvertices = [[0, 0, 0], [{size:?}, 0, 0], [0, {size:?}, 0]]\nmaterial = \"m\"\n"
        );
        std::fs::write(&path, toml).expect("a writable folder");
        assert_eq!(scene::load(path.to_str().expect("a plain path")).is_ok(), has_area, "{size}");
    }
}
