//! The viewer under Xvfb: whether what it shows can be seen and told apart.

mod common;

use common::viewer::{PANEL, SECTIONS, Viewer};

const HEAD: [&str; 8] = ["Autofocus", "Pick focus", "Optics", "Undo", "Redo", "Reset", "Compare", "Pause"];

/// Catches a head of the panel that leaves no room for the sections, buttons that need a second row, and a tolerance that
/// a low window does not show.
#[test]
fn all_sections_are_in_view_as_the_program_opens() {
    let place = |viewer: &Viewer, name: &str| viewer.controls.borrow()[name];
    let viewer = Viewer::start([1280 - PANEL, 720], &["-n", "1"]);
    viewer.wait_until_done();
    let [_, head, _, _] = place(&viewer, "Lens");
    assert!(head <= 360, "the head of the panel takes {head} rows");
    for name in SECTIONS {
        let [_, y, _, height] = place(&viewer, name);
        assert!(y + height <= 720, "{name} is out of view at {y}");
    }
    for name in HEAD {
        let [x, y, width, _] = place(&viewer, name);
        assert_eq!(y, place(&viewer, "Autofocus")[1], "{name} stands in another row");
        assert!(x + width <= i32::from(PANEL), "{name} is cut off");
    }
    viewer.close();

    let viewer = Viewer::start([500, 640], &["-n", "1"]);
    viewer.wait_until_done();
    let [_, y, _, height] = place(&viewer, "Tolerance");
    assert!(y + height < place(&viewer, "Lens")[1], "the tolerance is not beside what is sharp");
    assert!(place(&viewer, "Lens")[1] + 150 <= 640, "there is no room for the sections");
    viewer.close();
}

/// The colour of a button, between its edge and its text or icon.
fn ground(viewer: &Viewer, button: &str) -> [u8; 3] {
    let [x, y, _, height] = viewer.controls.borrow()[button];
    viewer.screen([(x + 2) as i16, (y + height / 2) as i16], [1, 1])[0]
}

fn is_accent([red, _, blue]: [u8; 3]) -> bool {
    red > 200 && blue < 100
}

/// Catches a button that looks the same whether it is on or off, or that stays on.
#[test]
fn buttons_show_whether_they_are_on() {
    let viewer = Viewer::start([900, 900], &["-n", "2"]);
    viewer.wait_until_done();
    let shows = |viewer: &Viewer, name: &str| viewer.controls.borrow().contains_key(name);
    viewer.click("Lens", |viewer| shows(viewer, "Sharp range"));
    for (off, on) in [
        ("Pick focus", "Pick focus"),
        ("Optics", "Optics"),
        ("Compare", "Compare"),
        ("Pause", "Go on"),
        ("Help", "Help"),
        ("Sharp and blurred", "Sharp and blurred"),
        ("Sharp range", "Sharp range"),
    ] {
        viewer.rest();
        assert!(!is_accent(ground(&viewer, off)), "{off} is on already");
        viewer.click_once(off);
        viewer.rest();
        assert!(
            is_accent(ground(&viewer, on)),
            "{on} does not show that it is on: {:?}",
            ground(&viewer, on)
        );
        viewer.click_once(on);
        viewer.rest();
        assert!(!is_accent(ground(&viewer, off)), "{off} stays on");
    }
    // The stop that is set.
    viewer.click_once("f/8");
    viewer.rest();
    assert!(is_accent(ground(&viewer, "f/8")) && !is_accent(ground(&viewer, "f/4")));
    viewer.close();
}

/// Catches a tint beside the picture: what is no grey in the panel is the accent, which is warm.
#[test]
fn the_panel_is_neutral() {
    let viewer = Viewer::start([500, 720], &["-n", "2"]);
    viewer.wait_until_done();
    let panel = viewer.screen([0, 0], [PANEL - 1, 720]);
    let tinted = panel.iter().filter(|[red, green, blue]| red < green || green < blue).count();
    assert_eq!(tinted, 0, "pixels that are neither grey nor warm");
    assert!(panel.iter().any(|[red, _, blue]| red > blue), "the marks of the focal plane are there");
    viewer.close();
}
