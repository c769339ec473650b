//! The viewer under Xvfb: focusing by the pointer, and the controls of the lens.

mod common;

use common::viewer::Viewer;
use common::{circle_of_confusion, seen};
use thinlens::scene::Preset;
use thinlens::scene::{self, SceneRef};
use thinlens::settings::{Estimator, Settings};

const SIZE: [u16; 2] = [800, 900];

/// What the viewer shows at first.
fn shown() -> Estimator {
    let scene = scene::load("version-4").expect("a built-in scene");
    let mut estimator = Settings::of_scene(SceneRef::new(scene)).estimator;
    estimator.size = SIZE.map(u32::from);
    estimator
}

/// Where a material is seen in the right half of the picture, two pixels from anything else.
fn find(estimator: &Estimator, material: &str) -> [u32; 2] {
    let [width, height] = estimator.size;
    let is = |pixel| seen(estimator, pixel, [0.0; 2]).is_some_and(|(_, name)| name == material);
    let mut places = (0..height).step_by(4).flat_map(|y| (width / 2..width).step_by(4).map(move |x| [x, y]));
    places
        .find(|[x, y]| [[x - 8, *y], [x + 8, *y], [*x, y - 8], [*x, y + 8]].into_iter().all(is))
        .unwrap_or_else(|| panic!("no {material} in sight"))
}

/// Catches a click that focuses on another place, on the distance along the ray, or not wholly: after it
/// what was clicked, off the axis, is blurred over less than half a pixel. Likewise F, the wheel, and the
/// button.
#[test]
fn what_is_pointed_at_comes_into_focus() {
    let estimator = shown();
    let viewer = Viewer::start(SIZE, &["-n", "4"]);
    viewer.wait_until_done();
    // Without a window manager nobody else does.
    viewer.xdotool("search --class thinlens windowfocus --sync");
    let k = estimator.camera.view_distance_pixels(estimator.size[1]);
    let blur = |viewer: &Viewer, depth: f64| {
        let [diameter, focal_distance, _] = viewer.state.borrow().map(f64::from);
        circle_of_confusion(diameter, focal_distance, depth, k)
    };
    for (material, act) in [("cream", "click 3"), ("terracotta", "key f")] {
        let pixel = find(&estimator, material);
        let (depth, _) = seen(&estimator, pixel, [0.0; 2]).expect("a surface");
        assert!(blur(&viewer, depth) > 4.0, "{material} is in focus already");
        viewer.until(
            "pointing",
            |viewer| (f64::from(viewer.state.borrow()[1]) / depth - 1.0).abs() < 1e-4,
            || {
                viewer.point(Viewer::in_window(pixel));
                viewer.hands(act, 0);
            },
        );
        assert!(blur(&viewer, depth) < 0.5, "{material} is blurred over {} px", blur(&viewer, depth));
        viewer.wait_until_done();
        let focal_distance = viewer.state.borrow()[1].to_string();
        viewer.expect_picture(material, 0, &["-n", "4", "--focal-distance", &focal_distance]);
    }

    // Up the wheel with Ctrl: away, by 2% a notch. Xvfb sends more than one.
    viewer.rest();
    let before = viewer.state.borrow()[1];
    viewer.until(
        "the wheel",
        |viewer| {
            let notches = (viewer.state.borrow()[1] / before).ln() / 1.02_f32.ln();
            notches > 0.5 && (notches - notches.round()).abs() < 0.01
        },
        || {
            viewer.hands("keydown ctrl", 1);
            viewer.wheel([600, 500], 1);
            viewer.hands("keyup ctrl", 0);
        },
    );

    let (depth, _) = seen(&estimator, [400, 450], [0.0; 2]).expect("a surface");
    viewer.click("Autofocus", |viewer| blur(viewer, depth) < 0.5);

    // The background is infinitely far away. From the hyperfocal distance on, it is sharp.
    viewer.rest();
    // The tolerance is 0.03 mm on a film that is 24 mm high.
    let hyperfocal = f64::from(viewer.state.borrow()[0]) * k / (0.03 / 24.0 * f64::from(SIZE[1]));
    viewer.until(
        "focusing on the sky",
        |viewer| (f64::from(viewer.state.borrow()[1]) / hyperfocal - 1.0).abs() < 1e-4,
        || {
            viewer.point(Viewer::in_window([790, 10]));
            viewer.hands("click 3", 0);
        },
    );
    assert!(viewer.message.borrow().contains("hyperfocal distance"), "{}", viewer.message.borrow());
    viewer.close();
}

/// Catches f-numbers that are another lens's, a camera that is not the one chosen, and a known lens that
/// is not put in: the viewer then shows what the command line renders by that name.
#[test]
fn the_lens_is_chosen_by_name_and_by_f_number() {
    let estimator = shown();
    let viewer = Viewer::start(SIZE, &["-n", "2"]);
    viewer.wait_until_done();
    let diameter = (estimator.camera.film_distance() / 8.0) as f32;
    viewer.click("Lens", |viewer| viewer.controls.borrow().contains_key("f/8"));
    viewer.click("f/8", |viewer| viewer.state.borrow()[0] == diameter);
    viewer.wait_until_done();
    viewer.expect_picture("f/8", 0, &["-n", "2", "--f-number", "8"]);

    let choose_lens = |combo: &str, choice: &str, view: &str, diameter: Option<f32>| {
        viewer.until(
            choice,
            |viewer| {
                *viewer.view.borrow() == view && diameter.is_none_or(|is| viewer.state.borrow()[0] == is)
            },
            || {
                viewer.controls.borrow_mut().remove(choice);
                viewer.click(combo, |viewer| viewer.controls.borrow().contains_key(choice));
                viewer.click_once(choice);
            },
        );
    };
    let choose = |combo: &str, choice: &str, view: &str| choose_lens(combo, choice, view, None);
    // The other 50 mm lenses have the same view.
    let preset = Preset::named("50mm-f1.4").expect("a preset");
    let mut with_preset = estimator.clone();
    with_preset.take_preset(preset);
    let diameter = Some(with_preset.lens.diameter);
    choose_lens("Known lenses", "50 mm f/1.4", "ThinLens 26.991 0 0", diameter);
    viewer.expect_picture("a 50 mm lens", 0, &["-n", "2", "--preset", "50mm-f1.4"]);
    // The window is too low for both parts. A part that is folded moves the next one up.
    let top = |viewer: &Viewer| viewer.controls.borrow()["Aperture shape"][1];
    let below = top(&viewer);
    viewer.click("Lens", |viewer| top(viewer) < below);
    viewer.click("Aperture shape", |viewer| viewer.controls.borrow().contains_key("Aperture"));
    choose("Aperture", "Iris of blades", "ThinLens 26.991 6 0");
    viewer.expect_picture("an iris", 0, &["-n", "2", "--preset", "50mm-f1.4", "--blades", "6"]);
    choose("Aperture", "Cat's eye", "ThinLens 26.991 0 0.5");
    viewer.expect_picture("a cat's eye", 0, &["-n", "2", "--preset", "50mm-f1.4", "--cats-eye", "0.5"]);
    choose("Aperture", "Round opening", "ThinLens 26.991 0 0");
    let above = top(&viewer);
    viewer.click("Lens", |viewer| top(viewer) > above);
    choose("Camera", "Hole, no lens", "Hole 26.991 0 0");
    viewer.expect_picture("a hole", 0, &["-n", "2", "--preset", "50mm-f1.4", "--camera", "hole"]);
    viewer.close();
}

/// Catches a zoom or a sensor that does not keep what was set last, a third of a stop that skips one, a hyperfocal distance
/// from which the horizon is blurred, and an eye that keeps the view that was on before.
#[test]
fn the_lens_is_set_as_photographers_set_it() {
    // So high that the whole section of the lens is in view.
    let viewer = Viewer::start([SIZE[0], 1000], &["-n", "2"]);
    viewer.wait_until_done();
    let vfov = |viewer: &Viewer| {
        let view = viewer.view.borrow();
        view.split(' ').nth(1).and_then(|degrees| degrees.parse::<f64>().ok()).expect("a field of view")
    };
    // The f-number of what the viewer shows, with a film of this height; its log has the view in three decimals.
    let f_number = |viewer: &Viewer, film_mm: f64| {
        let film_distance = film_mm / 2.0 / (vfov(viewer).to_radians() / 2.0).tan() / 50.0;
        film_distance / f64::from(viewer.state.borrow()[0])
    };
    let is = |viewer: &Viewer, film_mm: f64, stop: f64| (f_number(viewer, film_mm) / stop - 1.0).abs() < 1e-3;
    let choose = |combo: &str, choice: &str, reached: &dyn Fn(&Viewer) -> bool| {
        viewer.until(choice, reached, || {
            viewer.controls.borrow_mut().remove(choice);
            viewer.click(combo, |viewer| viewer.controls.borrow().contains_key(choice));
            viewer.click_once(choice);
        });
    };
    viewer.click("Lens", |viewer| viewer.controls.borrow().contains_key("Hyperfocal"));
    viewer.click("f/8", |viewer| is(viewer, 24.0, 8.0));
    viewer.click("1/3 stop narrower", |viewer| is(viewer, 24.0, 9.0));
    viewer.click("1/3 stop wider", |viewer| is(viewer, 24.0, 8.0));

    // The f-number was set last, so a click into the slider zooms and keeps it.
    viewer.click("Focal length", |viewer| (vfov(viewer) - 37.0).abs() > 1.0);
    viewer.rest();
    assert!(is(&viewer, 24.0, 8.0), "zooming gives f/{}", f_number(&viewer, 24.0));
    let view = vfov(&viewer);
    choose("Sensor", "APS-C", &|viewer| is(viewer, 15.6, 8.0));
    assert!((vfov(&viewer) - view).abs() < 1e-9, "another sensor turns the view");

    // Without the lock the diameter stays.
    let diameter = viewer.state.borrow()[0];
    viewer.click("Keep the f-number", |_| true);
    viewer.rest();
    choose("Sensor", "Phone", &|viewer| viewer.controls.borrow().contains_key("Hyperfocal"));
    viewer.rest();
    assert_eq!(viewer.state.borrow()[0], diameter, "the diameter changes");

    // D v / c with c of a 9.8 x 7.3 mm sensor: 0.03 mm by the ratio of the diagonals.
    let tolerance = 0.03 * 9.8_f64.hypot(7.3) / 36.0_f64.hypot(24.0);
    let film_distance = 7.3 / 2.0 / (vfov(&viewer).to_radians() / 2.0).tan();
    let hyperfocal = f64::from(diameter) * film_distance / tolerance;
    viewer
        .click("Hyperfocal", |viewer| (f64::from(viewer.state.borrow()[1]) / hyperfocal - 1.0).abs() < 1e-3);

    choose("Known lenses", "Eye, 8 mm pupil", &|viewer| *viewer.view.borrow() == "ThinLens 55.795 0 0");
    choose("Known lenses", "50 mm f/1.8", &|viewer| *viewer.view.borrow() == "ThinLens 26.991 0 0");
    viewer.expect_picture(
        "a 50 mm lens after an eye",
        0,
        &["-n", "2", "--preset", "50mm-f1.8", "--focal-distance", &viewer.state.borrow()[1].to_string()],
    );
    viewer.close();
}

/// Catches an overlay that is not the one chosen, that a legend hides, or that does not follow the slider.
#[test]
fn overlays_are_shown_with_a_legend() {
    let viewer = Viewer::start(SIZE, &["-n", "2", "--overlay", "depth"]);
    let rows = usize::from(SIZE[1]) - 110;
    viewer.wait_until_done();
    viewer.expect_rows("depths", rows, 0, &["-n", "2", "--overlay", "depth"]);
    let legend = || viewer.screen([855, 884], [240, 1]);
    // Its background is dark, and not the picture.
    assert!(legend().iter().all(|pixel| pixel.iter().all(|level| *level < 90)), "no legend");
    viewer.drag("Focal plane distance", &[0.5, 0.55, 0.6], |viewer| viewer.state.borrow()[1] > 12.0);
    viewer.wait_until_done();
    let focal_distance = viewer.state.borrow()[1].to_string();
    let nearer = ["-n", "2", "--overlay", "depth", "--focal-distance", &focal_distance];
    viewer.expect_rows("depths for another focus", rows, 0, &nearer);
    viewer.close();
}
