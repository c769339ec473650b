//! The viewer under Xvfb, while something is made ready or breaks: it goes on with what it has.

mod common;

use common::viewer::Viewer;
use common::viewer::log::said;
use common::{Run, thinlens};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use thinlens::app::telemetry;

const SIZE: [u16; 2] = [640, 480];
const PATIENCE: Duration = Duration::from_secs(120);
/// Loses the device at so many submissions, for tests.
const LOSE_AT: &str = "THINLENS_TEST_LOSE_DEVICE_AT";

/// A rough sheet of twice `side` times `side` triangles.
fn sheet(folder: &Path, side: u32) -> PathBuf {
    let mut obj = String::new();
    for (x, y) in (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y))) {
        let height = (x * 7 + y * 13) % 11;
        writeln!(obj, "v {x} {} {y}", f64::from(height) / 5.0).expect("a string");
    }
    let row = side + 1;
    for corner in (0..side).flat_map(|y| (0..side).map(move |x| y * row + x + 1)) {
        writeln!(
            obj,
            "f {corner} {} {}\nf {} {} {}",
            corner + 1,
            corner + row,
            corner + 1,
            corner + row + 1,
            corner + row
        )
        .expect("a string");
    }
    let path = folder.join("sheet.obj");
    std::fs::write(&path, obj).expect("a writable folder");
    path
}

/// A viewer of a mesh that takes long to prepare, because no compiled passes are kept yet.
fn cold_viewer(folder: &Path) -> Viewer {
    sheet(folder, 500);
    let cache = folder.to_str().expect("a plain path");
    let arguments = ["sheet.obj", "--size", "640x480", "--validation", "-n", "2"];
    Viewer::start_with(folder, SIZE, &arguments, &[("XDG_CACHE_HOME", cache)])
}

/// Catches a window that comes only with its first picture, and changes that are lost in the meantime.
#[test]
fn the_panel_comes_before_the_picture() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let viewer = cold_viewer(folder.path());
    // The panel is there. The passes are compiled after the tree of the mesh is built.
    viewer.frames_until(&format!("{} trace", telemetry::COMPILING));
    let before = viewer.state.borrow()[0];
    viewer.drag("Lens diameter", &[0.5, 0.4, 0.3], |viewer| viewer.state.borrow()[0] != before);
    viewer.wait_until_done();
    let diameter = viewer.state.borrow()[0].to_string();
    let mesh = folder.path().join("sheet.obj");
    let mesh = mesh.to_str().expect("a plain path");
    viewer.expect_picture("the picture", 0, &[mesh, "-n", "2", "--lens-diameter", &diameter]);
    viewer.close();
}

/// Catches a window that stays open until the loader has ended its step.
#[test]
fn the_window_closes_before_the_loader_ends() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let log = cold_viewer(folder.path()).close();
    let place = |what: &str| log.iter().position(|line| said(line, what).is_some());
    let closed = place(telemetry::CLOSED).expect("it closes");
    let compiles = place(&format!("{} trace", telemetry::COMPILING)).expect("it was still preparing");
    assert!(closed < compiles, "{log:#?}");
}

/// Catches a window that stands still while a mesh is loaded: until it is shown, frames come and the camera follows
/// the hand. And one that shows the mesh under the last scene's camera.
#[test]
fn a_mesh_is_loaded_while_the_window_goes_on() {
    let viewer = Viewer::start(SIZE, &["suffern-boxes", "-n", "2"]);
    viewer.wait_until_done();
    let mesh = sheet(&viewer.folder, 300);
    viewer.drop_file(&mesh);
    viewer.frames_until(telemetry::LOADING);
    viewer.xdotool("mousemove 500 300 mousedown 1");
    let (mut frames, mut cameras, mut step) = (0, 0, 0);
    let deadline = Instant::now() + PATIENCE;
    loop {
        assert!(Instant::now() < deadline, "it is never shown; {frames} frames");
        step += 1;
        viewer.xdotool(&format!("mousemove {} 300", 500 - step % 50));
        let lines: Vec<String> = std::iter::from_fn(|| viewer.listen(Duration::from_millis(1))).collect();
        let loaded = lines.iter().position(|line| said(line, telemetry::LOADED).is_some());
        for line in &lines[..loaded.unwrap_or(lines.len())] {
            frames += usize::from(said(line, telemetry::FRAME).is_some());
            cameras += usize::from(said(line, telemetry::CAMERA).is_some());
        }
        if loaded.is_some() {
            break;
        }
    }
    viewer.xdotool("mouseup 1 mousemove 630 470");
    println!("{frames} frames and {cameras} places of the camera while it was loaded");
    assert!(frames >= 5 && cameras >= 3, "{frames} frames, {cameras} places of the camera");
    viewer.press("Home");
    viewer.wait_until_done();
    viewer.expect_picture("the mesh", 0, &[mesh.to_str().expect("a plain path"), "-n", "2"]);
    viewer.close();
}

/// Catches a scene that comes late and takes the place of one that was asked for after it; and a viewer that cannot
/// be closed while it loads.
#[test]
fn the_newest_of_two_scenes_is_shown() {
    let viewer = Viewer::start(SIZE, &["suffern-boxes", "-n", "2"]);
    viewer.wait_until_done();
    let mesh = sheet(&viewer.folder, 300);
    let small = viewer.folder.join("small.toml");
    let text = "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nvfov_degrees = 40\nlens_diameter = 0.1\nfocal_distance = 5\n\
                [background]\ncolor = [0.1, 0.4, 0.2]\n";
    std::fs::write(&small, text).expect("a writable folder");
    viewer.drop_file(&mesh);
    viewer.frames_until(telemetry::LOADING);
    viewer.drop_file(&small);
    let deadline = Instant::now() + PATIENCE;
    let mut loaded = Vec::new();
    while loaded.is_empty() {
        assert!(Instant::now() < deadline, "nothing is shown");
        let line = viewer.listen(Duration::from_millis(20)).unwrap_or_default();
        loaded.extend(said(&line, telemetry::LOADED).map(str::to_owned));
    }
    assert!(loaded[0].ends_with("small.toml"), "{loaded:?}");
    viewer.wait_until_done();
    viewer.expect_picture("the small scene", 0, &[small.to_str().expect("a plain path"), "-n", "2"]);
    viewer.drop_file(&mesh);
    viewer.frames_until(telemetry::LOADING);
    viewer.close();
}

/// Catches a slider of the shutter that compiles passes anew, and a tree that does not follow it.
#[test]
fn the_shutter_compiles_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let text = "[camera]\neye = [0, 1, 6]\nlook_at = [0, 0.5, 0]\nvfov_degrees = 50\nlens_diameter = 0.2\n\
                focal_distance = 6\nshutter = 0.1\n[background]\ncolor = [0.2, 0.3, 0.5]\n[ambient]\nradiance = 1\n\
                [matte.m]\nka = 0.8\nkd = 0\ncolor = [1, 0.9, 0.2]\n[[sphere]]\ncenter = [0, 0.5, 0]\nradius = 0.5\n\
                material = \"m\"\nvelocity = [3, 0, 0]\n";
    std::fs::write(folder.path().join("moving.toml"), text).expect("a writable folder");
    let viewer = Viewer::start_in(
        folder.path(),
        [640, 800],
        &["moving.toml", "--size", "640x800", "--validation", "-n", "4"],
    );
    viewer.wait_until_done();
    viewer.click("Light", |viewer| viewer.controls.borrow().contains_key("Shutter"));
    viewer.wait_until_done();
    let before = viewer.picture();
    let compiled = std::cell::Cell::new(0);
    let [x, y, width, height] = viewer.controls.borrow()["Shutter"];
    viewer.point([x + width / 2, y + height / 2]);
    viewer.hands("mousedown 1", 1);
    for share in [52, 56, 60, 64] {
        viewer.xdotool(&format!("mousemove {} {}", x + width * share / 100, y + height / 2));
        while let Some(line) = viewer.listen(Duration::from_millis(50)) {
            compiled.set(compiled.get() + usize::from(said(&line, telemetry::COMPILING).is_some()));
        }
    }
    viewer.hands("mouseup 1", 0);
    viewer.point_away();
    viewer.wait_until_done();
    assert_eq!(compiled.get(), 0, "passes are compiled");
    assert!(viewer.picture() != before, "the shutter does nothing");
    viewer.press("ctrl+c");
    viewer.wait_for("the command line", |viewer| viewer.copied.borrow().is_some());
    let copied = viewer.copied.borrow().clone().expect("a line");
    let options: Vec<&str> = copied.split(' ').skip(2).take_while(|word| *word != "-o").collect();
    let without_size: Vec<&str> = options
        .iter()
        .copied()
        .filter(|word| !word.starts_with("--size") && *word != "moving.toml")
        .collect();
    let scene = folder.path().join("moving.toml");
    let scene = scene.to_str().expect("a plain path");
    viewer.expect_picture("the longer shutter", 0, &[&[scene], &without_size[..]].concat());
    viewer.close();
}

/// Catches a viewer that ends with its device, one that does not say what ran, and a picture that is not what it was.
#[test]
fn a_lost_device_is_opened_again() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let arguments = ["suffern-boxes", "--size", "640x480", "--validation", "-n", "40"];
    let viewer = Viewer::start_with(folder.path(), SIZE, &arguments, &[(LOSE_AT, "60")]);
    // Before there is a picture, the frames have no passes.
    viewer.wait_for("a picture", |viewer| viewer.shown.borrow().0 > 0);
    let lost = |viewer: &Viewer| {
        let message = viewer.message.borrow();
        message.contains("lost while it ran") && message.contains("open again")
    };
    // A fast machine is done with the picture before its device is lost: then each move has some more frames.
    for step in (0..100).take_while(|_| !lost(&viewer)) {
        viewer.point([400 + step, 300]);
    }
    viewer.wait_for("what happened", lost);
    viewer.point_away();
    let message = viewer.message.borrow().clone();
    assert!(["trace", "resolve", "pick"].iter().any(|pass| message.contains(pass)), "{message}");
    viewer.wait_until_done();
    viewer.click_once("Close message");
    viewer.expect_picture("the same picture", 0, &["suffern-boxes", "-n", "40"]);
    viewer.drag("Lens diameter", &[0.5, 0.4, 0.3], |_| true);
    viewer.wait_until_done();
    viewer.close();
}

/// Catches a lost device that is told of in other words, or in many, and a picture that is written all the same.
#[test]
fn a_device_that_is_lost_without_a_window_ends_the_program_in_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = thinlens(folder.path())
        .args(["render", "suffern-boxes", "-o", "out.png", "-s", "64x48", "-n", "64", "--validation"])
        // What the scene takes is uploaded in six.
        .env(LOSE_AT, "7")
        .output();
    let run: Run = output.expect("it starts").into();
    assert_eq!(run.code, 1, "{}", run.stderr);
    let told = run.stderr.trim_end();
    assert!(!told.contains('\n') && told.contains("lost while it ran trace, accumulate"), "{told}");
    assert!(!folder.path().join("out.png").exists());
}
