//! What moves while the shutter is open, and how bright the picture is.

mod common;

use anyhow::{Result, ensure};
use common::scenes::EVERYTHING;
use common::statistics::evenness_p;
use common::{Gpu, decode_png, pixels, prove, render, render_png, scene_of, settings_of};
use glam::Vec3;
use std::fmt::Write as _;
use std::sync::Arc;
use thinlens::reference::sampler;
use thinlens::scene::{CameraModel, SceneRef};
use thinlens::settings::{Sampler, Settings};
use thinlens::verify::verify;

/// A scene with every kind of shape, material and light, all of whose shapes move.
fn everything_moves() -> Settings {
    let mut scene = common::plain_scene_of(EVERYTHING);
    let velocity = |i: usize| {
        let [x, y, z, _] = sampler::sample_values(Sampler::Random, 3, [i as u32, 0], 0, 0);
        Vec3::new(x as f32, y as f32, z as f32) - 0.5
    };
    let bounded = Arc::make_mut(&mut scene.shapes).iter_mut().filter(|of| of.shape.is_bounded());
    (0..).zip(bounded).for_each(|(i, of)| of.velocity = 20.0 * velocity(i));
    scene.shutter = 0.05;
    let mut settings = Settings::of_scene(SceneRef::new(scene));
    (settings.estimator.size, settings.samples) = ([64, 48], 8);
    settings
}

/// Shapes that move in many directions, enough of them for a tree.
fn a_moving_crowd() -> Settings {
    let mut toml = String::from(
        "[camera]\neye = [0, 2, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 45\nlens_diameter = 0.3\n\
         focal_distance = 9\nshutter = 0.04\n[background]\ncolor = [0.5, 0.6, 0.8]\n[ambient]\nradiance = 0.5\n\
         [[directional]]\ndirection = [1, 2, 1]\nradiance = 2\n[matte.plain]\nka = 0.5\nkd = 0.8\n\
         color = { even = [0.8, 0.5, 0.3], odd = [0.2, 0.3, 0.4], size = 0.2 }\n",
    );
    for i in 0..90_u32 {
        let values =
            |block| sampler::sample_values(Sampler::Random, 5, [i, 1], 0, block).map(|v| 2.0 * v - 1.0);
        let ([x, y, z, _], [u, v, w, _]) = (values(0), values(1));
        let (x, y, z, u, v, w) = (3.5 * x, 2.5 * y, 3.0 * z, 15.0 * u, 15.0 * v, 15.0 * w);
        let shape = match i % 3 {
            0 => format!("[[sphere]]\ncenter = [{x}, {y}, {z}]\nradius = 0.3"),
            1 => format!("[[box]]\nlower = [{x}, {y}, {z}]\nupper = [{}, {}, {}]", x + 0.5, y + 0.4, z + 0.3),
            _ => format!(
                "[[triangle]]\nvertices = [[{x}, {y}, {z}], [{}, {y}, {z}], [{x}, {}, {}]]",
                x + 0.8,
                y + 0.7,
                z + 0.2
            ),
        };
        writeln!(toml, "{shape}\nmaterial = \"plain\"\nvelocity = [{u}, {v}, {w}]").expect("a string");
    }
    settings_of(&toml, [64, 48], 8)
}

/// Catches a shape that moves another's way, leaves its shadow or its checker behind, or is lost in the
/// tree; a shutter that opens at another time or for longer; and a time that is not the sample's own. Whole
/// scenes, sample by sample, against the oracle, which moves the rays instead.
#[test]
fn moving_scenes_are_what_the_oracle_sees() {
    let scenes = [everything_moves(), a_moving_crowd()];
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&scenes[0]);
        let (mut samples, mut mismatches) = (0, 0);
        for scene in &scenes {
            for (sampler, seed) in [(Sampler::BlueNoise, 0), (Sampler::Sobol, 3), (Sampler::Random, 0)] {
                let mut settings = scene.clone();
                (settings.estimator.sampler, settings.estimator.seed) = (sampler, seed);
                let agreement = verify(&mut renderer, &settings)?;
                samples += agreement.samples;
                mismatches += agreement.mismatches;
            }
        }
        // The shutter alone changes: the tree must follow.
        let mut longer = scenes[1].clone();
        longer.estimator.shutter *= 4.0;
        mismatches += verify(&mut renderer, &longer)?.mismatches;
        Ok(format!("{samples} samples, {mismatches} differ"))
    };
    prove(check, &["motion", "shutter"]);
}

/// Catches a streak of another length or place than the distance that a lamp covers on the film while the
/// shutter is open: its light's centre, and its spread, which is a twelfth of the square of the length.
#[test]
fn a_moving_lamp_leaves_a_streak_as_long_as_its_way() {
    let (speed, shutter, depth, radius) = (30.0, 0.02, 5.0, 0.02);
    let scene = scene_of(&format!(
        "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = 0\nfocal_distance = 5\n\
         shutter = {shutter}\n[emissive.lamp]\nradiance = 1\n[[sphere]]\ncenter = [0.4, 0.1, -{depth}]\n\
         radius = {radius}\nmaterial = \"lamp\"\nvelocity = [{speed}, 0, 0]\n"
    ));
    let mut settings = Settings::of_scene(scene);
    (settings.estimator.size, settings.samples) = ([160, 120], 256);
    let k = settings.estimator.camera.view_distance_pixels(120);
    let check = |gpu: &Gpu| -> Result<String> {
        let film = render(&mut gpu.renderer(&settings), &settings)?;
        let light = film.iter().map(|texel| f64::from(texel[0]));
        let (mut all, mut first, mut second) = (0.0, 0.0, 0.0);
        for ([x, _], light) in pixels([160, 120]).zip(light) {
            let x = f64::from(x) + 0.5 - 80.0;
            (all, first, second) = (all + light, first + light * x, second + light * x * x);
        }
        let (centre, variance) = (first / all, second / all - (first / all).powi(2));
        let expected = 0.4 / depth * k;
        let length = (12.0 * (variance - (radius / depth * k).powi(2) / 4.0 - 1.0 / 12.0)).sqrt();
        let way = speed * shutter / depth * k;
        ensure!((centre - expected).abs() < 0.3, "the streak's middle is at {centre} px, not {expected}");
        ensure!((length / way - 1.0).abs() < 0.01, "it is {length} px long, not {way}");
        Ok(format!("{length:.2} px, of {way:.2}; its middle at {centre:.2}, of {expected:.2}"))
    };
    prove(check, &["shutter"]);
}

/// Catches a time that has to do with where on film or lens the sample is, in a pixel or over the picture,
/// and one that is not spread over the exposure.
#[test]
fn times_keep_apart_and_have_nothing_to_do_with_film_and_lens() {
    let cell = |value: f64| (8.0 * value) as usize;
    for kind in [Sampler::Random, Sampler::Sobol, Sampler::BlueNoise] {
        for axis in 0..4 {
            for (columns, samples) in [(1, 4096), (64, 64), (4096, 1)] {
                let mut counts = [0; 64];
                for (column, index) in (0..columns).flat_map(|x| (0..samples).map(move |i| (x, i))) {
                    let pixel = [column % 64, column / 64];
                    let other = sampler::sample_values(kind, 1, pixel, index, 0)[axis];
                    let time = sampler::time_value(kind, 1, pixel, index);
                    counts[8 * cell(time) + cell(other)] += 1;
                }
                let p = evenness_p(&counts);
                assert!(p > 1e-6, "{kind:?}, value {axis}, {columns} pixels, {samples} samples: {counts:?}");
            }
        }
        if kind != Sampler::Random {
            let mut parts: Vec<_> =
                (64..128).map(|index| (64.0 * sampler::time_value(kind, 1, [5, 9], index)) as u32).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..64).collect::<Vec<_>>(), "{kind:?} leaves parts of the exposure out");
        }
    }
}

/// Catches brightness that goes with the f-number and not its square, the wrong way round, or while it is
/// locked; and a shutter or film that does not count.
#[test]
fn brightness_goes_with_aperture_time_and_film() {
    let mut settings = Settings::of_scene(scene_of(EVERYTHING));
    let own = settings.estimator.f_number();
    let near = |got: f32, expected: f64| {
        assert!((f64::from(got) / expected - 1.0).abs() < 1e-5, "{got}, not {expected}")
    };
    near(settings.exposure(), 1.0);
    settings.estimator.set_f_number(2.0 * own);
    near(settings.exposure(), 1.0);
    settings.view.exposure_lock = false;
    near(settings.exposure(), 0.25);
    settings.view.iso *= 8.0;
    near(settings.exposure(), 2.0);
    settings.estimator.shutter /= 4.0;
    near(settings.exposure(), 0.5);
    settings.view.exposure_stops = 3.0;
    near(settings.exposure(), 4.0);
    // A pinhole has no area, so it counts as the scene's own lens.
    settings.estimator.lens.diameter = 0.0;
    near(settings.exposure(), 16.0);
    settings.estimator.model = CameraModel::Hole;
    settings.estimator.hole.diameter *= 3.0;
    near(settings.exposure(), 144.0);

    let folder = tempfile::tempdir().expect("a temporary folder");
    let picture = |arguments: &[&str]| {
        decode_png(&render_png(folder.path(), &[&["-s", "96x54", "-n", "4"], arguments].concat()))
    };
    assert!(picture(&["--shutter", "1/30"]) == picture(&["--exposure", "1"]));
    assert!(picture(&["--iso", "400"]) == picture(&["--exposure", "2"]));
    let own = thinlens::scene::load("version-4").expect("a built-in scene");
    let half = (f64::from(own.lens.diameter) / 2.0).to_string();
    let unlocked = picture(&["--lens-diameter", &half, "--exposure-lock=false"]);
    assert!(unlocked == picture(&["--lens-diameter", &half, "--exposure", "-2"]));
}
