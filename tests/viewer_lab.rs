//! The viewer under Xvfb: moving the camera, undoing, comparing and saving.

mod common;

use common::viewer::{MEMORY, PANEL, Viewer, x11::difference};
use common::{decode_png, render_png, run};
use std::process::Command;
use std::time::Duration;
use thinlens::scene;

const SIZE: [u16; 2] = [800, 720];
/// Rows below the labels of a comparison.
const TOP: usize = 60;

/// A wide open picture of the scene, which is quick.
const QUICK: [&str; 2] = ["-n", "2"];

/// What `render` gives for these options, row by row.
fn rendered(viewer: &Viewer, options: &[&str]) -> Vec<[u8; 3]> {
    let size = format!("{}x{}", SIZE[0], SIZE[1]);
    decode_png(&render_png(&viewer.folder, &[&["--size", &size], options].concat())).1
}

/// The pixels of some columns, below the labels.
fn columns(picture: &[[u8; 3]], from: usize, to: usize) -> Vec<[u8; 3]> {
    picture.chunks_exact(usize::from(SIZE[0])).skip(TOP).flat_map(|row| row[from..to].to_vec()).collect()
}

fn distance(camera: [f32; 6]) -> f32 {
    (0..3).map(|axis| (camera[axis] - camera[axis + 3]).powi(2)).sum::<f32>().sqrt()
}

/// Catches a hand that turns the wrong thing, a camera that drifts from what it looks at, keys that do
/// nothing, and a picture of another place than the numbers say.
#[test]
fn the_camera_follows_the_hand() {
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    let start = *viewer.camera.borrow();
    let now = || *viewer.camera.borrow();

    viewer.until("orbiting", |_| now() != start, || viewer.drag_picture(1, [600, 400], [520, 380]));
    let turned = now();
    assert_eq!(turned[3..], start[3..], "an orbit looks elsewhere");
    assert!((distance(turned) / distance(start) - 1.0).abs() < 1e-4, "an orbit goes nearer or away");
    assert!(turned[0] > start[0], "the scene does not follow a hand that goes left: {turned:?}");
    viewer.wait_until_done();
    let text = |numbers: &[f32]| format!("{},{},{}", numbers[0], numbers[1], numbers[2]);
    let placed = [format!("--eye={}", text(&turned)), format!("--look-at={}", text(&turned[3..]))];
    viewer.expect_picture("an orbit", 0, &["-n", "2", &placed[0], &placed[1]]);

    viewer.until("panning", |_| now() != turned, || viewer.drag_picture(2, [600, 400], [600, 440]));
    let panned = now();
    let shift = |axis: usize| panned[axis] - turned[axis];
    assert!(panned[4] > turned[4], "the scene does not follow a hand that goes down");
    assert!((0..3).all(|axis| (shift(axis) - shift(axis + 3)).abs() < 1e-4), "a pan turns the camera");

    let near = |viewer: &Viewer| {
        let notches = (distance(*viewer.camera.borrow()) / distance(panned)).ln() / 0.9_f32.ln();
        notches > 0.5 && (notches - notches.round()).abs() < 0.01
    };
    viewer.until("the wheel", near, || viewer.wheel([600, 400], 0));
    let nearer = now();
    assert_eq!(nearer[3..], panned[3..], "the wheel looks elsewhere");

    let flown =
        |viewer: &Viewer| distance(*viewer.camera.borrow()) > 0.0 && *viewer.camera.borrow() != nearer;
    viewer.until("flying", flown, || {
        viewer.hands("search --class thinlens windowfocus --sync keydown w", 1);
        viewer.hands("keyup w", 0);
    });
    let flown = now();
    assert!(
        (distance(flown) / distance(nearer) - 1.0).abs() < 1e-3,
        "flight comes nearer to what it looks at"
    );
    let ahead: f32 =
        (0..3).map(|axis| (flown[axis] - nearer[axis]) * (nearer[axis + 3] - nearer[axis])).sum();
    assert!(ahead > 0.0, "W flies backwards");

    viewer.until("Home", |_| now() == start, || viewer.press("Home"));
    viewer.wait_until_done();
    viewer.expect_picture("the scene's camera", 0, &QUICK);
    viewer.close();
}

/// Catches a change that cannot be undone, one that is undone by halves, and an undo that another change
/// leaves to be redone.
#[test]
fn changes_are_undone_and_made_again() {
    let mut viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    let [diameter, focal_distance, _] = *viewer.state.borrow();
    let camera = *viewer.camera.borrow();
    viewer.drag("Lens diameter", &[0.125, 0.2, 0.3, 0.4], |viewer| viewer.state.borrow()[0] > 1.5 * diameter);
    let wide = viewer.state.borrow()[0];
    viewer.until(
        "orbiting",
        |viewer| *viewer.camera.borrow() != camera,
        || {
            viewer.drag_picture(1, [600, 400], [560, 400]);
        },
    );
    let turned = *viewer.camera.borrow();

    // Another size is no change, and keeps none from being undone.
    viewer.resize([790, 700]);
    viewer.until("undo", |viewer| *viewer.camera.borrow() == camera, || viewer.press("ctrl+z"));
    assert_eq!(viewer.state.borrow()[0], wide, "two changes at once");
    viewer.until("undo", |viewer| viewer.state.borrow()[0] == diameter, || viewer.press("ctrl+z"));
    viewer.until("redo", |viewer| viewer.state.borrow()[0] == wide, || viewer.press("ctrl+shift+z"));
    viewer.until("redo", |viewer| *viewer.camera.borrow() == turned, || viewer.click_once("Redo"));
    viewer.until("undo", |viewer| *viewer.camera.borrow() == camera, || viewer.click_once("Undo"));

    // A new change takes the place of what was undone.
    viewer.drag("Focal plane distance", &[0.5, 0.55, 0.6], |viewer| {
        viewer.state.borrow()[1] > 1.1 * focal_distance
    });
    viewer.press("ctrl+y");
    viewer.rest();
    assert_eq!(*viewer.camera.borrow(), camera, "what was undone before a change is made again");
    viewer.close();
}

/// Catches sides that are swapped, a held picture that goes on, and a line that does not follow the hand.
#[test]
fn a_held_picture_stands_beside_the_live_one() {
    let viewer = Viewer::start(SIZE, &["-n", "2", "--f-number", "2.8"]);
    viewer.wait_until_done();
    let has_line = |viewer: &Viewer| viewer.controls.borrow().contains_key("Divider");
    viewer.until("comparing", has_line, || viewer.press("c"));
    viewer.until(
        "a pinhole",
        |viewer| viewer.state.borrow()[0] == 0.0,
        || {
            viewer.drag("Lens diameter", &[0.09, 0.05, -0.2], |_| true);
        },
    );
    viewer.wait_until_done();
    let held = rendered(&viewer, &["-n", "2", "--f-number", "2.8"]);
    let live = rendered(&viewer, &["-n", "2", "--lens-diameter", "0"]);
    let agree = |line: u16| {
        let line = usize::from(line - PANEL);
        let (from, to) = (line - 14, line + 14);
        viewer.wait_for("both sides", |viewer| {
            let shown = viewer.picture();
            columns(&shown, 0, from) == columns(&held, 0, from)
                && columns(&shown, to, 800) == columns(&live, to, 800)
        });
    };
    let line = |viewer: &Viewer| {
        let [x, _, width, _] = viewer.controls.borrow()["Divider"];
        (x + width / 2) as u16
    };
    let before = line(&viewer);
    agree(before);
    assert!(difference(&columns(&held, 0, 800), &columns(&live, 0, 800)) > 50, "nothing to compare");
    viewer.until(
        "the line",
        |viewer| line(viewer) > before + 50,
        || {
            let x = i32::from(line(&viewer));
            viewer.drag_picture(1, [x, 300], [x + 80, 300]);
        },
    );
    agree(line(&viewer));

    viewer.press("c");
    viewer.wait_for("only the live picture", |viewer| {
        columns(&viewer.picture(), 0, 800) == columns(&live, 0, 800)
    });
    viewer.close();
}

/// Catches a picture that is saved otherwise than it is shown, with another number of samples, in the window's
/// byte order, or with settings that render another one; and a command line that does.
#[test]
fn what_is_saved_renders_again() {
    let viewer = Viewer::start(SIZE, &["suffern-mirror", "-n", "5"]);
    viewer.wait_until_done();
    let start = *viewer.camera.borrow();
    viewer.until(
        "orbiting",
        |viewer| *viewer.camera.borrow() != start,
        || {
            viewer.drag_picture(1, [600, 400], [570, 410]);
        },
    );
    viewer.drag("Lens diameter", &[0.125, 0.2, 0.25], |_| true);
    viewer.wait_until_done();
    let saved = viewer.folder.join("thinlens.png");
    viewer.until("saving", |_| saved.exists(), || viewer.press("ctrl+s"));
    let picture = decode_png(&std::fs::read(&saved).expect("a picture"));
    viewer.wait_for("what was saved", |viewer| viewer.picture() == picture.1);

    let again = |arguments: &[&str]| {
        let outcome = run(&viewer.folder, arguments);
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        decode_png(&std::fs::read(viewer.folder.join("again.png")).expect("a picture"))
    };
    let from = again(&["render", "--from", "thinlens.png", "-q", "-o", "again.png"]);
    assert!(from == picture, "another picture comes of it");

    // The next one gets a name of its own. S that is let go after Ctrl does not fly.
    let next = viewer.folder.join("thinlens-2.png");
    let placed = *viewer.camera.borrow();
    viewer.until(
        "saving",
        |_| next.exists(),
        || {
            viewer.hands("search --class thinlens windowfocus --sync keydown ctrl keydown s keyup ctrl", 1);
            viewer.hands("keyup s", 0);
        },
    );
    assert_eq!(*viewer.camera.borrow(), placed, "Ctrl+S moves the camera");

    viewer.until("copying", |viewer| viewer.copied.borrow().is_some(), || viewer.press("ctrl+c"));
    let line = viewer.copied.take().expect("a line");
    let pasted = Command::new("xclip")
        .args(["-o", "-selection", "clipboard"])
        .env("DISPLAY", &viewer.display)
        .output()
        .expect("xclip, which setup.sh installs");
    assert_eq!(String::from_utf8_lossy(&pasted.stdout), line, "the clipboard has something else");
    let words = line.replace("thinlens render", "render -q").replace("picture.png", "again.png");
    let copied = again(&words.split(' ').collect::<Vec<_>>());
    assert!(copied == picture, "another picture comes of {line}");
    viewer.close();
}

/// Catches scenes that are saved with another camera or lens than is shown, and files that cannot be dropped on the
/// window, or whose failure is not survived.
#[test]
fn scenes_and_pictures_are_saved_and_dropped() {
    let viewer = Viewer::start(SIZE, &["-n", "3"]);
    viewer.wait_until_done();
    let (start, plain) = (*viewer.camera.borrow(), *viewer.state.borrow());
    viewer.until(
        "orbiting",
        |viewer| *viewer.camera.borrow() != start,
        || {
            viewer.drag_picture(1, [600, 400], [570, 410]);
        },
    );
    viewer.drag("Lens diameter", &[0.125, 0.2, 0.25], |viewer| viewer.state.borrow()[0] > plain[0]);
    viewer.wait_until_done();
    let (turned, wide) = (*viewer.camera.borrow(), *viewer.state.borrow());
    let saved = viewer.folder.join("scene.toml");
    viewer.until("saving", |_| saved.exists(), || viewer.press("ctrl+shift+s"));
    viewer.expect_picture("the saved scene", 0, &["-n", "3", &saved.display().to_string()]);

    let is =
        |viewer: &Viewer, camera, state| *viewer.camera.borrow() == camera && *viewer.state.borrow() == state;
    let picture = viewer.folder.join("plain.png");
    std::fs::write(&picture, render_png(&viewer.folder, &["-n", "3", "-s", "40x30"])).expect("a picture");
    viewer.drop_file(&picture);
    viewer.wait_for("the picture's scene", |viewer| is(viewer, start, plain));
    viewer.drop_file(&saved);
    viewer.wait_for("the saved scene", |viewer| is(viewer, turned, wide));
    viewer.wait_until_done();
    viewer.expect_picture("the saved scene", 0, &["-n", "3", &saved.display().to_string()]);
    let broken = viewer.folder.join("broken.toml");
    std::fs::write(&broken, "size = 3").expect("a file");
    viewer.drop_file(&broken);
    let says = |viewer: &Viewer| viewer.message.borrow().contains("broken.toml:1");
    viewer.wait_for("why it cannot be opened", says);
    assert!(is(&viewer, turned, wide), "a file that cannot be opened changes the scene");
    // One that is read but cannot be rendered leaves nothing behind either.
    let bright = viewer.folder.join("bright.toml");
    let text = include_str!("../src/scene/builtin/passing.toml");
    std::fs::write(&bright, format!("{text}\n[view]\nexposure = 50\n")).expect("a file");
    viewer.drop_file(&bright);
    viewer.wait_for("why it cannot be shown", |viewer| viewer.message.borrow().contains("must be from"));
    viewer.until(
        "orbiting",
        |viewer| *viewer.camera.borrow() != turned,
        || {
            viewer.drag_picture(1, [600, 400], [570, 410]);
        },
    );
    viewer.until("Home", |viewer| *viewer.camera.borrow() == turned, || viewer.press("Home"));
    viewer.close();
}

/// Catches a viewer that forgets, and one whose Reset goes back to what it remembers.
#[test]
fn the_next_time_everything_is_as_it_was() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let first =
        Viewer::start_in(folder.path(), [760, 700], &["suffern-boxes", "-n", "2", "--size", "760x700"]);
    first.wait_until_done();
    let [diameter, ..] = *first.state.borrow();
    first.drag("Lens diameter", &[0.125, 0.2, 0.3], |viewer| viewer.state.borrow()[0] > 1.2 * diameter);
    first.wait_until_done();
    let left = *first.state.borrow();
    first.close();

    let second = Viewer::start_in(folder.path(), [760, 700], &["--validation"]);
    second.wait_until_done();
    assert_eq!(*second.state.borrow(), left);
    assert_eq!(*second.shown.borrow(), (2, 2));
    let wide = left[0].to_string();
    second.expect_picture("what was there", 0, &["suffern-boxes", "-n", "2", "--lens-diameter", &wide]);
    second.click("Reset", |viewer| viewer.state.borrow()[0] == diameter);
    second.close();

    // What has gone meanwhile is said, and is no reason to stay away.
    let memory = std::fs::read_to_string(folder.path().join(MEMORY)).expect("a memory");
    Viewer::remember(folder.path(), &memory.replace("suffern-boxes", "gone.toml"));
    let third = Viewer::start_in(folder.path(), [760, 700], &["--validation"]);
    let version_4 = scene::load("version-4").expect("a built-in scene");
    third.wait_for("the default scene", |viewer| viewer.state.borrow()[0] == version_4.lens.diameter);
    third.close();
}

/// Catches a pause that goes on, that shows nothing after a change, or that cannot be ended; and a list of keys
/// that does not open and close.
#[test]
fn it_pauses_and_says_its_keys() {
    let viewer = Viewer::start(SIZE, &["-n", "2048"]);
    viewer.until("a pause", |viewer| viewer.controls.borrow().contains_key("Go on"), || viewer.press("p"));
    viewer.rest();
    let (samples, _) = *viewer.shown.borrow();
    assert!((1..2048).contains(&samples), "{samples} points");
    assert!(viewer.listen(Duration::from_secs(1)).is_none(), "it works on");

    // Another lens is shown with the least that shows it.
    let [diameter, ..] = *viewer.state.borrow();
    viewer.drag("Lens diameter", &[0.125, 0.2, 0.3], |viewer| viewer.state.borrow()[0] > 1.2 * diameter);
    viewer.rest();
    let wide = viewer.state.borrow()[0].to_string();
    let samples = viewer.shown.borrow().0.to_string();
    viewer.expect_picture("a paused picture", 0, &["-n", &samples, "--lens-diameter", &wide]);

    let before = viewer.picture();
    viewer.until("keys", |viewer| difference(&viewer.picture(), &before) > 50, || viewer.press("question"));
    viewer.until("no keys", |viewer| viewer.picture() == before, || viewer.press("F1"));
    viewer.controls.borrow_mut().remove("Pause");
    viewer.until("going on", |viewer| viewer.controls.borrow().contains_key("Pause"), || viewer.press("p"));
    viewer.history.borrow_mut().clear();
    viewer.wait_for("more points", |viewer| viewer.history.borrow().len() > 1);
    viewer.close();
}
