//! The viewer under Xvfb: a mesh that is opened by itself is turned, coloured and lit by the panel.

mod common;

use common::mesh::sphere;
use common::viewer::{PANEL, Viewer};
use common::{decode_png, render_png};
use std::path::Path;

/// As high as all rows of the section need.
const SIZE: [u16; 2] = [400, 1000];
/// Messages lie over this many rows of the picture at the most.
const HIDDEN: u16 = 200;

/// Copies the command line, and gives those of its options that say how the model is shown.
fn told(viewer: &Viewer) -> String {
    viewer.copied.borrow_mut().take();
    viewer.press("ctrl+c");
    viewer.wait_for("the command", |viewer| viewer.copied.borrow().is_some());
    let line = viewer.copied.borrow().clone().expect("a command");
    let of_model = |word: &&str| {
        ["--model-", "--ground", "--sky", "--horizon", "--light-"].iter().any(|start| word.starts_with(start))
    };
    line.split(' ').filter(of_model).collect::<Vec<_>>().join(" ")
}

/// Opens the picker of a row.
fn open_picker(viewer: &Viewer, row: &str) {
    viewer.controls.borrow_mut().remove("Picker");
    viewer.click_once(row);
    viewer.wait_for("the picker", |viewer| viewer.controls.borrow().contains_key("Picker"));
}

/// Chooses a colour whose place is this share of the picker, and closes the picker.
fn pick_color(viewer: &Viewer, row: &str, share: [f64; 2]) {
    open_picker(viewer, row);
    let [x, y, width, height] = viewer.controls.borrow()["Picker"];
    let at = [(x, width), (y, height)];
    let at = [0, 1].map(|axis| at[axis].0 + (f64::from(at[axis].1) * share[axis]) as i32);
    viewer.point(at);
    viewer.hands("mousedown 1", 1);
    viewer.hands("mouseup 1", 0);
    viewer.press("Escape");
    viewer.point_away();
}

fn shown(viewer: &Viewer) -> Vec<[u8; 3]> {
    viewer.wait_until_done();
    viewer.screen([320, HIDDEN.cast_signed()], [SIZE[0], SIZE[1] - HIDDEN])
}

fn rendered(folder: &Path, arguments: &[&str]) -> Vec<[u8; 3]> {
    let (_, pixels) = decode_png(&render_png(folder, &[arguments, &["-n", "2", "-s", "400x1000"]].concat()));
    pixels[usize::from(HIDDEN) * usize::from(SIZE[0])..].to_vec()
}

/// Catches a row of the panel that does nothing or something else, a change that cannot be undone or takes others with
/// it, a picture in the window that is not that of the command or of the saved scene, and rows of a model for a scene
/// that is none.
#[test]
fn a_model_is_turned_coloured_and_lit_by_the_panel() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let obj =
        sphere(6, false, false) + "v 0.2 2 0.1\nv 1 0 0.3\nv 0 0 1\nv -0.9 0 -0.3\nf -4 -3 -2\nf -4 -2 -1\n";
    std::fs::write(folder.path().join("some.obj"), obj).expect("a mesh");
    let viewer =
        Viewer::start_in(folder.path(), SIZE, &["--validation", "--size", "400x1000", "-n", "2", "some.obj"]);
    let plain = shown(&viewer);
    assert!(plain == rendered(folder.path(), &["some.obj"]), "the window shows another picture");
    assert_eq!(told(&viewer), "");

    // Each change gives another picture, and is the only thing that undo takes back.
    let mut pictures = vec![plain];
    let mut step = |what: &str, act: &dyn Fn()| {
        let before = told(&viewer);
        act();
        let (now, picture) = (told(&viewer), shown(&viewer));
        assert!(now.contains(what), "{what} is not in {now:?}");
        assert!(!pictures.contains(&picture), "{what} does not show");
        viewer.press("ctrl+z");
        assert_eq!(told(&viewer), before, "undo of {what}");
        assert!(shown(&viewer) == *pictures.last().expect("a picture"), "undo of {what}");
        viewer.press("ctrl+shift+z");
        assert_eq!(told(&viewer), now, "redo of {what}");
        assert!(shown(&viewer) == picture, "redo of {what}");
        pictures.push(picture);
    };
    let choose = |row: &'static str, choice: &'static str| {
        viewer.controls.borrow_mut().remove(choice);
        viewer.click(row, |viewer| viewer.controls.borrow().contains_key(choice));
        viewer.click_once(choice);
    };
    step("--model-up=z", &|| choose("Axis that points up", "z points up"));
    step("--model-turn=", &|| viewer.drag("Turn", &[0.5, 0.7, 0.8], |_| true));
    step("--model-color=", &|| pick_color(&viewer, "Colour", [0.2, 0.7]));
    step("--model-material=glossy", &|| choose("Material", "Glossy"));
    step("--sky=", &|| pick_color(&viewer, "Sky", [0.7, 0.3]));
    step("--light-direction=", &|| viewer.drag("Light from", &[0.4, 0.5, 0.7], |_| true));
    step("--light-direction=", &|| viewer.drag("Height of the light", &[0.5, 0.4, 0.2], |_| true));
    step("--light-strength=", &|| viewer.drag("Strength of the light", &[0.5, 0.6, 0.7], |_| true));
    step("--ground=false", &|| viewer.click_once("Ground"));
    step("--horizon=", &|| pick_color(&viewer, "Horizon", [0.3, 0.6]));

    // The command and the saved scene give the picture that the window shows.
    let last = shown(&viewer);
    let command = told(&viewer);
    let words: Vec<&str> = ["some.obj"].into_iter().chain(command.split(' ')).collect();
    assert!(last == rendered(folder.path(), &words), "the command gives another picture");
    viewer.until(
        "the scene",
        |viewer| viewer.message.borrow().starts_with("saved "),
        || viewer.press("ctrl+shift+s"),
    );
    assert!(last == rendered(folder.path(), &["scene.toml"]), "the saved scene is another picture");
    viewer.close();
}

/// Catches a picker that covers the panel or leaves the window, on the displays of one and of two pixels per point, one
/// that cannot be closed, a click in the picture that does more than to close it, and a click on a control that does only
/// that.
#[test]
fn a_colour_is_chosen_beside_the_panel() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("some.obj"), sphere(2, false, false)).expect("a mesh");
    // Only the section of the model is open, and its last rows stand low in the window.
    Viewer::remember(folder.path(), "{\"greeted\": true, \"folds\": {\"What is sharp\": false}}");
    let rows = ["Colour", "Sky", "Horizon"];
    for (scale, size, rows) in [(1, [400, 640], &rows[..]), (2, [640, 1024], &rows[..1])] {
        let (factor, size_argument) = (scale.to_string(), format!("{}x{}", size[0], size[1]));
        let viewer = Viewer::start_with(
            folder.path(),
            size,
            &["--validation", "--size", &size_argument, "-n", "2", "some.obj"],
            &[("WINIT_X11_SCALE_FACTOR", &factor)],
        );
        viewer.wait_until_done();
        let window = [PANEL * scale + viewer.picture_size()[0], viewer.picture_size()[1]];
        let screen = || {
            viewer.rest();
            viewer.screen([0, 0], window)
        };
        for row in rows {
            let place = viewer.controls.borrow()[*row];
            assert!(place[1] + place[3] <= i32::from(window[1]), "{row} is out of view");
            let before = screen();
            let right = i32::from(window[0]) - 10;
            let close_by: [&dyn Fn(); 4] =
                [&|| viewer.click_once(row), &|| viewer.press("Escape"), &|| viewer.point([4, 4]), &|| {
                    viewer.point([right, 10])
                }];
            for (number, close) in close_by.into_iter().enumerate() {
                open_picker(&viewer, row);
                viewer.rest();
                let [x, y, width, height] = viewer.controls.borrow()["Window of the picker"];
                assert!(
                    x >= i32::from(PANEL * scale),
                    "the picker of {row} covers the panel at {x}, scale {scale}"
                );
                let ends = [x + width, y + height];
                let is_within =
                    y >= 0 && [0, 1].into_iter().all(|axis| ends[axis] <= i32::from(window[axis]));
                assert!(is_within, "the picker of {row} ends at {ends:?} in {window:?}, scale {scale}");
                let edge = [x, y + height / 2].map(|at| i16::try_from(at).expect("on the screen"));
                let across: Vec<u8> = viewer.screen(edge, [4, 1]).into_iter().map(|[red, ..]| red).collect();
                assert!(across[0] > across[3] + 20, "the picker of {row} has no edge: {across:?}");
                close();
                if number >= 2 {
                    viewer.hands("mousedown 1", 1);
                    viewer.hands("mouseup 1", 0);
                }
                viewer.point_away();
                // What is clicked in the picture is named above the place of the picker.
                let from = if number == 3 { usize::from(window[0]) * y as usize } else { 0 };
                assert!(
                    screen()[from..] == before[from..],
                    "the picker of {row} is not closed in way {number}, scale {scale}"
                );
            }
        }
        let picture = || {
            viewer.rest();
            viewer.screen([(PANEL * scale).cast_signed(), 0], viewer.picture_size())
        };
        let (before, [diameter, ..]) = (picture(), *viewer.state.borrow());
        open_picker(&viewer, "Colour");
        viewer.drag("Lens diameter", &[0.2, 0.4], |viewer| viewer.state.borrow()[0] != diameter);
        viewer.press("ctrl+z");
        assert!(picture() == before, "a control leaves the picker open, scale {scale}");
        viewer.close();
    }
}
