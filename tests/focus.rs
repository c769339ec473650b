//! Focusing: what the device says lies under a pixel, and pictures that are focused there.

mod common;

use anyhow::{Result, ensure};
use common::scenes::EVERYTHING;
use common::{Gpu, prove, run, settings_of, small};
use thinlens::reference::Reference;
use thinlens::renderer::Question;
use thinlens::scene::{CameraModel, Hole};
use thinlens::settings::Settings;

/// Some places of a picture, at pixels' centres and between.
fn places([width, height]: [u32; 2]) -> Vec<[f32; 2]> {
    let along = |extent: u32| (0..9).map(move |i| (0.06 + 0.11 * i as f32) * extent as f32);
    along(height).flat_map(|y| along(width).map(move |x| [x, y])).collect()
}

/// What the oracle says: depth along the axis of what the ray through the lens centre meets.
fn depth(settings: &Settings, [x, y]: [f32; 2]) -> Option<f64> {
    let estimator = &settings.estimator;
    let pixel = [x as u32, y as u32];
    let offset = [f64::from(x) - f64::from(pixel[0]) - 0.5, f64::from(y) - f64::from(pixel[1]) - 0.5];
    common::seen(estimator, pixel, offset).map(|(depth, _)| depth)
}

/// Catches a pick beside the pointer, through another point of the lens than its centre, of the farthest
/// surface, or in a picture that is turned; and a distance along the ray for the depth along the axis: the
/// oracle looks along the same rays.
#[test]
fn the_device_knows_what_lies_under_a_pixel() {
    let mut upside_down = small("version-4");
    upside_down.estimator.model = CameraModel::Hole;
    upside_down.estimator.hole = Hole { diameter: 0.01, upright: false };
    let settings =
        [small("version-4"), small("suffern-mirror"), settings_of(EVERYTHING, [64, 48], 1), upside_down];
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut surfaces, mut background, mut worst, mut off_axis) = (0, 0, 0.0_f64, 0.0_f64);
        for settings in &settings {
            let mut renderer = gpu.renderer(settings);
            for place in places(settings.estimator.size) {
                let picked = renderer.pick(Question::at(place))?.expect("an answer");
                ensure!(picked.question.position == place, "the answer is to {:?}", picked.question);
                match (picked.surface, depth(settings, place)) {
                    (Some(surface), Some(expected)) => {
                        let error = (surface.depth / expected - 1.0).abs();
                        worst = worst.max(error);
                        ensure!(error < 1e-4, "{place:?}: {} deep, not {expected}", surface.depth);
                        ensure!(!surface.material.is_empty(), "{place:?}: a material without a name");
                        let along = surface.point.distance(settings.estimator.camera.eye);
                        off_axis = off_axis.max(along / expected - 1.0);
                        surfaces += 1;
                    }
                    (None, None) => background += 1,
                    (got, expected) => ensure!(false, "{place:?}: {got:?}, not {expected:?}"),
                }
            }
        }
        ensure!(surfaces > 100 && background > 10, "{surfaces} surfaces, {background} of the background");
        ensure!(off_axis > 0.1, "the distance along the ray is too near the depth to tell: {off_axis}");
        Ok(format!("{surfaces} surfaces within {worst:.1e}, {background} places of the background"))
    };
    prove(check, &["pick", "picture_mirrored", "picture_upside_down"]);
}

/// Catches fans that leave out part of the lens or lie across where they should go up, rays that do not meet
/// at the device's own point in focus, and samples that are not those of the pixel.
#[test]
fn the_rays_of_a_place_go_through_its_point_in_focus() {
    let mut settings = small("version-4");
    settings.estimator.seed = 5;
    let check = |gpu: &Gpu| -> Result<String> {
        let estimator = &settings.estimator;
        let (mut renderer, frame) = (gpu.renderer(&settings), estimator.camera.frame());
        let (mut rays, mut worst) = (0, 0.0_f64);
        let (eye, radius) = (estimator.camera.eye, f64::from(estimator.lens.diameter) / 2.0);
        for position in [[3.5, 40.5], [32.0, 24.0], [60.25, 7.75]] {
            let question = Question { position, fan: 9, samples: 16 };
            let picked = renderer.pick(question)?.expect("an answer");
            let focal_distance = f64::from(estimator.lens.focal_distance);
            let depth = frame.axial_depth(estimator.camera.eye, picked.focus);
            ensure!((depth / focal_distance - 1.0).abs() < 1e-5, "the point in focus is {depth} deep");
            let (up, across) = (picked.fan_up(), picked.fan_across());
            for (fan, along, aside) in [(up, frame.v(), frame.u()), (across, frame.u(), frame.v())] {
                for (i, ray) in fan.iter().enumerate() {
                    let expected = radius * (i as f64 / 4.0 - 1.0);
                    let [on, off] = [along, aside].map(|axis| (ray.origin - eye).dot(axis));
                    ensure!(
                        (on - expected).abs() + off.abs() < 1e-4 * radius + 1e-6,
                        "ray {i} starts at {on}, {off}"
                    );
                    let to_focus = picked.focus - ray.origin;
                    let beside = to_focus.cross(ray.direction).length() / focal_distance;
                    worst = worst.max(beside);
                    ensure!(beside < 1e-4, "ray {i} passes {beside:.1e} F beside the point in focus");
                    rays += 1;
                }
            }
            let reference = Reference::new(estimator);
            let pixel = position.map(|at| at as u32);
            for (index, ray) in (0..).zip(picked.samples()) {
                let expected = reference.sample(pixel, index).ray;
                let off =
                    (ray.origin - expected.origin).length() + (ray.direction - expected.direction).length();
                ensure!(off < 1e-5, "sample {index} is {off:.1e} off");
                rays += 1;
            }
        }
        ensure!(rays == 3 * (18 + 16), "{rays} rays");
        Ok(format!("{rays} rays, within {worst:.1e} F of the point in focus"))
    };
    prove(
        check,
        &[
            "fan_of_half_the_lens",
            "picked_samples_of_another_index",
            "focal_sphere",
            "lens_radius_times_1.05",
        ],
    );
}

/// Catches an `--autofocus` that focuses elsewhere or not at all: the focal distance is what the oracle
/// gives. And one that takes the sky, or a place outside the picture, for something.
#[test]
fn autofocus_puts_the_focal_plane_through_what_the_picture_shows() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut settings = small("version-4");
    settings.estimator.size = [160, 90];
    let stats = |arguments: &[&str]| -> f64 {
        let all = ["render", "-s", "160x90", "-n", "4", "-o", "a.png", "--stats", "a.json", "--quiet"];
        let outcome = run(folder.path(), &[&all[..], arguments].concat());
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments:?}");
        let text = std::fs::read_to_string(folder.path().join("a.json")).expect("figures");
        let figures: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        figures["focal_distance"].as_f64().expect("a number")
    };
    for (argument, place) in [
        ("--autofocus", [80.0, 45.0]),
        ("--autofocus=130,52", [130.0, 52.0]),
        ("--autofocus=32.5,80", [32.5, 80.0]),
    ] {
        let expected = depth(&settings, place).expect("a surface");
        let focused = stats(&[argument]);
        assert!((focused / expected - 1.0).abs() < 1e-4, "{argument}: {focused}, not {expected}");
    }
    let plain = stats(&[]);
    assert!((plain / f64::from(settings.estimator.lens.focal_distance) - 1.0).abs() < 1e-6, "{plain}");

    for (argument, message) in [
        ("--autofocus=3,3", "nothing to focus on"),
        ("--autofocus=160,3", "must be within"),
        ("--autofocus=-1,3", "must be within"),
        ("--autofocus=nan,3", "must be within"),
    ] {
        let outcome = run(folder.path(), &["render", "-s", "160x90", "-o", "b.png", argument]);
        assert!(outcome.code == 2 && outcome.stderr.contains(message), "{argument}: {}", outcome.stderr);
        assert!(!folder.path().join("b.png").exists(), "{argument} leaves a picture");
    }
}
