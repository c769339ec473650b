//! The viewer under Xvfb: the drawing of the optics.

mod common;

use common::viewer::{PANEL, Viewer};
use common::{decode_png, render_png, run};
use thinlens::scene;

const SIZE: [u16; 2] = [800, 720];
/// The size of the picture when the drawing stands below it.
const OPEN: [u16; 2] = [800, 400];

/// A pixel of this picture at the edge of a sphere.
const EDGE: [u16; 2] = [299, 190];

/// A wide open picture of the scene, which is quick.
const QUICK: [&str; 2] = ["-n", "2"];

/// Catches a drawing of another pixel than the one that was clicked, or of another lens.
#[test]
fn the_optics_are_those_of_the_pixel_that_was_clicked() {
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    viewer.click("Optics", |viewer| viewer.diagram.borrow().is_some());
    let scene = scene::load("version-4").expect("a built-in scene");
    let expect = |pixel: [f32; 2], focal_distance: f32| {
        let half = (0.5 * scene.camera.vfov_radians).tan();
        let [width, height] = OPEN.map(f64::from);
        let [x, y] = pixel.map(f64::from);
        let f = f64::from(focal_distance);
        let p = [f * half * (2.0 * x - width) / height, f * half * (1.0 - 2.0 * y / height), f];
        viewer.wait_for("the optics", |viewer| {
            viewer.diagram.borrow().is_some_and(|(drawn, at)| {
                drawn == pixel && (0..3).all(|axis| (at[axis] - p[axis]).abs() < 1e-4 * f)
            })
        });
    };
    expect([400.5, 200.5], scene.lens.focal_distance);
    viewer.until(
        "clicking",
        |viewer| viewer.diagram.borrow().is_some_and(|(pixel, _)| pixel == [650.5, 201.5]),
        || {
            viewer.point(Viewer::in_window([650, 201]));
            viewer.hands("click 1", 0);
        },
    );
    viewer.drag("Focal plane distance", &[0.5, 0.55, 0.6], |viewer| {
        viewer.state.borrow()[1] > 1.1 * scene.lens.focal_distance
    });
    expect([650.5, 201.5], viewer.state.borrow()[1]);
    viewer.close();
}

/// Catches a drawing in the viewer that is not the one that the command line saves.
#[test]
fn the_drawing_in_the_viewer_is_the_saved_one() {
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    viewer.click("Optics", |viewer| viewer.controls.borrow().contains_key("Save drawing"));
    let read = |name: &str| std::fs::read_to_string(viewer.folder.join(name));
    viewer.wait_until_done();
    let picture_size = format!("{}x{}", OPEN[0], OPEN[1]);
    let render = ["render", "-q", "-s", &picture_size, QUICK[0], QUICK[1], "-o", "whole.png"];
    assert_eq!(run(&viewer.folder, &render).code, 0);
    let saved = |above: &str, file: &str, more: &[&str]| {
        viewer.click("Save drawing", |_| read(file).is_ok());
        viewer.wait_for("saving", |viewer| viewer.message.borrow().contains(file));
        let text = read(file).expect("it is saved");
        let size = text.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next());
        let drawing_size = size.expect("a size").replace(' ', "x");
        let options = [
            "diagram",
            "-q",
            "-o",
            "same.svg",
            "-s",
            &picture_size,
            "--drawing-size",
            &drawing_size,
            "--picture",
            "whole.png",
        ];
        let ran = run(&viewer.folder, &[&options[..], more].concat());
        assert_eq!(ran.code, 0, "{}", ran.stderr);
        assert!(
            read("same.svg").expect("a drawing") == text,
            "{above} differs from what the command line draws"
        );
    };
    saved("the side view", "lens.svg", &[]);
    viewer.click("Save drawing as PNG", |viewer| viewer.message.borrow().contains("lens.png"));
    let size = read("lens.svg").ok().and_then(|text| {
        let size = text.split("viewBox=\"0 0 ").nth(1)?.split('"').next()?.to_owned();
        size.split(' ').map(|extent| extent.parse().ok()).collect::<Option<Vec<u32>>>()
    });
    let png = decode_png(&std::fs::read(viewer.folder.join("lens.png")).expect("a PNG"));
    assert_eq!(png.0.map(|extent| extent / 2).to_vec(), size.expect("a size"));
    viewer.click("To scale", |_| true);
    viewer.rest();
    saved("the view to scale", "lens-2.svg", &["--to-scale"]);
    viewer.click("Drawing", |viewer| viewer.controls.borrow().contains_key("From above"));
    viewer.click_once("From above");
    viewer.rest();
    saved("the view from above", "lens-3.svg", &["--to-scale", "--view", "above"]);
    viewer.close();
}

/// Catches pixels in the drawing that are not those of the picture, that stand at another place, or that stay as they were
/// when the picture changes.
#[test]
fn the_drawing_shows_the_pixels_of_the_picture() {
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    viewer.click("Optics", |viewer| viewer.controls.borrow().contains_key("Pixel in the drawing"));
    let size = format!("{}x{}", OPEN[0], OPEN[1]);
    let expect = |pixel: [u16; 2], options: &[&str]| {
        let [x, y] = pixel.map(usize::from);
        viewer.wait_until_done();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let picture = render_png(folder.path(), &[&["--size", &size], &QUICK[..], options].concat());
        let picture = decode_png(&picture).1;
        let [left, top, width, height] = viewer.controls.borrow()["Pixel in the drawing"];
        assert!(width >= 6 && (width - height).abs() <= 1, "a pixel is {width} by {height}");
        let mut colors = std::collections::BTreeSet::new();
        // The pixel itself has a frame, and is looked at beside its middle, where no line is.
        for (right, down) in (-2..=2_i32).flat_map(|right| (-2..=2_i32).map(move |down| (right, down))) {
            let at = [left + width / 2 + right * width, top + height / 2 + down * height];
            let shown = viewer.screen(at.map(|at| at as i16), [1, 1])[0];
            let column = x.checked_add_signed(right as isize).expect("within the picture");
            let row = y.checked_add_signed(down as isize).expect("within the picture");
            let expected = picture[row * usize::from(OPEN[0]) + column];
            assert_eq!(shown, expected, "{right} to the right of {x}, {down} below {y}");
            colors.insert(shown);
        }
        assert!(colors.len() > 4, "only {colors:?}");
    };
    // The edge of the sphere.
    expect([400, 200], &[]);
    let place = EDGE.map(i32::from);
    viewer.until(
        "clicking",
        |viewer| viewer.diagram.borrow().is_some_and(|(pixel, _)| pixel == place.map(|at| at as f32 + 0.5)),
        || {
            viewer.point([place[0] + i32::from(PANEL), place[1]]);
            viewer.hands("click 1", 0);
        },
    );
    viewer.point_away();
    expect(EDGE, &[]);
    let before = viewer.state.borrow()[0];
    viewer.drag("Lens diameter", &[0.2, 0.15, 0.1], |viewer| viewer.state.borrow()[0] < 0.9 * before);
    let diameter = viewer.state.borrow()[0].to_string();
    expect(EDGE, &["--lens-diameter", &diameter]);
    viewer.close();
}

/// Catches a drawing that lies over the picture, a picture that is not refitted, a legend or a strip out of reach, and a
/// height that is forgotten.
#[test]
fn the_drawing_stands_below_the_picture() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = ["--size", "800x720", "--validation", "-n", "2"];
    let viewer = Viewer::start_in(folder.path(), SIZE, &options);
    viewer.wait_until_done();
    let is = |size: [u16; 2]| move |viewer: &Viewer| viewer.picture_size() == size;
    viewer.click("Optics", is(OPEN));
    viewer.wait_until_done();
    // The mark of the pixel whose optics are drawn is in the middle.
    viewer.expect_rows("the picture", 190, 0, &QUICK);
    let strip = || viewer.controls.borrow()["Drawing of the optics"];
    let below = [PANEL, OPEN[1], OPEN[0], SIZE[1] - OPEN[1]].map(i32::from);
    assert_eq!(strip(), below);

    // The edge follows the hand, and the strip goes with the rest.
    let [x, y, width, height] = viewer.controls.borrow()["Edge of the drawing"];
    let edge = [x + width / 2, y + height / 2];
    viewer.until("a lower strip", is([OPEN[0], OPEN[1] + 60]), || {
        viewer.drag_picture(1, edge, [edge[0], edge[1] + 60])
    });
    viewer.until("hiding", is([SIZE[0] + PANEL, SIZE[1]]), || viewer.press("h"));
    viewer.until("showing", is([OPEN[0], OPEN[1] + 60]), || viewer.press("h"));
    viewer.close();

    let again = Viewer::start_in(folder.path(), SIZE, &["--validation"]);
    again.wait_until_done();
    assert_eq!(again.picture_size(), [OPEN[0], OPEN[1] + 60], "the height is forgotten");
    again.click("Optics", is(SIZE));
    again.close();
}

/// Catches a button that keeps another point than the one that is drawn, that keeps it twice or over another one, or that
/// forgets only a part; kept light in the colour of another place; and a drawing that moves when the second button appears.
#[test]
fn the_light_of_points_is_kept_and_forgotten() {
    const POINT: &str = "Point in the drawing";
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    viewer.click("Optics", |viewer| viewer.controls.borrow().contains_key(POINT));
    viewer.rest();
    let saved = |file: &str| {
        viewer.click("Save drawing", |viewer| viewer.message.borrow().contains(file));
        std::fs::read_to_string(viewer.folder.join(file)).expect("it is saved")
    };
    // The depths that follow a name, each with its colour.
    let named = |text: &str, name: &str| -> Vec<(f64, String)> {
        let name = format!(">{name}: ");
        let lines = text.lines().filter_map(|line| line.split_once(&name));
        let depth = |rest: &str| rest.split([' ', ',', '<']).next().and_then(|depth| depth.parse().ok());
        let color = |tag: &str| tag.split("fill=\"").nth(1).map(|color| color[..7].to_owned());
        lines.map(|(tag, rest)| (depth(rest).expect("a depth"), color(tag).expect("a colour"))).collect()
    };
    let keep = || {
        viewer.click("Keep", |_| true);
        viewer.rest();
    };
    let move_to = |share: f64| {
        let [x, y, ..] = viewer.controls.borrow()[POINT];
        let [rim_x, _, width, _] = viewer.controls.borrow()["Rim in the drawing"];
        let lens = rim_x + width / 2;
        let to = lens + (f64::from(x - lens) * share).round() as i32;
        viewer.drag_picture(1, [x, y], [to, y]);
        viewer.rest();
    };
    let alone = saved("lens.svg");
    let found = named(&alone, "silver")[0].0;
    keep();
    move_to(0.5);
    keep();
    move_to(2.2);
    // There is no room for a third one.
    keep();
    let text = saved("lens-2.svg");
    let size = |text: &str| {
        text.split("viewBox=\"").nth(1).and_then(|rest| rest.split('"').next().map(str::to_owned))
    };
    assert!(size(&text) == size(&alone), "the drawing makes room for a line that is not there");
    let (mut kept, moved) = (named(&text, "kept"), named(&text, "moved point"));
    kept.sort_by(|a, b| a.0.total_cmp(&b.0));
    let depths: Vec<f64> = kept.iter().map(|(depth, _)| *depth).collect();
    let is_half = |depth: f64| (depth / found - 0.5).abs() < 0.01;
    assert!(depths.len() == 2 && is_half(depths[0]) && depths[1] == found, "kept at {depths:?}");
    assert!(moved.len() == 1 && moved[0].0 / found > 1.05, "moved to {moved:?}");
    // Red less blue.
    let warmth = |color: &str| {
        let [red, blue] = [1, 5].map(|at| i32::from_str_radix(&color[at..at + 2], 16).expect("a level"));
        red - blue
    };
    // The focal plane lies between the sphere and the moved point.
    let [nearest, near, behind] = [&kept[0], &kept[1], &moved[0]].map(|(_, color)| warmth(color));
    assert!(nearest < 0 && near < 0 && behind > 0, "{kept:?}, {moved:?}");

    viewer.click("Forget", |_| true);
    viewer.rest();
    let text = saved("lens-3.svg");
    assert!(named(&text, "kept").is_empty() && named(&text, "moved point").len() == 1, "{text}");
    viewer.close();
}

/// Catches a part of the drawing that cannot be moved, that moves something else, or that does not stay under the
/// pointer; and a drag that is undone in more than one step.
#[test]
fn parts_of_the_drawing_are_moved_by_hand() {
    const PLANE: &str = "Focal plane in the drawing";
    const RIM: &str = "Rim in the drawing";
    const FILM: &str = "Film in the drawing";
    const POINT: &str = "Point in the drawing";
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    viewer.xdotool("search --class thinlens windowfocus --sync");
    viewer.click("Optics", |viewer| viewer.controls.borrow().contains_key(PLANE));
    viewer.rest();
    let at = |name: &str| viewer.controls.borrow()[name];
    let places @ [[plane_x, top, _, height], [rim_x, rim_y, width, _], [film_x, ..], [point_x, point_y, ..]] =
        [PLANE, RIM, FILM, POINT].map(at);
    let undo = || {
        viewer.press("ctrl+z");
        viewer.rest();
        assert_eq!([PLANE, RIM, FILM, POINT].map(at), places, "one undo takes the drag back");
    };
    let [diameter, focal_distance, jitter] = *viewer.state.borrow();
    let view = viewer.view.borrow().clone();
    let (lens, axis, level) = (rim_x + width / 2, top + height / 2, top + height / 8);
    // Each one is grasped a little beside it, and moved half of the way to the lens.
    let drag = |from: [i32; 2], to: [i32; 2]| {
        viewer.drag_picture(1, from, to);
        viewer.rest();
    };

    drag([plane_x + 3, level], [(plane_x + lens) / 2 + 3, level]);
    let [same, nearer, _] = *viewer.state.borrow();
    assert!((nearer / focal_distance - 0.5).abs() < 0.01, "the focal plane is at {nearer}");
    assert!(same == diameter && *viewer.view.borrow() == view, "only the focal plane moves");
    undo();

    drag([rim_x, rim_y + 2], [rim_x, (rim_y + axis) / 2 + 2]);
    let [narrow, same, _] = *viewer.state.borrow();
    // The places are known to a pixel.
    let pixel = ((axis - rim_y) as f32).recip();
    assert!((narrow / diameter - 0.5).abs() < 1.5 * pixel, "the lens is {narrow} wide");
    assert!(same == focal_distance && *viewer.view.borrow() == view, "only the rim moves");
    undo();

    drag([film_x - 3, level], [(film_x + lens) / 2 - 3, level]);
    let half_tangent = |view: &str| {
        let degrees = view.split_whitespace().nth(1).and_then(|degrees| degrees.parse::<f64>().ok());
        (0.5 * degrees.expect("a field of view").to_radians()).tan()
    };
    let ratio = half_tangent(&viewer.view.borrow()) / half_tangent(&view);
    assert!((ratio - 2.0).abs() < 0.05, "the field of view is {} times as large", ratio);
    assert_eq!(viewer.state.borrow()[1], focal_distance, "the focal plane stays where it is");
    undo();

    // While a part is held, the others keep their places, wherever it is moved. Afterwards the drawing fills its strip.
    let others = || [RIM, FILM, POINT].map(|name| at(name)[0]);
    let before = others();
    viewer.point([plane_x, level]);
    viewer.hands("mousedown 1", 1);
    for farther in [1, 2, 3] {
        viewer.point([plane_x + farther * (plane_x - lens) / 20, level]);
        assert_eq!(others(), before, "the drawing is refitted while the focal plane is moved");
    }
    viewer.hands("mouseup 1", 0);
    viewer.rest();
    assert!(at(POINT)[0] < before[2] - 5, "the drawing ends before the focal plane");
    undo();

    let depth = |file: &str, name: &str| -> f64 {
        viewer.click("Save drawing", |viewer| viewer.message.borrow().contains(file));
        let text = std::fs::read_to_string(viewer.folder.join(file)).expect("it is saved");
        let words = text.split(&format!(">{name}: ")).nth(1).unwrap_or_else(|| panic!("no {name} in {text}"));
        words.split([' ', '<']).next().and_then(|depth| depth.parse().ok()).expect("a depth")
    };
    let found = depth("lens.svg", "silver");
    drag([point_x, point_y], [(point_x + lens) / 2, point_y]);
    let half_way = depth("lens-2.svg", "moved point");
    assert!((half_way / found - 0.5).abs() < 0.01, "the point is at {half_way}, and was at {found}");
    assert_eq!(*viewer.state.borrow(), [diameter, focal_distance, jitter], "the settings stay as they are");
    undo();
    viewer.close();
}

/// Catches a tilted focal plane that does not stay under the pointer, or that can be grasped only where an upright one would
/// stand.
#[test]
fn a_tilted_focal_plane_is_moved_by_hand() {
    const PLANE: &str = "Focal plane in the drawing";
    let viewer = Viewer::start(SIZE, &[&QUICK[..], &["--lens-tilt", "6"]].concat());
    viewer.wait_until_done();
    viewer.xdotool("search --class thinlens windowfocus --sync");
    viewer.click("Optics", |viewer| viewer.controls.borrow().contains_key(PLANE));
    viewer.rest();
    let line = || viewer.controls.borrow()[PLANE];
    let [x, y, right, down] = line();
    assert!(right.abs() > 20, "it leans by {right}");
    let level = y + down / 4;
    let from = [x + right / 4, level];
    let before = viewer.state.borrow()[1];
    let place = |level: i32| {
        let [x, y, right, down] = line();
        f64::from(x) + f64::from(right) * f64::from(level - y) / f64::from(down)
    };
    viewer.point(from);
    viewer.hands("mousedown 1", 1);
    for step in 1..=4 {
        let x = from[0] - 10 * step;
        viewer.point([x, level]);
        // The drawing is of the last picture.
        viewer.wait_for("the focal plane", |_| (place(level) - f64::from(x)).abs() < 2.5);
    }
    viewer.hands("mouseup 1", 0);
    viewer.rest();
    assert!(viewer.state.borrow()[1] < before, "it is focused nearer");
    viewer.close();
}
