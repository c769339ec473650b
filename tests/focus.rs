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

/// Two squares of light on black, each facing the camera at its own depth, and the pixels of their middles.
struct Squares {
    toml: String,
    depths: [f64; 2],
    pixels: [[f64; 2]; 2],
}

const SQUARES_SIZE: [u32; 2] = [160, 96];

impl Squares {
    fn new(vfov: f64, depths: [f64; 2]) -> Self {
        let pixels = [[46.3, 40.7], [112.6, 55.1]];
        let k = 0.5 * f64::from(SQUARES_SIZE[1]) / (0.5 * vfov.to_radians()).tan();
        let [a, b] = depths;
        // Such that the lenses are as wide as real ones.
        let metres = 0.1 / a.min(b);
        let mut toml = format!(
            "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = {vfov}\nmetres_per_unit = {metres}\nlens_diameter = 0\n\
             focal_distance = {a}\n[background]\ncolor = [0, 0, 0]\n[ambient]\nradiance = 0\n\
             [emissive.lamp]\nradiance = 1\n"
        );
        for (depth, [x, y]) in depths.into_iter().zip(pixels) {
            let [x, y] = [(x - 80.0) * depth / k, (48.0 - y) * depth / k];
            let half = 1.5 * depth / k;
            toml += &format!(
                "[[box]]\nlower = [{}, {}, {}]\nupper = [{}, {}, {}]\nmaterial = \"lamp\"\n",
                x - half,
                y - half,
                -depth * 1.0001,
                x + half,
                y + half,
                -depth
            );
        }
        Self { toml, depths, pixels }
    }

    /// The spread of the light around the middle of each square: the mean of its variances along the two axes.
    fn spread(&self, gpu: &Gpu, diameter: f32, focal_distance: f32) -> [f64; 2] {
        let mut settings = settings_of(&self.toml, SQUARES_SIZE, 4096);
        settings.estimator.lens.diameter = diameter;
        settings.estimator.lens.focal_distance = focal_distance;
        let mut renderer = gpu.renderer(&settings);
        renderer.render(|_| ()).expect("a rendering");
        let film = renderer.read_film().expect("a film");
        self.pixels.map(|[x, y]| {
            let (mut light, mut moments) = (0.0, [[0.0; 2]; 2]);
            for (row, pixels) in film.chunks(SQUARES_SIZE[0] as usize).enumerate() {
                for (column, [radiance, ..]) in pixels.iter().enumerate() {
                    let at = [column as f64 + 0.5 - x, row as f64 + 0.5 - y];
                    if at[0].abs() < 30.0 {
                        light += f64::from(*radiance);
                        for axis in [0, 1] {
                            moments[axis][0] += f64::from(*radiance) * at[axis];
                            moments[axis][1] += f64::from(*radiance) * at[axis] * at[axis];
                        }
                    }
                }
            }
            let variance = |[first, second]: [f64; 2]| second / light - (first / light).powi(2);
            0.5 * (variance(moments[0]) + variance(moments[1]))
        })
    }

    /// The diameters of the circles of confusion that a rendering shows. A disc of the diameter `c` has the variance
    /// `c^2 / 16` along each axis, and variances of blurs add up.
    fn blurs(&self, gpu: &Gpu, diameter: f32, focal_distance: f32) -> [f64; 2] {
        let sharp = self.spread(gpu, 0.0, 1.0);
        let blurred = self.spread(gpu, diameter, focal_distance);
        [0, 1].map(|square| 4.0 * (blurred[square] - sharp[square]).max(0.0).sqrt())
    }
}

/// Catches a lens that is focused on the wrong one of two places, blurs the other over the radius instead of the diameter,
/// or by the distance along the ray, and a range of sharpness whose middle is the mean of its ends: the blurs are measured
/// in what is rendered.
#[test]
fn a_lens_follows_from_what_two_places_should_look_like() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let gpu = Gpu::new();
    let chosen = |squares: &Squares, arguments: &[String]| -> [f32; 2] {
        std::fs::write(folder.path().join("squares.toml"), &squares.toml).expect("a file");
        let all =
            ["render", "squares.toml", "-s", "160x96", "-n", "1", "-o", "a.png", "--stats", "a.json", "-q"];
        let words = arguments.iter().map(String::as_str);
        let outcome = run(folder.path(), &all.into_iter().chain(words).collect::<Vec<_>>());
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments:?}");
        let text = std::fs::read_to_string(folder.path().join("a.json")).expect("figures");
        let figures: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        ["lens_diameter", "focal_distance"].map(|name| figures[name].as_f64().expect("a number") as f32)
    };
    let scenes = [
        (Squares::new(30.0, [5.0, 9.0]), 20.0),
        (Squares::new(24.0, [400.0, 150.0]), 12.0),
        (Squares::new(50.0, [0.8, 30.0]), 16.5),
    ];
    for (squares, pixels) in &scenes {
        let [[ax, ay], [bx, by]] = squares.pixels;
        let [diameter, focal_distance] =
            chosen(squares, &[format!("--sharp-at={ax},{ay}"), format!("--blur-at={bx},{by},{pixels}")]);
        let [sharp, blurred] = squares.blurs(&gpu, diameter, focal_distance);
        println!("asked for 0 and {pixels} px: {sharp:.2} and {blurred:.2} px are rendered");
        assert!(sharp < 0.5 && (blurred / pixels - 1.0).abs() < 0.02, "{sharp} px and {blurred} px");

        let [diameter, focal_distance] = chosen(
            squares,
            &[format!("--sharp-from={bx},{by}"), format!("--sharp-to={ax},{ay}"), "--tolerance=9".into()],
        );
        let [a, b] = squares.depths;
        assert!((f64::from(focal_distance) * (a + b) / (2.0 * a * b) - 1.0).abs() < 1e-4, "{focal_distance}");
        let blurs = squares.blurs(&gpu, diameter, focal_distance);
        println!("asked for 9 px at both: {blurs:.2?} px are rendered");
        assert!(blurs.iter().all(|blur| (blur / 9.0 - 1.0).abs() < 0.02), "{blurs:?}");
    }

    for (arguments, message) in [
        (["--sharp-at=46,40", "--blur-at=46,41,20"], "both places are"),
        (["--sharp-from=46,40", "--sharp-to=46,41"], "both places are"),
        (["--sharp-at=46,40", "--blur-at=112,55,4000"], "no lens is wider than f/0.5"),
        (["--sharp-at=3,3", "--blur-at=112,55,4"], "focused at infinity"),
        (["--sharp-at=460,40", "--blur-at=112,55,4"], "must be within"),
        (["--sharp-at=46,40", "--blur-at=112,55"], "X,Y,PIXELS"),
        (["--sharp-at=46,40", "--blur-at=112,55,-3"], "X,Y,PIXELS"),
        (["--sharp-at=46,40", "--f-number=2"], "--f-number"),
        (["--sharp-at=46,40", "-q"], "--blur-at"),
    ] {
        std::fs::write(folder.path().join("squares.toml"), &scenes[0].0.toml).expect("a file");
        let all = ["render", "squares.toml", "-s", "160x96", "-o", "b.png"];
        let outcome = run(folder.path(), &[&all[..], &arguments].concat());
        assert!(outcome.code == 2 && outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
        assert!(!folder.path().join("b.png").exists(), "{arguments:?} leave a picture");
    }
}
