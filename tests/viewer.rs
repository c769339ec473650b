//! The viewer under Xvfb: what its controls change.

mod common;

use common::viewer::{Server, Viewer, x11::difference};
use common::{Run, thinlens};
use std::time::Duration;

/// Catches sliders that are not connected, or to something else; a picture that the screen shows in
/// other colours than the file; and a points slider that throws samples away.
#[test]
fn sliders_change_what_is_rendered() {
    let mut viewer = Viewer::start([800, 640], &["-n", "8"]);
    viewer.wait_until_done();
    viewer.expect_picture("the default lens", 0, &["-n", "8"]);

    // The focal plane to its nearest, a twentieth of the scene's.
    let before = viewer.picture();
    let scene = thinlens::scene::load("version-4").expect("a built-in");
    let nearest = scene.lens.focal_distance / 20.0;
    viewer.drag("Focal plane distance", &[0.5, 0.3, 0.1, -0.2], |viewer| viewer.state.borrow()[1] == nearest);
    viewer.wait_until_done();
    let nearest = nearest.to_string();
    viewer.expect_picture("the nearest focal plane", 0, &["-n", "8", "--focal-distance", &nearest]);
    assert!(difference(&before, &viewer.picture()) > 50);

    // The diameter to nothing: the pinhole, whatever the focal plane.
    viewer.drag("Lens diameter", &[0.125, 0.1, 0.05, -0.2], |viewer| viewer.state.borrow()[0] == 0.0);
    viewer.wait_until_done();
    viewer.expect_picture("the pinhole", 0, &["-n", "8", "--lens-diameter", "0"]);

    // The points up: the count goes on from where it is.
    viewer.history.borrow_mut().clear();
    viewer.drag("Points per pixel", &[0.29, 0.31, 0.33], |viewer| viewer.shown.borrow().1 > 8);
    viewer.wait_until_done();
    let history = viewer.history.borrow().clone();
    assert!(history.iter().all(|samples| *samples >= 8), "it started anew: {history:?}");
    assert!(history.last().is_some_and(|samples| *samples > 8), "it does not go on: {history:?}");
    let points = viewer.shown.borrow().1.to_string();
    // Batches were cut at the targets in between, so a rounding may differ.
    viewer.expect_picture("more points", 1, &["-n", &points, "--lens-diameter", "0"]);

    // Once the picture is complete, no frame is drawn.
    viewer.rest();
    assert!(viewer.listen(Duration::from_secs(1)).is_none(), "it draws for nobody");

    // Reset, then one centre ray a pixel.
    let default = scene.lens.diameter;
    viewer.click("Reset", |viewer| viewer.state.borrow()[0] == default);
    viewer.wait_for("reset", |viewer| *viewer.shown.borrow() == (8, 8));
    viewer.expect_picture("the scene's own lens again", 0, &["-n", "8"]);
    viewer.click("Sampling", |viewer| viewer.controls.borrow().contains_key("No anti-aliasing"));
    viewer.click("No anti-aliasing", |viewer| viewer.state.borrow()[2] == 0.0);
    viewer.expect_picture("one centre ray", 0, &["-n", "8", "--jitter", "0"]);

    // Another size of the window.
    viewer.resize([640, 400]);
    viewer.expect_picture("a smaller window", 0, &["-n", "8", "--jitter", "0"]);
    viewer.close();
}

/// Catches events that the driver takes in while it presents, and that nobody looks for: the window seems dead until
/// the next one comes. Each event here comes right after a frame began, when most of them are met so.
#[test]
fn no_event_is_slept_on() {
    let viewer = Viewer::start_as_user([500, 400], &["-n", "1"]);
    viewer.wait_until_done();
    for number in 0..60 {
        viewer.point([400 + number % 7, 200 + number % 5]);
        viewer.hands("mousedown 1", 1);
        viewer.hands("mouseup 1", 0);
    }
    viewer.close();
}

/// Catches a machine without a driver that is told of an extension, for without drivers all that windows need are
/// missing.
#[test]
fn a_missing_driver_is_told_as_what_it_is() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let server = Server::start();
    let nowhere = folder.path().join("none.json");
    let output = thinlens(folder.path())
        .args(["view", "--size", "80x60"])
        .env("DISPLAY", &server.display)
        .env("XDG_STATE_HOME", folder.path())
        .env("VK_DRIVER_FILES", &nowhere)
        .env("VK_ICD_FILENAMES", &nowhere)
        .output();
    let run: Run = output.expect("it starts").into();
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stderr.contains("no driver is installed"), "{}", run.stderr);
}

/// Catches a film of the last scene under the name of the next one, and an exit in the middle of
/// work that leaves the device a mess.
#[test]
fn a_window_closes_cleanly_while_it_renders() {
    let viewer = Viewer::start([500, 400], &["suffern-mirror", "-n", "100000", "--jitter", "3"]);
    viewer.wait_for("first samples", |viewer| viewer.shown.borrow().0 > 2);
    viewer.close();
}
