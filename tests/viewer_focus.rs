//! The viewer under Xvfb: the mouse over the picture, focus that follows, and lenses that are chosen by clicks.

mod common;

use common::viewer::Viewer;
use common::{circle_of_confusion, met, seen};
use glam::DVec3;
use thinlens::scene::{self, CameraModel, SceneRef};
use thinlens::settings::{Estimator, Settings};

const SIZE: [u16; 2] = [900, 1000];
const QUICK: [&str; 2] = ["-n", "2"];

/// What the viewer shows at first.
fn shown() -> Estimator {
    let scene = scene::load("version-4").expect("a built-in scene");
    let mut estimator = Settings::of_scene(SceneRef::new(scene)).estimator;
    estimator.size = SIZE.map(u32::from);
    estimator
}

/// The same with the camera where the viewer has it now.
fn now(viewer: &Viewer, estimator: &Estimator) -> Estimator {
    let mut estimator = estimator.clone();
    let [eye, look_at] = [0, 3].map(|first| {
        DVec3::from_array(std::array::from_fn(|axis| f64::from(viewer.camera.borrow()[first + axis])))
    });
    (estimator.camera.eye, estimator.camera.look_at) = (eye, look_at);
    estimator
}

/// Every eighth pixel where a material is seen.
fn places(estimator: &Estimator, material: &str) -> Vec<[u32; 2]> {
    let [width, height] = estimator.size;
    let all = (4..height).step_by(8).flat_map(|y| (4..width).step_by(8).map(move |x| [x, y]));
    all.filter(|pixel| seen(estimator, *pixel, [0.0; 2]).is_some_and(|(_, name)| name == material)).collect()
}

/// The middle of what is seen of a material in the whole picture.
fn middle(estimator: &Estimator, material: &str) -> [f64; 2] {
    let [width, height] = estimator.size;
    let all = (4..height).step_by(8).flat_map(|y| (4..width).step_by(8).map(move |x| [x, y]));
    let seen: Vec<[u32; 2]> = all
        .filter(|pixel| seen(estimator, *pixel, [0.0; 2]).is_some_and(|(_, name)| name == material))
        .collect();
    assert!(seen.len() > 10, "{} places show {material}", seen.len());
    [0, 1].map(|axis| seen.iter().map(|pixel| f64::from(pixel[axis])).sum::<f64>() / seen.len() as f64)
}

/// A place in the midst of what is seen of a material.
fn place(estimator: &Estimator, material: &str) -> [u32; 2] {
    let is = |pixel| seen(estimator, pixel, [0.0; 2]).is_some_and(|(_, name)| name == material);
    let around = |[x, y]: [u32; 2]| [[x - 8, y], [x + 8, y], [x, y - 8], [x, y + 8]].into_iter().all(is);
    let found = places(estimator, material).into_iter().find(|pixel| around(*pixel));
    found.unwrap_or_else(|| panic!("no {material} in sight"))
}

/// The point of the world that is seen at a pixel, and its depth.
fn point(estimator: &Estimator, pixel: [u32; 2]) -> (DVec3, f64) {
    let (depth, hit) = met(estimator, pixel, [0.0; 2]).expect("a surface");
    let [width, height] = estimator.size.map(f64::from);
    let [x, y] = pixel.map(|at| f64::from(at) + 0.5);
    let (camera, frame) = (&estimator.camera, estimator.camera.frame());
    let k = camera.view_distance_pixels(estimator.size[1]);
    let ray = (x - 0.5 * width) / k * frame.u() - (y - 0.5 * height) / k * frame.v() - frame.w();
    assert!((hit.distance / (depth * ray.length()) - 1.0).abs() < 1e-9, "it is another place");
    (camera.eye + depth * ray, depth)
}

fn depth_of(estimator: &Estimator, point: DVec3) -> f64 {
    estimator.camera.frame().axial_depth(estimator.camera.eye, point)
}

fn click(viewer: &Viewer, pixel: [u32; 2], act: &str) {
    viewer.point(Viewer::in_window(pixel));
    viewer.hands(act, 0);
}

fn is_focused_at(depth: f64) -> impl Fn(&Viewer) -> bool {
    move |viewer| (f64::from(viewer.state.borrow()[1]) / depth - 1.0).abs() < 1e-4
}

/// Catches a camera that moves against the hand when the picture is upside down, as that of a hole is, and one that
/// still turns the hand round when the picture is upright. The oracle says where things are seen before and after.
#[test]
fn the_picture_follows_the_hand_through_every_camera() {
    for (upright, option) in [(false, "--upright=false"), (true, "--upright=true")] {
        let options = [&QUICK[..], &["--camera", "hole", option, "--vfov", "40"]].concat();
        let viewer = Viewer::start(SIZE, &options);
        viewer.wait_until_done();
        let mut start = shown();
        start.model = CameraModel::Hole;
        start.hole.upright = upright;
        start.camera.vfov_radians = 40_f64.to_radians();
        let before = middle(&start, "checkered");
        let camera = *viewer.camera.borrow();
        // The box is in front of what the camera looks at, so it goes where the hand goes.
        viewer.until(
            "orbiting",
            |viewer| *viewer.camera.borrow() != camera,
            || viewer.drag_picture(1, [560, 400], [600, 400]),
        );
        let turned = now(&viewer, &start);
        let after = middle(&turned, "checkered");
        assert!(after[0] > before[0] + 4.0, "upright {upright}: from {before:?} to {after:?}");

        let camera = *viewer.camera.borrow();
        viewer.until(
            "panning",
            |viewer| *viewer.camera.borrow() != camera,
            || viewer.drag_picture(2, [560, 400], [540, 420]),
        );
        let panned = middle(&now(&viewer, &start), "checkered");
        let moved = [panned[0] - after[0], panned[1] - after[1]];
        assert!(moved[0] < -4.0 && moved[1] > 4.0, "upright {upright}: it moves by {moved:?}");
        viewer.close();
    }
}

/// Catches a focal plane that stays behind when the camera moves, one that follows although it was moved by hand
/// since, an undo that takes back half, and a button that does not switch it off.
#[test]
fn focus_follows_what_was_focused_on() {
    let start = shown();
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    let pixel = place(&start, "cream");
    let (target, depth) = point(&start, pixel);
    viewer.until("focusing", is_focused_at(depth), || click(&viewer, pixel, "click 3"));
    viewer.rest();
    let camera = *viewer.camera.borrow();

    let dolly = || {
        let camera = *viewer.camera.borrow();
        viewer.until("dollying", |viewer| *viewer.camera.borrow() != camera, || viewer.wheel([600, 400], 0));
        viewer.rest();
    };
    dolly();
    let nearer = depth_of(&now(&viewer, &start), target);
    assert!(nearer < 0.97 * depth, "{nearer} is no nearer than {depth}");
    assert!(is_focused_at(nearer)(&viewer), "{} is not {nearer}", viewer.state.borrow()[1]);
    viewer.until("undo", |viewer| *viewer.camera.borrow() == camera, || viewer.press("ctrl+z"));
    viewer.rest();
    assert!(is_focused_at(depth)(&viewer), "an undo takes back only half");

    // What the hand has chosen since stays.
    viewer.drag("Focal plane distance", &[0.5, 0.52, 0.55], |viewer| !is_focused_at(depth)(viewer));
    viewer.rest();
    let chosen = viewer.state.borrow()[1];
    dolly();
    assert_eq!(viewer.state.borrow()[1], chosen, "it follows what is no longer in focus");

    let here = now(&viewer, &start);
    let pixel = place(&here, "cream");
    let (_, depth) = point(&here, pixel);
    viewer.until("focusing", is_focused_at(depth), || click(&viewer, pixel, "click 3"));
    viewer.rest();
    viewer.click("Viewpoint", |viewer| viewer.controls.borrow().contains_key("Focus follows"));
    viewer.click_once("Focus follows");
    dolly();
    assert!(is_focused_at(depth)(&viewer), "it follows although it should not");
    viewer.close();
}

/// Catches a click that says nothing, or something of another place; a button for focus that does nothing or cannot be
/// left; a double click that turns elsewhere; and a key that does not bring everything into view.
#[test]
fn clicks_say_focus_and_turn() {
    let start = shown();
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    let pixel = [700, 960];
    let (target, depth) = point(&start, pixel);
    let says = |words: &'static str| move |viewer: &Viewer| viewer.message.borrow().contains(words);
    viewer.until("what is there", says("ground, "), || click(&viewer, pixel, "click 1"));
    assert!(says("in front of the focal plane")(&viewer), "{}", viewer.message.borrow());

    let before = *viewer.state.borrow();
    viewer.click_once("Pick focus");
    viewer.press("Escape");
    click(&viewer, pixel, "click 1");
    viewer.rest();
    assert_eq!(*viewer.state.borrow(), before, "it picks after it was left");
    viewer.click_once("Pick focus");
    viewer.until("focusing", is_focused_at(depth), || click(&viewer, pixel, "click 1"));
    viewer.rest();
    viewer.until("what is sharp", says("sharp, in the focal plane"), || click(&viewer, pixel, "click 1"));

    let looks_there = |viewer: &Viewer| {
        let at = now(viewer, &start).camera.look_at;
        at.distance(target) < 1e-3 * depth
    };
    viewer.until("turning", looks_there, || click(&viewer, pixel, "click --repeat 2 --delay 60 1"));
    viewer.rest();
    let camera = now(&viewer, &start).camera;
    assert!(camera.eye.distance(start.camera.eye) < 1e-3, "the camera has moved");

    viewer.until("all", |viewer| now(viewer, &start).camera.eye != camera.eye, || viewer.press("v"));
    viewer.rest();
    let all = now(&viewer, &start);
    let direction = |camera: &scene::Camera| (camera.look_at - camera.eye).normalize();
    assert!(direction(&all.camera).distance(direction(&camera)) < 1e-3, "it looks in another direction");
    let half_height = (0.5 * all.camera.vfov_radians).tan();
    let corners = all.scene.shapes.iter().filter_map(|of| of.shape.bounds()).flatten();
    for corner in corners {
        let frame = all.camera.frame();
        let depth = frame.axial_depth(all.camera.eye, corner);
        let aside = [frame.u(), frame.v()].map(|axis| axis.dot(corner - all.camera.eye).abs() / depth);
        let half_width = half_height * f64::from(SIZE[0]) / f64::from(SIZE[1]);
        assert!(depth > 0.0 && aside[0] < half_width && aside[1] < half_height, "{corner} is out of view");
    }
    viewer.close();
}

/// Catches a lens of two clicks that is focused on the second, blurs it over another number of pixels, or is undone by
/// halves; and a range of sharpness that ends elsewhere.
#[test]
fn two_clicks_choose_a_lens() {
    let start = shown();
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    let k = start.camera.view_distance_pixels(start.size[1]);
    let [(near, near_depth), (far, far_depth)] = ["terracotta", "cream"].map(|material| {
        let pixel = place(&start, material);
        (pixel, point(&start, pixel).1)
    });
    let blur = |viewer: &Viewer, depth: f64| {
        let [diameter, focal_distance, _] = viewer.state.borrow().map(f64::from);
        circle_of_confusion(diameter, focal_distance, depth, k)
    };
    let before = *viewer.state.borrow();
    viewer.click("Lens", |viewer| viewer.controls.borrow().contains_key("Sharp and blurred"));
    viewer.click_once("Sharp and blurred");
    click(&viewer, far, "click 1");
    viewer.rest();
    assert_eq!(*viewer.state.borrow(), before, "one click is enough");
    let chosen = |viewer: &Viewer| (blur(viewer, near_depth) / 20.0 - 1.0).abs() < 0.01;
    viewer.until("a lens", chosen, || click(&viewer, near, "click 1"));
    assert!(blur(&viewer, far_depth) < 0.1, "the first place is blurred over {}", blur(&viewer, far_depth));
    viewer.until("undo", |viewer| *viewer.state.borrow() == before, || viewer.press("ctrl+z"));

    // The tolerance is 0.03 mm on a film that is 24 mm high.
    let tolerance = 0.03 / 24.0 * f64::from(SIZE[1]);
    viewer.click_once("Sharp range");
    click(&viewer, near, "click 1");
    let at_both = |viewer: &Viewer| {
        [near_depth, far_depth].iter().all(|depth| (blur(viewer, *depth) / tolerance - 1.0).abs() < 0.01)
    };
    viewer.until("a range", at_both, || click(&viewer, far, "click 1"));

    // Nothing can be sharp and blurred at one depth.
    let now = *viewer.state.borrow();
    viewer.click_once("Sharp and blurred");
    click(&viewer, near, "click 1");
    viewer.rest();
    let refused = |viewer: &Viewer| viewer.message.borrow().contains("No lens does this");
    viewer.until("a refusal", refused, || click(&viewer, near, "click 1"));
    assert_eq!(*viewer.state.borrow(), now, "a lens comes of it");
    viewer.close();
}

/// Catches a Ctrl+A that types instead of selecting all, when Ctrl is let go in the frame in which A is pressed.
#[test]
fn a_quick_ctrl_a_selects_all() {
    let viewer = Viewer::start(SIZE, &QUICK);
    viewer.wait_until_done();
    viewer.click("Files", |viewer| viewer.controls.borrow().contains_key("Picture file"));
    viewer.click_once("Picture file");
    for round in 0..3 {
        viewer.hands("search --class thinlens windowfocus --sync keydown ctrl", 1);
        viewer.hands("keydown a keyup ctrl keyup a", 0);
        for key in ["x", &round.to_string(), "period", "p", "n", "g"] {
            viewer.hands(&format!("key --delay 0 {key}"), 0);
        }
    }
    viewer.press("Return");
    viewer.click("Save picture", |viewer| !viewer.message.borrow().is_empty());
    let message = viewer.message.borrow().clone();
    assert!(message.ends_with("x2.png") && !message.contains("x1"), "{message}");
    viewer.close();
}
