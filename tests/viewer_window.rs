//! The viewer under Xvfb: what lies where in its window, and what it says.

mod common;

use common::viewer::{PANEL, Viewer};

const SIZE: [u16; 2] = [800, 720];
const QUICK: [&str; 2] = ["-n", "2"];

/// The colour of the message, left of its button. The button has gone from where it was if nothing is shown there.
fn message_color(viewer: &Viewer) -> [u8; 3] {
    let [x, y, _, _] = viewer.controls.borrow()["Close message"];
    viewer.screen([(x - 4) as i16, (y - 4) as i16], [1, 1])[0]
}

fn is_red([red, green, blue]: [u8; 3]) -> bool {
    red > 100 && green < 40 && blue < 40
}

/// Catches an error that looks like success, that goes before anyone has read it or cannot be closed, a name without
/// its folder, and a message that moves what is under the hand or stays for good.
#[test]
fn messages_lie_over_the_picture_and_move_nothing() {
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    let before = viewer.picture();
    let controls = viewer.controls.borrow().clone();
    let broken = viewer.folder.join("broken.toml");
    std::fs::write(&broken, "size = 3").expect("a file");
    viewer.drop_file(&broken);
    let full_path = broken.display().to_string();
    viewer.wait_for("why it cannot be opened", |viewer| viewer.message.borrow().contains(&full_path));
    viewer.wait_for("the message", |viewer| viewer.controls.borrow().contains_key("Close message"));
    viewer.rest();
    assert!(is_red(message_color(&viewer)), "an error looks like {:?}", message_color(&viewer));
    for (name, place) in &controls {
        assert_eq!(viewer.controls.borrow()[name], *place, "the message moves {name}");
    }
    // A message that is not an error has faded after eight seconds.
    let moment = std::time::Duration::from_secs(8);
    while viewer.listen(moment).is_some() {}
    assert!(is_red(message_color(&viewer)), "an error goes by itself");
    viewer.until("closing", |viewer| viewer.picture() == before, || viewer.click_once("Close message"));

    viewer.until("saving", |viewer| viewer.message.borrow().starts_with("saved"), || viewer.press("ctrl+s"));
    let saved = viewer.folder.join("thinlens.png").canonicalize().expect("a file");
    assert_eq!(*viewer.message.borrow(), format!("saved {}", saved.display()));
    viewer.wait_for("success", |viewer| viewer.picture() != before);
    assert!(!is_red(message_color(&viewer)), "success looks like an error");
    viewer.wait_for("fading", |viewer| viewer.picture() == before);
    viewer.rest();
    viewer.close();
}

/// Catches a panel that lies over a part of the picture, a column that stays when all is hidden, and a width that is
/// forgotten.
#[test]
fn the_picture_stands_beside_the_panel() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let viewer = Viewer::start_in(folder.path(), SIZE, &["--size", "800x720", "--validation", "-n", "2"]);
    viewer.wait_until_done();
    viewer.expect_picture("all of the picture", 0, &QUICK);

    // Hidden, the picture takes the whole window.
    let is = |size: [u16; 2]| move |viewer: &Viewer| viewer.picture_size() == size;
    viewer.until("hiding", is([SIZE[0] + PANEL, SIZE[1]]), || viewer.press("h"));
    viewer.expect_picture("nothing but the picture", 0, &QUICK);
    viewer.until("showing", is(SIZE), || viewer.press("h"));

    // The edge follows the hand.
    let [x, y, width, height] = viewer.controls.borrow()["Edge of the panel"];
    let edge = [x + width / 2, y + height / 2];
    let wider = 60;
    viewer.until("a wider panel", is([SIZE[0] - wider, SIZE[1]]), || {
        viewer.drag_picture(1, edge, [edge[0] + i32::from(wider), edge[1]])
    });
    viewer.wait_until_done();
    viewer.expect_picture("a narrower picture", 0, &QUICK);
    viewer.close();
    let again = Viewer::start_in(folder.path(), SIZE, &["--validation"]);
    again.wait_until_done();
    assert_eq!(again.picture_size(), [SIZE[0] - wider, SIZE[1]], "the width is forgotten");
    again.close();
}

/// Catches a head of the panel that scrolls away, a section that opens out of sight, and folds that are forgotten.
#[test]
fn sections_scroll_under_the_sliders() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let low = [500, 680];
    let arguments = ["--size", "500x680", "--validation", "-n", "2"];
    let viewer = Viewer::start_in(folder.path(), low, &arguments);
    viewer.wait_until_done();
    let head = ["Scene", "Lens diameter", "Focal plane distance", "Autofocus", "What is sharp"];
    let places = |viewer: &Viewer| head.map(|name| viewer.controls.borrow()[name]);
    let before = places(&viewer);
    viewer.click("Viewpoint", |viewer| viewer.controls.borrow().contains_key("Reset camera"));
    viewer.rest();
    let [_, y, _, height] = viewer.controls.borrow()["Reset camera"];
    assert!(y > before[4][1] && y + height <= 680, "the section opens out of sight, at {y}");
    assert_eq!(places(&viewer), before, "what has to stay in view moves");
    viewer.close();

    let again = Viewer::start_in(folder.path(), low, &["--validation"]);
    again.wait_until_done();
    assert!(again.controls.borrow().contains_key("Reset camera"), "an open section is closed again");
    again.close();
}

/// Catches a window of half its size on a display of twice the resolution, and a size that one scale leaves to another.
#[test]
fn the_window_follows_the_scale_of_the_display() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let start = |scale: &str, picture: [u16; 2]| {
        let variables = [("WINIT_X11_SCALE_FACTOR", scale)];
        let arguments = ["suffern-boxes", "--validation", "-n", "1"];
        let viewer = Viewer::start_with(folder.path(), picture, &arguments, &variables);
        viewer.wait_until_done();
        assert_eq!(viewer.picture_size(), picture, "at scale {scale}");
        viewer
    };
    let mut viewer = start("1", [960, 720]);
    viewer.resize([500, 400]);
    viewer.close();
    start("2", [1920, 1440]).close();
    start("1", [500, 400]).close();
}

/// Catches a drawing and a legend that are left outside when the window shrinks, and a legend under the drawing.
#[test]
fn everything_stays_within_reach() {
    let viewer = Viewer::start([900, 700], &["-n", "1", "--overlay", "depth"]);
    viewer.wait_until_done();
    viewer.click("Optics", |viewer| viewer.picture_size() == [900, 380]);
    viewer.rest();
    // The legend is in the lower right corner of the picture.
    let is_dark = |viewer: &Viewer, [right, bottom]: [i16; 2]| {
        let row = viewer.screen([right - 264, bottom - 16], [240, 1]);
        row.iter().all(|pixel| pixel.iter().all(|level| *level < 90))
    };
    viewer.wait_for("the legend", |viewer| is_dark(viewer, [1220, 380]));
    viewer.xdotool("search --class thinlens windowsize 820 400");
    viewer.wait_for("a lower picture", |viewer| viewer.picture_size() == [500, 140]);
    viewer.rest();
    assert_eq!(viewer.controls.borrow()["Drawing of the optics"], [320, 140, 500, 260]);
    viewer.wait_for("the legend", |viewer| is_dark(viewer, [820, 140]));
    viewer.close();
}

/// Types a name into a field in place of what is there.
fn type_into(viewer: &Viewer, field: &str, text: &str) {
    // Without a window manager nobody else does.
    viewer.xdotool("search --class thinlens windowfocus --sync");
    let [x, y, _, height] = viewer.controls.borrow()[field];
    viewer.point([x + height, y + height / 2]);
    viewer.hands("click 1", 0);
    viewer.hands("keydown ctrl", 1);
    viewer.hands("key a", 1);
    viewer.hands("keyup ctrl", 0);
    for letter in text.chars() {
        let key = match letter {
            '/' => "slash".to_owned(),
            '~' => "asciitilde".to_owned(),
            '.' => "period".to_owned(),
            '-' => "minus".to_owned(),
            letter => letter.to_string(),
        };
        viewer.hands(&format!("key {key}"), 0);
    }
}

/// Catches a file that is replaced without a question, an answer that is not heard, and `~` that is no folder.
#[test]
fn a_typed_name_replaces_no_file_unasked() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let home = folder.path().canonicalize().expect("a folder");
    let arguments = ["--size", "500x900", "--validation", "-n", "2"];
    let variables = [("HOME", home.to_str().expect("a plain path"))];
    let viewer = Viewer::start_with(&home, [500, 900], &arguments, &variables);
    viewer.wait_until_done();
    let file = home.join("my.png");
    std::fs::write(&file, "mine").expect("a file");
    viewer.click("Files", |viewer| viewer.controls.borrow().contains_key("Save picture"));
    type_into(&viewer, "Picture file", "~/my.png");
    let has = |name: &'static str| move |viewer: &Viewer| viewer.controls.borrow().contains_key(name);
    viewer.click("Save picture", has("Replace it"));
    assert_eq!(std::fs::read(&file).expect("a file"), b"mine", "it is replaced unasked");
    let second = home.join("my-2.png");
    let said = |file: &std::path::Path| format!("saved {}", file.display());
    let says = |text: String| move |viewer: &Viewer| *viewer.message.borrow() == text;
    viewer.click("Keep both", says(said(&second)));
    assert_eq!(std::fs::read(&file).expect("a file"), b"mine", "it is not kept");
    assert!(second.exists());

    type_into(&viewer, "Picture file", "~/my.png");
    viewer.controls.borrow_mut().remove("Replace it");
    viewer.click("Save picture", has("Replace it"));
    viewer.click("Replace it", says(said(&file)));
    assert_ne!(std::fs::read(&file).expect("a file"), b"mine", "it is not replaced");
    viewer.close();
}

/// Catches a save that does not say how many points there are, and one that never comes, or comes too early.
#[test]
fn an_early_save_says_so_and_comes_again_when_done() {
    let viewer = Viewer::start([300, 720], &["-n", "150"]);
    viewer.until("a pause", |viewer| viewer.controls.borrow().contains_key("Go on"), || viewer.press("p"));
    viewer.rest();
    let (samples, _) = *viewer.shown.borrow();
    assert!(samples < 150, "{samples} points");
    viewer.until(
        "an early save",
        |viewer| viewer.message.borrow().contains("thinlens.png"),
        || viewer.press("ctrl+s"),
    );
    let early = format!("with {samples} of 150 points");
    assert!(viewer.message.borrow().contains(&early), "{}", viewer.message.borrow());
    viewer.wait_for("the offer", |viewer| viewer.controls.borrow().contains_key("Save when done"));
    viewer.click_once("Save when done");
    assert!(!viewer.folder.join("thinlens-2.png").exists(), "it is saved before it is done");
    viewer.press("p");
    viewer.wait_until_done();
    viewer.wait_for("the save", |viewer| viewer.message.borrow().ends_with("thinlens-2.png"));
    viewer.close();
}

/// Catches sliders that go away with the lens, so that everything below them jumps.
#[test]
fn a_pinhole_moves_no_control() {
    let controls = |camera: &str| {
        let viewer = Viewer::start([500, 900], &["-n", "2", "--camera", camera]);
        viewer.wait_until_done();
        let controls = viewer.controls.borrow().clone();
        let before = *viewer.state.borrow();
        if camera == "pinhole" {
            viewer.drag("Lens diameter", &[0.5, 0.6], |_| true);
            assert_eq!(*viewer.state.borrow(), before, "a pinhole has a diameter");
        }
        viewer.close();
        controls
    };
    let (lens, pinhole) = (controls("thin-lens"), controls("pinhole"));
    for name in ["Lens diameter", "Focal plane distance", "Autofocus", "What is sharp"] {
        assert_eq!(lens[name], pinhole[name], "{name} moves");
    }
}
