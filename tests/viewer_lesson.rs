//! The viewer under Xvfb: what it shows to those who are new, and what it offers.

mod common;

use common::viewer::Viewer;

const SIZE: [u16; 2] = [900, 1000];
const ARGUMENTS: [&str; 5] = ["--size", "900x1000", "--validation", "-n", "4"];

/// The viewer of a user who has never started it, and the folder of its memory.
fn first_start() -> (tempfile::TempDir, Viewer) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    Viewer::remember(folder.path(), "{}");
    let viewer = Viewer::start_in(folder.path(), SIZE, &ARGUMENTS);
    viewer.wait_until_done();
    (folder, viewer)
}

/// Catches a greeting that stays, or comes again; a step of the lesson that counts as done before it is, or does not
/// notice that it was done; and a lesson that does not end.
#[test]
fn the_lesson_notices_what_was_done() {
    let (folder, viewer) = first_start();
    let shows = |viewer: &Viewer, control: &str| viewer.controls.borrow().contains_key(control);
    viewer.click("Start the lesson", |viewer| shows(viewer, "Skip step"));
    let step = |name: &str, on: &str, act: &dyn Fn()| {
        viewer.controls.borrow_mut().remove(on);
        viewer.rest();
        assert!(!shows(&viewer, on), "{name} counts as done before it is");
        act();
        viewer.wait_for(name, |viewer| shows(viewer, on));
        viewer.controls.borrow_mut().remove("Skip step");
        viewer.click_once(on);
        if on == "Next step" {
            viewer.wait_for("a step that is not done yet", |viewer| shows(viewer, "Skip step"));
        }
        viewer.rest();
    };
    let click = |pixel: [u32; 2], button: &str| {
        viewer.point(Viewer::in_window(pixel));
        viewer.hands(button, 0);
    };
    // A control is framed by a bright line beside it.
    let is_framed = |control: &str| {
        let [x, y, width, height] = viewer.controls.borrow()[control];
        let is_bright = |place: [i32; 2]| {
            let corner = place.map(|at| i16::try_from(at).expect("on the screen"));
            viewer.screen(corner, [1, 1])[0].into_iter().max() > Some(180)
        };
        is_bright([x - 1, y + height / 2]) && is_bright([x + width / 2, y - 1])
    };
    // The line leaves the letters above the control free.
    let touches_name = |control: &str| {
        let [x, y, width, _] = viewer.controls.borrow()[control];
        let [x, y] = [x, y - 4].map(|at| i16::try_from(at).expect("on the screen"));
        let row = viewer.screen([x, y], [u16::try_from(width).expect("a width"), 2]);
        row.into_iter().any(|[red, _, blue]| red > blue.saturating_add(60))
    };
    let frames = |control: &str| {
        viewer.point_away();
        viewer.rest();
        for other in ["Lens diameter", "Focal plane distance", "Optics"] {
            assert_eq!(is_framed(other), other == control, "{other}, but {control} is asked for");
            assert!(!touches_name(other), "the frame of {control} touches the name of {other}");
        }
    };
    let is_not_done = |after: &str| {
        viewer.rest();
        assert!(!shows(&viewer, "Next step"), "{after} counts as done");
    };
    frames("Lens diameter");
    step("a point", "Next step", &|| {
        let is_narrow = |viewer: &Viewer| (0.01..0.2).contains(&viewer.state.borrow()[0]);
        viewer.drag("Lens diameter", &[0.1, 0.05], is_narrow);
        is_not_done("a narrow lens");
        viewer.drag("Lens diameter", &[0.05, 0.0], |viewer| viewer.state.borrow()[0] == 0.0);
    });
    step("a wide lens", "Next step", &|| {
        let is_middling = |viewer: &Viewer| (0.1..0.17).contains(&viewer.state.borrow()[0]);
        viewer.drag("Lens diameter", &[0.03, 0.08], is_middling);
        is_not_done("f/5");
        viewer.drag("Lens diameter", &[0.1, 0.2], |viewer| viewer.state.borrow()[0] > 0.3);
    });
    frames("Focal plane distance");
    step("another focus", "Next step", &|| click([800, 900], "click 3"));
    step("the drawing", "Next step", &|| {
        frames("Optics");
        viewer.press("o");
        is_not_done("the drawing by itself");
        click([450, 60], "click 1");
    });
    viewer.press("o");
    step("a narrow lens", "Next step", &|| {
        viewer.click("Lens", |viewer| shows(viewer, "f/16"));
        viewer.click_once("f/11");
        is_not_done("f/11");
        viewer.click_once("f/16");
    });
    step("more points", "Finish", &|| {
        viewer.drag("Points per pixel", &[0.28, 0.3], |viewer| viewer.shown.borrow().1 > 4);
    });
    assert!(viewer.message.borrow().contains("That was the lesson"), "{}", viewer.message.borrow());
    assert!(!shows(&viewer, "Skip step"), "the lesson goes on after its last step");
    viewer.close();

    let again = Viewer::start_in(folder.path(), SIZE, &["--validation"]);
    again.wait_until_done();
    assert!(!shows(&again, "Start the lesson"), "it greets twice");
    again.close();
}

/// Catches a greeting that goes only by its button, and one that stays on the picture.
#[test]
fn the_greeting_goes_when_the_hand_moves() {
    let (_folder, viewer) = first_start();
    assert!(viewer.controls.borrow().contains_key("Start the lesson"), "no greeting");
    viewer.point(Viewer::in_window([450, 500]));
    viewer.hands("click 3", 0);
    viewer.point_away();
    viewer.wait_until_done();
    let focal_distance = viewer.state.borrow()[1].to_string();
    viewer.rest();
    viewer.expect_picture(
        "a picture without a greeting",
        0,
        &["-n", "4", "--focal-distance", &focal_distance],
    );
    viewer.close();
}

/// Catches a dropped image that is refused although it can be an aperture, and one that is used without being asked for.
#[test]
fn a_dropped_image_becomes_the_aperture() {
    let viewer = Viewer::start(SIZE, &["-n", "2"]);
    viewer.wait_until_done();
    let star = viewer.folder.join("star.png");
    let file = std::fs::File::create(&star).expect("a file");
    let mut encoder = png::Encoder::new(file, 3, 3);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[0, 255, 0, 255, 255, 255, 0, 255, 0]).expect("pixels");
    writer.finish().expect("a file");
    let offers = |viewer: &Viewer| viewer.message.borrow().contains("star.png");
    viewer.drop_file(&star);
    viewer.wait_for("an offer", offers);
    viewer.rest();
    viewer.click_once("Close message");
    viewer.rest();
    viewer.expect_picture("the aperture as before", 0, &["-n", "2"]);
    viewer.message.borrow_mut().clear();
    viewer.drop_file(&star);
    viewer.wait_for("the offer again", offers);
    viewer.rest();
    viewer.click_once("Use as aperture");
    viewer.wait_until_done();
    viewer.expect_picture("a star", 0, &["-n", "2", "--aperture-image", &star.display().to_string()]);
    viewer.close();
}
