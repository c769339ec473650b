//! The words that wrong scene files are refused with: those of the format, with the line.

use std::path::Path;
use thinlens::error::Error;
use thinlens::scene;

const SCENE: &str = "\
[camera]
eye = [0, 0, 0]
look_at = [0, 0, -1]
vfov_degrees = 60
lens_diameter = 0.1
focal_distance = 5
[matte.red]
ka = 0.5
kd = 0.5
color = [1, 0, 0]
[[sphere]]
center = [0, 0, -5]
radius = 1
material = \"red\"
";

/// A word of the crates that read files, which means nothing to who writes scenes.
const FOREIGN: [&str; 9] =
    ["sequence", "map", "field", "struct", "expected", "mantissa", "f64", "invalid type", "duplicate"];

fn load(bytes: &[u8]) -> Result<scene::Scene, Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("test.toml");
    std::fs::write(&path, bytes).expect("a writable temporary folder");
    scene::load(&path)
}

/// Replaces a part of the scene, and gives the line and the words of the error.
fn refused(old: &str, new: &str) -> (usize, String) {
    assert!(SCENE.contains(old), "{old}");
    match load(SCENE.replacen(old, new, 1).as_bytes()).err() {
        Some(Error::Scene { line, message, .. }) => (line, message),
        other => panic!("{new}: {other:?}"),
    }
}

/// Catches tables that are written in another form than their kind's, and are refused at another line, in words
/// that do not say what to write; or are read as something else.
#[test]
fn a_table_of_another_form_is_told_how_to_be_written() {
    for (old, new, line, part) in [
        ("[[sphere]]", "[sphere]", 11, "write [[sphere]], with two pairs"),
        ("[[sphere]]", "[sphere.one]", 11, "write [[sphere]], with two pairs"),
        ("[[sphere]]", "[[spheres]]", 11, "did you mean [[sphere]]"),
        ("[[sphere]]", "[[Sphere]]", 11, "did you mean [[sphere]]"),
        ("[[sphere]]", "[[scene.sphere]]", 11, "write [[sphere]]"),
        ("[[sphere]]", "[[cone]]", 11, "[[sphere]], [[box]]"),
        ("[[sphere]]", "[sphere]\nradius = 1\n[sphere]", 13, "write [[sphere]]"),
        ("[[sphere]]", "[[sphere]]\nradius = 1\n[sphere]", 13, "write [[sphere]]"),
        ("[camera]", "[[camera]]", 1, "write [camera], with one pair"),
        ("[camera]", "[Camera]", 1, "did you mean [camera]"),
        ("[camera]", "[scene.camera]", 1, "write [camera]"),
        ("[camera]", "ambient = 0.4\n[camera]", 1, "write [ambient]"),
        ("[camera]", "sphere = 5\n[camera]", 1, "write [[sphere]]"),
        ("[camera]", "sphere = [[[0, 0, -5], 1, \"red\"]]\n[camera]", 1, "write [[sphere]]"),
        ("[camera]", "view = [1]\n[camera]", 1, "write [view]"),
        ("[matte.red]", "[matte]", 7, "write [matte.NAME]"),
        ("[matte.red]", "[[matte]]\nname = \"red\"", 7, "write [matte.NAME]"),
        ("[matte.red]", "[[matte.red]]", 7, "write [matte.red]"),
        ("[matte.red]", "[material.red]", 7, "did you mean [matte.NAME]"),
        ("color = [1, 0, 0]", "color = [[1, 1, 1], [0, 0, 0], 1]", 10, "{ even = [r, g, b]"),
        ("[camera]", "[size]\n[camera]", 1, "size must be [width, height]"),
    ] {
        let (at, message) = refused(old, new);
        assert!(at == line && message.contains(part), "{new}: line {at}: {message}");
    }
}

/// Catches the words of serde and of the TOML crate, and a line that is not the mistake's.
#[test]
fn a_wrong_value_is_told_what_is_right() {
    for (old, new, line, part) in [
        ("[0, 0, -5]", "[0, 0]", 12, "center must be three numbers, [x, y, z]; here is a list of 2"),
        ("[0, 0, -5]", "\"here\"", 12, "here is the text \"here\""),
        ("[0, 0, -5]", "{ x = 1 }", 12, "three numbers"),
        ("[0, 0, -5]", "[0, 0, .5]", 12, "'.5' is not a number; one is written like 0.5"),
        ("[0, 0, -5]", "[0, 0, 5.]", 12, "'5.' is not a number"),
        ("[0, 0, -5]", "[0, 0, 1e]", 12, "'1e' is not a number"),
        ("[0, 0, -5]", "[0 0 -5]", 12, "a comma is missing"),
        ("[0, 0, -5]", "", 12, "a value is missing"),
        ("[0, 0, -5]", "[0, 0, 1e999]", 12, "three numbers"),
        ("radius = 1", "radius = \"1\"", 13, "radius must be a number; here is the text \"1\""),
        ("radius = 1", "radius = true", 13, "here is true"),
        ("radius = 1", "radius = 1m", 13, "'1m' is not a number"),
        ("radius = 1", "radius: 1", 13, "a key, = and its value"),
        ("radius = 1", "// no comment", 13, "a comment after #"),
        ("radius = 1", "radius = 1\nradius = 2", 14, "'radius' is here for the second time"),
        ("radius = 1\n", "", 11, "[[sphere]] needs radius, a number"),
        ("radius = 1", "Radius = 1", 13, "did you mean radius"),
        ("radius = 1", "colour = 1", 13, "it has: center, radius"),
        ("\"red\"", "red", 14, "a name stands in quotes: \"red\""),
        ("\"red\"", "5", 14, "material must be a name in quotes"),
        ("color = [1, 0, 0]", "color = \"red\"", 10, "[r, g, b]"),
        ("color = [1, 0, 0]\n", "", 7, "[matte.red] needs color"),
        (
            "[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]",
            "[metal.red]\ncolor = \"tin\"",
            8,
            "color is 'tin', which is not known; there are: aluminium, chromium",
        ),
        ("[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]", "[metal.red]", 7, "color, a name such as"),
        (
            "[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]",
            "[metal.red]\ncolor = 1",
            8,
            "such as \"gold\"",
        ),
        ("[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]", "[plastic.red]", 7, "color, [r, g, b], or"),
        (
            "[matte.red]\nka = 0.5\nkd = 0.5\ncolor = [1, 0, 0]",
            "[standard.red]\ncolor = [1, 0, 0]\nmetallic = 2",
            9,
            "metallic is",
        ),
        ("vfov_degrees = 60", "blades = 6.5", 4, "blades must be a whole number"),
        ("vfov_degrees = 60", "upright = 1", 4, "upright must be true or false"),
        ("vfov_degrees = 60", "upright = True", 4, "true or false"),
        ("[matte.red]", "[matte.röt]", 7, "stands in quotes, as in"),
        ("focal_distance = 5\n", "", 1, "[camera] needs focal_distance"),
        ("[camera]", "size = [1.5, 2]\n[camera]", 1, "size must be [width, height]"),
        (
            "[[sphere]]",
            "[[triangle]]\nvertices = [1, 2, 3]\nmaterial = \"red\"\n[[sphere]]",
            12,
            "three corners",
        ),
    ] {
        let (at, message) = refused(old, new);
        assert!(at == line && message.contains(part), "{new}: line {at}: {message}");
        for word in FOREIGN {
            assert!(!message.contains(word), "{new}: '{message}' says '{word}'");
        }
    }
}

/// Catches a nesting without end that is blamed on line 1, or ends the program.
#[test]
fn a_nesting_too_deep_has_its_line() {
    let dots = format!("{SCENE}a{} = 1\n", ".a".repeat(1000));
    let lists = format!("{SCENE}a = {}{}\n", "[".repeat(100_000), "]".repeat(100_000));
    for text in [dots, lists] {
        match load(text.as_bytes()) {
            Err(Error::Scene { line, message, .. }) => {
                assert!(line == 15 && message.contains("nested too deep"), "line {line}: {message}");
            }
            other => panic!("{other:?}"),
        }
    }
}

/// A text as UTF-16.
fn utf16(text: &str, unit: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(unit).collect()
}

/// Catches files of Windows' editors and shells that are refused, or lose a letter; and encodings that are refused
/// with the advice to check permissions.
#[test]
fn text_is_read_in_the_encodings_that_can_be_told() {
    let named = SCENE.replace("\"red\"", "\"röt\u{1f600}\"").replace(".red]", ".\"röt\u{1f600}\"]");
    let marked = format!("\u{feff}{named}");
    for (bytes, what) in [
        (named.as_bytes().to_vec(), "UTF-8"),
        (marked.as_bytes().to_vec(), "UTF-8 with a mark"),
        (named.replace('\n', "\r\n").into_bytes(), "line ends of Windows"),
        (utf16(&marked, u16::to_le_bytes), "UTF-16, little endian"),
        (utf16(&marked, u16::to_be_bytes), "UTF-16, big endian"),
        (utf16(&named, u16::to_le_bytes), "UTF-16, little endian, without a mark"),
        (utf16(&named, u16::to_be_bytes), "UTF-16, big endian, without a mark"),
    ] {
        let scene = load(&bytes).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_eq!(scene.material_names, ["röt\u{1f600}"], "{what}");
    }
    let latin1 = SCENE.bytes().chain(*b"# caf\xe9\n").collect();
    let half = utf16(&marked, u16::to_le_bytes)[1..].to_vec();
    let mut cut = utf16(&marked, u16::to_le_bytes);
    cut.pop();
    let utf32 = marked.chars().flat_map(|letter| u32::from(letter).to_le_bytes()).collect();
    for (bytes, line, part) in [
        (latin1, 15, "0xe9, é in Latin-1"),
        (half, 1, "not UTF-8"),
        (cut, 14, "UTF-16"),
        (utf32, 1, "UTF-32"),
    ] {
        let bytes: Vec<u8> = bytes;
        match load(&bytes) {
            Err(Error::Scene { line: at, message, .. }) => {
                assert!(at == line && message.contains(part), "line {at}: {message}");
            }
            other => panic!("{part}: {other:?}"),
        }
    }
}

/// Catches a format that has grown a table or a key of which these words do not know: each that is offered in a
/// message must have its own form.
#[test]
fn every_key_that_is_offered_is_known() {
    let (_, top) = refused("[[sphere]]", "[[cone]]");
    let tables = top.split("there are: ").nth(1).expect("a list");
    for table in tables.split(", ").filter(|table| table.starts_with('[')) {
        let named = table.replace("NAME", "some");
        let (_, message) = refused("[camera]", &format!("{named}\nnonsense = 1\n[camera]"));
        assert!(
            message.contains("has no key nonsense") || message.contains("second time"),
            "{table}: {message}"
        );
    }
}

/// Catches a scene that is read though its name says nothing of what it is, and one in capitals that is not.
#[test]
fn the_ending_decides_in_capitals_too() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("SCENE.TOML");
    std::fs::write(&path, SCENE).expect("a writable temporary folder");
    scene::load(&path).expect("a scene");
    let error = scene::load(Path::new("scene.txt")).expect_err("no scene").to_string();
    assert!(error.contains("no scene 'scene.txt'"), "{error}");
    let path = folder.path().join("photo.jpg");
    std::fs::write(&path, SCENE).expect("a writable temporary folder");
    let error = scene::load(&path).expect_err("no scene").to_string();
    assert!(error.contains("photo.jpg: a scene is a .toml file") && !error.contains("no scene"), "{error}");
}
