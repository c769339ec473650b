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

/// The places of bright pixels in a rectangle of the screen, counted from its corner.
fn text_in(viewer: &Viewer, [x, y, width, height]: [i32; 4], level: u8) -> Vec<[i32; 2]> {
    let size = [width, height].map(|extent| u16::try_from(extent).expect("a size"));
    let pixels = viewer.screen([x, y].map(|at| i16::try_from(at).expect("on the screen")), size);
    let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    places.zip(pixels).filter(|(_, [red, ..])| *red > level).map(|(place, _)| place).collect()
}

/// Catches a drop-down list without a name, with the name of another one, and a name that the list covers.
#[test]
fn every_list_has_its_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("some.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a mesh");
    let folds = "{\"What is sharp\": false, \"Model\": false}";
    Viewer::remember(folder.path(), &format!("{{\"greeted\": true, \"folds\": {folds}}}"));
    let arguments = ["--validation", "--size", "400x900", "-n", "2", "some.obj"];
    let viewer = Viewer::start_in(folder.path(), [400, 900], &arguments);
    viewer.wait_until_done();
    let mut names = Vec::new();
    for (section, lists) in [
        ("Lens", ["Camera", "Sensor", "Known lenses"].as_slice()),
        ("Aperture shape", &["Aperture"]),
        ("Model", &["Axis that points up", "Material"]),
        ("View", &["Show"]),
        ("Output", &["Size of the picture"]),
        ("Files", &["Recent files"]),
    ] {
        viewer.click(section, |viewer| lists.iter().all(|list| viewer.controls.borrow().contains_key(*list)));
        viewer.rest();
        for list in lists {
            let [x, y, width, height] = viewer.controls.borrow()[*list];
            assert!(width >= 120, "there is no room for what is chosen in {list}");
            let name = text_in(&viewer, [0, y, x, height], 150);
            let end = name.iter().map(|[x, _]| *x).max();
            assert!(
                end.is_some_and(|end| end + 3 < x),
                "the name of {list} ends at {end:?}, the list begins at {x}"
            );
            assert!(!names.contains(&name), "{list} has the name of another list");
            names.push(name);
        }
        viewer.click_once(section);
        viewer.rest();
    }
    viewer.close();
}

/// Catches a tooltip of the drawing that covers controls of the panel.
#[test]
fn tooltips_of_the_drawing_stand_over_the_picture() {
    let viewer = Viewer::start([960, 720], &["-n", "1"]);
    viewer.wait_until_done();
    viewer.click("Optics", |viewer| viewer.controls.borrow().contains_key("Keep"));
    viewer.wait_until_done();
    let panel = || viewer.screen([0, 0], [PANEL - 1, 720]);
    for control in ["To scale", "Keep"] {
        viewer.point_away();
        viewer.rest();
        let [x, y, width, height] = viewer.controls.borrow()[control];
        let [left, top] = [x, y - 60].map(|at| i16::try_from(at).expect("on the screen"));
        let above = || viewer.screen([left, top], [80, 40]);
        let before = (panel(), above());
        viewer.point([x + width / 2, y + height / 2]);
        viewer.wait_for("the tooltip", |_| above() != before.1);
        assert!(panel() == before.0, "the tooltip of {control} lies over the panel");
    }
    viewer.close();
}
