//! The viewer under Xvfb: pictures of another size than the window's.

mod common;

use common::viewer::Viewer;
use common::{decode_png, render_png};

const SIZE: [u16; 2] = [900, 1000];

/// Catches a shown picture that has other proportions than the file, a file of another size or with other settings, and
/// a rendering that is not stopped or leaves something behind.
#[test]
fn a_picture_is_rendered_in_another_size_than_the_windows() {
    let viewer = Viewer::start(SIZE, &["-n", "2"]);
    viewer.wait_until_done();
    viewer.click("Output", |viewer| viewer.controls.borrow().contains_key("Render to file"));
    viewer.click("Size of the picture", |viewer| viewer.controls.borrow().contains_key("1280 x 720"));
    viewer.click_once("1280 x 720");
    viewer.wait_until_done();
    // 900 pixels wide, and so 506 high, in the middle.
    let around = [viewer.screen([320, 0], [900, 247]), viewer.screen([320, 753], [900, 247])];
    assert!(around.concat().iter().all(|pixel| pixel.iter().all(|level| *level < 40)), "it is not 16:9");
    let inside = viewer.screen([320, 247], [900, 506]);
    let (size, expected) = decode_png(&render_png(&viewer.folder, &["-n", "2", "-s", "900x506"]));
    assert_eq!(size, [900, 506]);
    assert_eq!(inside.len(), expected.len());
    assert!(inside == expected, "the shown picture is another one");

    let file = viewer.folder.join("thinlens.png");
    viewer.until(
        "the picture",
        |viewer| viewer.message.borrow().starts_with("rendered "),
        || viewer.click_once("Render to file"),
    );
    let written = decode_png(&std::fs::read(&file).expect("the picture"));
    assert!(
        written == decode_png(&render_png(&viewer.folder, &["-n", "2", "-s", "1280x720"])),
        "another picture"
    );

    // With so many points, it does not end by itself.
    viewer.drag("Points per pixel", &[0.5, 1.0], |viewer| viewer.shown.borrow().1 > 1000);
    let before = viewer.folder.read_dir().expect("a folder").count();
    viewer.click("Render to file", |viewer| viewer.controls.borrow().contains_key("Stop rendering"));
    viewer.wait_for("what it begins to write", |viewer| {
        viewer.folder.read_dir().expect("a folder").count() > before
    });
    viewer.controls.borrow_mut().remove("Render to file");
    viewer.click_once("Stop rendering");
    viewer.wait_for("the end", |viewer| viewer.controls.borrow().contains_key("Render to file"));
    assert_eq!(viewer.folder.read_dir().expect("a folder").count(), before, "something is left");
    viewer.close();
}
