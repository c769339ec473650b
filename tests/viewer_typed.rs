//! The viewer under Xvfb: numbers that are typed into the rows of the panel, and what else a row does.

mod common;

use common::viewer::Viewer;
use thinlens::scene::{self, Scene};

const SIZE: [u16; 2] = [800, 1000];

fn start() -> (Viewer, Scene) {
    let viewer = Viewer::start(SIZE, &["-n", "2"]);
    viewer.wait_until_done();
    // Without a window manager nobody else gives it the keyboard.
    viewer.xdotool("search --class thinlens windowfocus --sync");
    (viewer, scene::load("version-4").expect("a built-in scene"))
}

/// Opens the field of a row by a click with Ctrl, types, and presses Enter.
fn type_into(viewer: &Viewer, control: &str, text: &str) {
    let [x, y, width, height] = viewer.controls.borrow()[control];
    viewer.point([x + width / 3, y + height / 2]);
    viewer.hands("keydown ctrl", 1);
    viewer.hands("mousedown 1", 2);
    viewer.hands("mouseup 1", 1);
    viewer.hands("keyup ctrl", 0);
    retype(viewer, text);
    viewer.point_away();
}

/// Types into the field that is open, in the place of what it holds, and presses Enter.
fn retype(viewer: &Viewer, text: &str) {
    viewer.hands(&format!("search --class thinlens windowfocus --sync type --delay 40 {text}"), 0);
    viewer.press("Return");
}

/// The command line that renders what is set.
fn command_line(viewer: &Viewer) -> String {
    *viewer.copied.borrow_mut() = None;
    viewer.until("copying", |viewer| viewer.copied.borrow().is_some(), || viewer.press("ctrl+c"));
    // A message may move the rows.
    viewer.rest();
    viewer.copied.take().expect("a command line")
}

/// Catches a number of which only a part is read, and one that is not read at all and changes something, or is refused
/// without a word.
#[test]
fn numbers_are_typed_as_people_write_them() {
    let (viewer, scene) = start();
    let of_f_number = |number: f64| (scene.camera.film_distance() / number) as f32;
    // Closed, so that the sections have enough room for both.
    viewer.click_once("What is sharp");
    viewer.rest();
    viewer.click("Lens", |viewer| viewer.controls.borrow().contains_key("f-number"));
    viewer.click("Light", |viewer| viewer.controls.borrow().contains_key("Shutter"));
    viewer.rest();

    type_into(&viewer, "Shutter", "1/250");
    assert!(command_line(&viewer).contains("--shutter=0.004 "), "{}", command_line(&viewer));
    for (text, number) in [("2,8", 2.8), ("f/4", 4.0), ("5.6", 5.6)] {
        type_into(&viewer, "f-number", text);
        viewer.wait_for(text, |viewer| viewer.state.borrow()[0] == of_f_number(number));
    }
    // A unit of this scene is 5 cm long.
    type_into(&viewer, "Focal plane distance", "35cm");
    viewer.wait_for("35 cm", |viewer| viewer.state.borrow()[1] == 7.0);

    let before = command_line(&viewer);
    for (control, text, part) in [
        ("f-number", "1/4", "written like 2.8 or f/2.8"),
        ("Shutter", "soon", "written like 1/250"),
        ("Shutter", "1e9", "must be from"),
        ("Focal plane distance", "0", "must be from"),
    ] {
        type_into(&viewer, control, text);
        let says = |viewer: &Viewer| {
            let message = viewer.message.borrow();
            message.contains(part) && message.contains(&format!("\"{text}\""))
        };
        viewer.wait_for("a refusal", says);
        viewer.press("Escape");
        viewer.rest();
        assert_eq!(command_line(&viewer), before, "{text} changes something");
    }

    // What was refused can be typed again at once.
    type_into(&viewer, "f-number", "eight");
    viewer.wait_for("a refusal", |viewer| viewer.message.borrow().contains("eight"));
    retype(&viewer, "f/8");
    viewer.wait_for("f/8", |viewer| viewer.state.borrow()[0] == of_f_number(8.0));
    viewer.close();
}

/// Catches a name that does not reset its row, or more than its row, and a number that cannot be clicked.
#[test]
fn a_name_resets_its_row_and_a_number_opens_its_field() {
    let (viewer, scene) = start();
    viewer.drag("Lens diameter", &[0.125, 0.2, 0.3], |viewer| viewer.state.borrow()[0] > 0.5);
    viewer.rest();
    let wide = viewer.state.borrow()[0];
    let above = |control: &str| {
        let [x, y, width, _] = viewer.controls.borrow()[control];
        ([x + 12, y - 14], [x + width - 12, y - 14])
    };
    let (_, number) = above("Focal plane distance");
    viewer.point(number);
    viewer.hands("click 1", 0);
    retype(&viewer, "7");
    viewer.wait_for("7", |viewer| viewer.state.borrow()[1] == 7.0);
    viewer.point_away();
    viewer.rest();

    let (name, _) = above("Focal plane distance");
    viewer.point(name);
    viewer.hands("click --repeat 2 --delay 60 1", 0);
    viewer.wait_for("the scene's distance", |viewer| viewer.state.borrow()[1] == scene.lens.focal_distance);
    assert_eq!(viewer.state.borrow()[0], wide, "another row is reset too");
    viewer.close();
}

/// Catches arrow keys that do nothing, that go the wrong way or too far, that move another slider than the one under
/// the pointer, and steps that cannot be undone together.
#[test]
fn arrows_move_the_slider_under_the_pointer() {
    let (viewer, scene) = start();
    let [x, y, width, height] = viewer.controls.borrow()["Focal plane distance"];
    viewer.point([x + width / 3, y + height / 2]);
    let plain = scene.lens.focal_distance;
    let ratio = |viewer: &Viewer| f64::from(viewer.state.borrow()[1] / plain);
    // The slider is logarithmic, from a twentieth to twenty times.
    let step = 400_f64.powf(0.002);
    let is = |steps: f64| move |viewer: &Viewer| (ratio(viewer) / step.powf(steps) - 1.0).abs() < 1e-5;
    viewer.until("a step", is(1.0), || viewer.press("Right"));
    viewer.until("a step back", is(0.0), || viewer.press("Left"));
    viewer.until("a long step", is(10.0), || viewer.press("shift+Right"));
    assert_eq!(viewer.state.borrow()[0], scene.lens.diameter, "another slider moves");
    viewer.point_away();
    viewer.until("undo", is(0.0), || viewer.press("ctrl+z"));
    viewer.close();
}
