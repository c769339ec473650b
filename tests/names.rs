//! Files whose names are no text, or look like options: read, written, and found again.
#![cfg(unix)]

mod common;

use common::{Run, decode_png, run, thinlens};
use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use thinlens::output::{self, Origin};
use thinlens::scene::{self, SceneRef};
use thinlens::settings::{Settings, quoted};

const HOUSE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const SMALL: [&str; 4] = ["-s", "24x18", "-n", "2"];

/// A name of Latin-1, which is not UTF-8.
fn latin1(name: &[u8]) -> OsString {
    OsStr::from_bytes(name).to_os_string()
}

/// Renders without a word, and gives the pixels.
fn render(folder: &Path, arguments: &[&OsStr], output: &OsStr) -> Vec<[u8; 3]> {
    let run = thinlens(folder).args(["render", "-q", "-o"]).arg(output).args(arguments).output();
    let run: Run = run.expect("it starts").into();
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
    decode_png(&std::fs::read(folder.join(output)).expect("a picture")).1
}

/// A picture, half of it white, as an aperture.
fn write_aperture(path: &Path, columns: &[u8]) {
    let file = std::fs::File::create(path).expect("a file");
    let mut encoder = png::Encoder::new(file, columns.len() as u32, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().expect("a header").write_image_data(columns).expect("pixels");
}

/// Catches a name that is kept as other letters, so that a picture is not rendered again, or with another file.
#[test]
fn a_name_that_is_no_text_is_found_again() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let deep = latin1(b"dossi\xe9");
    std::fs::create_dir(folder.join(&deep)).expect("a folder");
    let mesh = Path::new(&deep).join(latin1(b"caf\xe9.obj"));
    let image = Path::new(&deep).join(latin1(b"m\xe9.png"));
    std::fs::write(folder.join(&mesh), HOUSE).expect("a mesh");
    write_aperture(&folder.join(&image), &[255, 255, 0, 0]);
    // What these names become where they are taken for text.
    std::fs::create_dir(folder.join(deep.to_string_lossy().as_ref())).expect("a folder");
    std::fs::write(folder.join(mesh.to_string_lossy().as_ref()), "nonsense").expect("a file");
    write_aperture(&folder.join(image.to_string_lossy().as_ref()), &[0, 0, 255]);

    let mut option = OsString::from("--aperture-image=");
    option.push(&image);
    let small = SMALL.map(OsStr::new);
    let arguments = [&[mesh.as_os_str(), &option], &small[..]].concat();
    for output in [latin1(b"a\xe9.png"), Path::new(&deep).join("here.png").into()] {
        let first = render(folder, &arguments, &output);
        let origin = Origin::read(&folder.join(&output)).expect("how it was made");
        assert!(origin.arguments[0] == mesh.as_os_str() && origin.arguments.contains(&option), "{origin:?}");
        let again = render(folder, &[OsStr::new("--from"), &output], OsStr::new("again.png"));
        assert!(first == again, "another picture comes of {}", output.display());
    }
}

/// Catches a scene that names another file than the one it was saved with.
#[test]
fn a_scene_file_names_no_other_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &[u8]| folder.path().join(latin1(name));
    std::fs::write(path(b"caf\xe9.obj"), HOUSE).expect("a mesh");
    write_aperture(&path(b"m\xe9.png"), &[255, 0]);
    let settings = |scene: &Path| Settings::of_scene(SceneRef::new(scene::load(scene).expect("a scene")));
    let mesh = settings(&path(b"caf\xe9.obj"));
    let mut image = settings(Path::new("suffern-boxes"));
    image.estimator.aperture.image =
        Some(scene::ApertureImage::read(&path(b"m\xe9.png")).expect("an aperture"));
    for settings in [mesh, image] {
        let error = output::save_scene(&settings, &path(b"a.toml")).expect_err("no text").to_string();
        assert!(error.contains(r"\xe9") && error.contains("rename the file"), "{error}");
        assert!(!path(b"a.toml").exists());
    }
    // The scene's own name is nowhere in it.
    output::save_scene(&settings(Path::new("suffern-boxes")), &path(b"sc\xe8ne.toml")).expect("a scene");
    let saved = settings(&path(b"sc\xe8ne.toml"));
    output::save_scene(&saved, &path(b"b.toml")).expect("a scene");
}

/// Catches names with a dash in front that a picture's own arguments take for options.
#[test]
fn a_name_with_a_dash_is_no_option() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    std::fs::write(folder.join("-house.obj"), HOUSE).expect("a mesh");
    write_aperture(&folder.join("-mask.png"), &[255, 255, 0]);
    let words = |words: &[&str]| words.iter().map(OsString::from).collect::<Vec<_>>();
    let mut pictures = Vec::new();
    for arguments in [
        words(&["-s", "24x18", "-n", "2", "--aperture-image=-mask.png", "--", "-house.obj"]),
        words(&["-s", "24x18", "-n", "2", "--aperture-image", "./-mask.png", "./-house.obj"]),
    ] {
        let arguments: Vec<&OsStr> = arguments.iter().map(OsString::as_os_str).collect();
        pictures.push(render(folder, &arguments, OsStr::new("a.png")));
        pictures.push(render(folder, &["--from", "a.png"].map(OsStr::new), OsStr::new("b.png")));
    }
    pictures.dedup();
    assert_eq!(pictures.len(), 1);
    for arguments in [&["render", "-o", "-other.png"][..], &["render", "-xyz.obj", "-o", "c.png"]] {
        let run = run(folder, arguments);
        assert_eq!(run.code, 2, "{}", run.stderr);
        assert!(run.stderr.contains("is written ./-"), "{}", run.stderr);
    }
    let help = run(folder, &["render", "--help"]);
    assert!(!help.stdout.contains("is written ./"), "{}", help.stdout);
}

/// Catches a word that a shell takes for another one.
#[test]
fn a_word_comes_through_a_shell() {
    for word in [
        &b"plain-1.5"[..],
        b"",
        b"with space",
        b"it's",
        b"$HOME `x` \"y\" \\",
        b"caf\xe9.obj",
        b"caf\xe9a1' \\ \n \xc3\xa9",
        b"tab\there",
        b"~",
    ] {
        let word = latin1(word);
        let line = format!("printf %s {}", quoted(&word));
        let echoed = std::process::Command::new("bash").args(["-c", &line]).output().expect("bash");
        assert_eq!(OsStr::from_bytes(&echoed.stdout), word, "{line}");
        assert!(!line.contains('\n'), "{line} is two lines");
    }
}

/// Catches pictures of before, whose arguments are strings alone, that are not read any more.
#[test]
fn arguments_that_are_strings_are_read() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("old.png");
    let file = std::fs::File::create(&path).expect("a file");
    let mut encoder = png::Encoder::new(file, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    let text = r#"{"version":"0.1.0","arguments":["suffern-boxes","--size=24x18","--samples=2"]}"#;
    encoder.add_text_chunk("thinlens".into(), text.into()).expect("text");
    encoder.write_header().expect("a header").write_image_data(&[0; 3]).expect("a pixel");
    let origin = Origin::read(&path).expect("how it was made");
    assert_eq!(origin.arguments, ["suffern-boxes", "--size=24x18", "--samples=2"]);
}

/// Catches a panic where the program itself has such a name, and advice that cannot be followed.
#[test]
fn the_program_may_have_any_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let program = folder.join(latin1(b"thin l\xe9ns"));
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_thinlens"), &program).expect("a link");
    std::fs::write(folder.join("-my house.obj"), HOUSE).expect("a mesh");
    let mut command = std::process::Command::new(&program);
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(variable);
    }
    command.current_dir(folder).args(["view", "--size", "24x18", "-n", "1", "--", "-my house.obj"]);
    let run: Run = command.output().expect("it starts").into();
    assert_eq!(run.code, 0, "{}", run.stderr);
    let next = run.stdout.lines().find_map(|line| line.strip_prefix("next, try: ")).expect("advice");
    let tried = std::process::Command::new("bash").args(["-c", next]).current_dir(folder).output();
    let tried: Run = tried.expect("bash").into();
    assert_eq!(tried.code, 0, "{next}: {}", tried.stderr);
    assert!(folder.join("pinhole.png").exists());
}
