//! Light is neither made nor lost: by the lens, by surfaces in a furnace, by millions of samples.

mod common;

use common::{Gpu, film, scene_of, small};
use thinlens::reference::Reference;
use thinlens::renderer::Renderer;
use thinlens::settings::Settings;

fn settings(toml: &str, size: [u32; 2], samples: u32) -> Settings {
    let mut settings = Settings::of_scene(scene_of(toml));
    (settings.estimator.size, settings.samples) = (size, samples);
    settings
}

/// Mean and standard error of a few numbers.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0);
    (mean, (variance / count).sqrt())
}

/// Catches a lens that brightens or darkens: a flat emitter parallel to it gives the picture the
/// same light through any diameter, in focus or not. Held against the pinhole by a z-test over
/// independent seeds, and against the emitter's own area.
#[test]
fn the_light_of_a_flat_emitter_does_not_depend_on_the_lens() {
    let gpu = Gpu::new();
    let square = "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 50\nlens_diameter = 0\n\
        focal_distance = 4\n[emissive.lamp]\nradiance = 1\n\
        [[triangle]]\nvertices = [[0.2, 0.1, -6], [1.2, 0.1, -6], [1.2, 0.9, -6]]\nmaterial = \"lamp\"\n\
        [[triangle]]\nvertices = [[0.2, 0.1, -6], [1.2, 0.9, -6], [0.2, 0.9, -6]]\nmaterial = \"lamp\"\n";
    let mut settings = settings(square, [96, 72], 64);
    let mut sums = |diameter: f32, focal_distance: f32| {
        settings.estimator.lens.diameter = diameter;
        settings.estimator.lens.focal_distance = focal_distance;
        let of_seed = |seed| {
            settings.estimator.seed = seed;
            film(&gpu, &settings).iter().map(|texel| f64::from(texel[0])).sum::<f64>()
        };
        mean_and_error(&(0..12).map(of_seed).collect::<Vec<_>>())
    };
    let k = 36.0 / 25_f64.to_radians().tan();
    let area = 1.0 * 0.8 * (k / 6.0).powi(2);
    let (pinhole, pinhole_error) = sums(0.0, 4.0);
    for (diameter, focal_distance) in [(0.2, 4.0), (0.6, 4.0), (0.6, 6.0), (0.6, 30.0), (1.0, 9.0)] {
        let (sum, error) = sums(diameter, focal_distance);
        let z = (sum - pinhole) / error.hypot(pinhole_error);
        println!("D {diameter}, F {focal_distance}: {sum:.2} +- {error:.2}, pinhole {pinhole:.2}, z {z:.2}");
        // With 11 degrees of freedom each, |z| > 4 comes by chance once in a thousand times.
        assert!(z.abs() < 4.0, "D {diameter}, F {focal_distance}: {sum} +- {error}, pinhole {pinhole}");
        assert!((sum / area - 1.0).abs() < 0.005, "{sum} of {area} pixels");
    }
}

/// Catches weights that do not sum to one: where everything around has one radiance, every pixel has
/// it exactly, with and without things in the scene that give back all they get.
#[test]
fn a_furnace_shows_nothing() {
    let gpu = Gpu::new();
    let camera = "[camera]\neye = [0, 1, 4]\nlook_at = [0, 0, 0]\nvfov_degrees = 50\nlens_diameter = 0.7\n\
                  focal_distance = 3\n[background]\ncolor = [1, 1, 1]\n[ambient]\nradiance = 1\n";
    let white = "[matte.m]\nka = 1\nkd = 0\ncolor = [1, 1, 1]\n";
    let mirror = "[mirror.m]\nkr = 1\ncolor = [1, 1, 1]\n";
    let ball = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n\
                [[box]]\nlower = [1, -1, -1]\nupper = [2, 0, 0]\nmaterial = \"m\"\n";
    for things in ["".to_owned(), format!("{white}{ball}"), format!("{mirror}{ball}")] {
        let mut settings = settings(&format!("{camera}{things}"), [48, 36], 33);
        settings.estimator.max_bounces = 64;
        for texel in film(&gpu, &settings) {
            assert_eq!(texel, [1.0, 1.0, 1.0, 33.0], "{things}");
        }
    }
}

const DARK: &str = "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = 0.1\n\
                    focal_distance = 3\n";
const MANY: u32 = 10_000_000;

/// Renders with long batches, so that ten million samples take seconds.
fn long_film(gpu: &Gpu, settings: &Settings) -> Vec<[f32; 4]> {
    let mut renderer = Renderer::new(gpu.device()).expect("a renderer");
    renderer.set_max_batch(1 << 16);
    renderer.set(settings).expect("valid settings");
    renderer.render(|_| ()).expect("a rendering");
    renderer.read_film().expect("a film")
}

/// The running mean written down literally, in f32: what the film must not do.
fn literal(mean: f32, count: f32, sample: f32) -> f32 {
    (sample + count * mean) / (count + 1.0)
}

/// Catches a mean that drifts: ten million samples of 0.3 are 0.3, to the bit. 0.5 would hide the
/// fault, so the literal formula is shown to fail on the same numbers.
#[test]
fn ten_million_samples_of_a_constant_are_that_constant() {
    let gpu = Gpu::new();
    for constant in [0.3_f32, 0.7] {
        let sky = format!("{DARK}[background]\ncolor = [{constant}, {constant}, {constant}]\n");
        for texel in long_film(&gpu, &settings(&sky, [4, 2], MANY)) {
            assert_eq!(texel, [constant, constant, constant, MANY as f32]);
        }
        let mut mean = 0.0;
        for count in 0..MANY {
            mean = literal(mean, count as f32, constant);
        }
        let drift = (mean / constant - 1.0).abs();
        println!("the literal form makes {mean} of {constant}");
        assert!(drift > 1e-3, "the literal form would pass: {mean}");
    }
}

/// Catches rounding that favours one side: ten million noisy samples average to what they do in
/// f64, within 1e-4. The oracle traces the same samples.
#[test]
fn ten_million_noisy_samples_average_as_in_f64() {
    let gpu = Gpu::new();
    let edge = format!(
        "{DARK}[background]\ncolor = [0.3, 0.7, 0.9]\n[emissive.lamp]\nradiance = 1\ncolor = [0.7, 0.1, 0.9]\n\
         [[box]]\nlower = [-9, -9, -3]\nupper = [0.2, 9, -2.5]\nmaterial = \"lamp\"\n"
    );
    let settings = settings(&edge, [2, 1], MANY);
    let device = long_film(&gpu, &settings);
    let oracle = Reference::new(&settings.estimator).render(MANY);
    for (device, oracle) in device.iter().zip(&oracle) {
        assert_eq!(f64::from(device[3]), oracle[3]);
        for channel in 0..3 {
            let error = (f64::from(device[channel]) - oracle[channel]).abs();
            assert!(error < 1e-4, "{device:?}, not {oracle:?}");
        }
    }
    assert!(
        oracle.iter().any(|texel| texel[0] > 0.31 && texel[0] < 0.69),
        "the edge is in the picture: {oracle:?}"
    );
}

/// Catches colours of an older picture that shine through: the film is taken for empty, whatever it
/// holds, also where a wide jitter leaves a pixel without its first sample.
#[test]
fn an_old_picture_leaves_no_trace() {
    let gpu = Gpu::new();
    let bright = format!("{DARK}[background]\ncolor = [1e9, 1e9, 1e9]\n");
    let mut old = settings(&bright, [48, 36], 20);
    let mut new = small("version-4");
    new.estimator.size = [48, 36];
    for jitter in [1.0, 3.0] {
        (old.estimator.jitter, new.estimator.jitter, new.samples) = (jitter, jitter, 2);
        let mut renderer = Renderer::new(gpu.device()).expect("a renderer");
        for settings in [&old, &new] {
            renderer.set(settings).expect("valid settings");
            renderer.render(|_| ()).expect("a rendering");
        }
        let got = common::bits(&renderer.read_film().expect("a film"));
        assert!(got == common::bits(&film(&gpu, &new)), "jitter {jitter}");
    }
}
