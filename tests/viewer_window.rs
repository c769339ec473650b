//! The viewer under Xvfb: what lies where in its window, and what it says.

mod common;

use common::viewer::Viewer;

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

    viewer.until(
        "saving",
        |viewer| viewer.message.borrow().starts_with("saved"),
        || viewer.press("ctrl+s"),
    );
    let saved = viewer.folder.join("thinlens.png").canonicalize().expect("a file");
    assert_eq!(*viewer.message.borrow(), format!("saved {}", saved.display()));
    viewer.wait_for("success", |viewer| viewer.picture() != before);
    assert!(!is_red(message_color(&viewer)), "success looks like an error");
    viewer.wait_for("fading", |viewer| viewer.picture() == before);
    viewer.rest();
    viewer.close();
}
