//! The viewer under Xvfb: files that are chosen in a dialog of the system.
//!
//! There is no desktop under Xvfb, and so no portal that opens dialogs. Where there is none, the program `zenity` is
//! asked, in whose place these tests put one of their own.
#![cfg(unix)]

mod common;

use common::viewer::Viewer;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

const SIZE: [u16; 2] = [400, 1000];

/// Starts the viewer where no portal is, with a zenity that does what this script says, if there is one.
fn start(folder: &Path, script: Option<&str>) -> Viewer {
    let programs = folder.join("programs");
    std::fs::create_dir_all(&programs).expect("a folder");
    if let Some(script) = script {
        let zenity = programs.join("zenity");
        std::fs::write(&zenity, format!("#!/bin/sh\n{script}\n")).expect("a script");
        std::fs::set_permissions(&zenity, std::fs::Permissions::from_mode(0o755)).expect("it can be run");
    }
    // What the script itself calls is found by its whole path.
    let path = programs.to_str().expect("a plain path").to_owned();
    let variables = [("PATH", &*path), ("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nowhere")];
    let arguments = ["--validation", "--size", "400x1000", "-n", "2", "passing"];
    let viewer = Viewer::start_with(folder, SIZE, &arguments, &variables);
    viewer.wait_until_done();
    viewer
}

fn message(viewer: &Viewer, start: &str) -> bool {
    viewer.message.borrow().starts_with(start)
}

/// Catches a button that does nothing where no dialog can be opened, a message that does not say what to do instead, and
/// a field that then does not work.
#[test]
fn without_dialogs_the_viewer_says_so_and_takes_typed_paths() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let viewer = start(folder.path(), None);
    viewer.until(
        "the message",
        |viewer| message(viewer, "No dialog can be opened here"),
        || viewer.press("ctrl+o"),
    );
    assert!(viewer.message.borrow().contains("Type the path under Files, or drop"));
    viewer.click("Files", |viewer| viewer.controls.borrow().contains_key("Open"));
    for button in ["Open file ...", "Save picture as ...", "Save scene as ..."] {
        viewer.message.borrow_mut().clear();
        viewer.click(button, |viewer| message(viewer, "No dialog can be opened here"));
    }
    viewer.click_once("Open");
    viewer.xdotool("type --delay 0 version-4");
    viewer.press("Return");
    viewer.wait_for("the scene", |viewer| viewer.opened.borrow().ends_with("version-4"));
    viewer.close();
}

/// Catches a viewer that stands still while a dialog is open, a file that is not opened or is saved elsewhere, a question
/// that the dialog has asked already, and one that nobody has asked.
#[test]
fn a_file_is_chosen_in_a_dialog_while_the_viewer_goes_on() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    let text = include_str!("../src/scene/builtin/suffern-boxes.toml");
    std::fs::write(at("boxes.toml"), text).expect("a scene");
    // It notes how it was called, waits until it may end, and chooses what the test wants.
    let script = format!(
        "cd '{}'\necho \"$@\" > called\nuntil [ -e may-end ]; do /bin/sleep 0.02; done\n\
         /bin/rm may-end\nif [ -e choice ]; then /bin/cat choice; else exit 1; fi",
        folder.path().display()
    );
    let viewer = start(folder.path(), Some(&script));
    viewer.click("Files", |viewer| viewer.controls.borrow().contains_key("Open file ..."));
    // While the dialog is open, a slider moves and the picture follows.
    let forth = std::cell::Cell::new(false);
    let during = |button: &str, choice: Option<&Path>| {
        let _ = std::fs::remove_file(at("called"));
        let _ = std::fs::remove_file(at("choice"));
        viewer.message.borrow_mut().clear();
        viewer.click_once(button);
        viewer.wait_for("the dialog", |_| at("called").exists());
        let before = viewer.state.borrow()[0];
        forth.set(!forth.get());
        let [from, to] = if forth.get() { [0.3, 0.6] } else { [0.6, 0.3] };
        viewer.drag("Lens diameter", &[from, to], |viewer| viewer.state.borrow()[0] != before);
        viewer.wait_until_done();
        if let Some(choice) = choice {
            std::fs::write(at("choice"), choice.to_str().expect("a plain path")).expect("a choice");
        }
        std::fs::write(at("may-end"), "").expect("a file");
        std::fs::read_to_string(at("called")).expect("how it was called")
    };
    // Who changes their mind is not bothered. Another dialog opens only once the viewer knows that the first has ended.
    during("Open file ...", None);
    viewer.wait_for("the end of the dialog", |_| !at("may-end").exists());
    std::fs::remove_file(at("called")).expect("a file");
    for _ in 0..100 {
        if !at("called").exists() {
            viewer.click_once("Open file ...");
            viewer.rest();
        }
    }
    assert!(at("called").exists(), "no other dialog opens");
    assert_eq!(*viewer.message.borrow(), "");
    std::fs::write(at("may-end"), "").expect("a file");
    viewer.wait_for("the end of the dialog", |_| !at("may-end").exists());
    viewer.point_away();

    let called = during("Save picture as ...", Some(&at("chosen.png")));
    assert!(called.contains("--save") && called.contains("thinlens.png"), "{called}");
    viewer.wait_for("the picture", |viewer| message(viewer, "saved ") && at("chosen.png").exists());
    assert!(viewer.message.borrow().contains("chosen.png"));
    // The dialog has asked whether to replace it, and nobody has asked about a name with another ending.
    std::fs::write(at("chosen.png"), "not a picture").expect("a file");
    during("Save picture as ...", Some(&at("chosen.png")));
    viewer.wait_for("the picture", |viewer| message(viewer, "saved "));
    assert!(std::fs::read(at("chosen.png")).expect("a file").starts_with(b"\x89PNG"));
    during("Save picture as ...", Some(&at("chosen")));
    viewer.wait_for("the question", |viewer| viewer.message.borrow().contains("chosen.png is there already"));

    during("Save scene as ...", Some(&at("mine")));
    viewer.wait_for("the scene", |viewer| message(viewer, "saved ") && at("mine.toml").exists());
    during("Open file ...", Some(&at("boxes.toml")));
    viewer.wait_for("another scene", |viewer| viewer.opened.borrow().ends_with("boxes.toml"));
    viewer.close();
}
