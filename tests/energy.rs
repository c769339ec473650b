//! Light is neither made nor lost: by the lens, by surfaces in a furnace, by millions of samples.

mod common;

use anyhow::{Result, ensure};
use common::statistics::{Moments, sidak};
use common::{Gpu, film, prove, settings_of};
use thinlens::reference::Reference;

/// Catches a lens that brightens or darkens: a flat emitter parallel to it gives the picture the
/// same light through any diameter, in focus or not. Held against the pinhole by a t-test over
/// independent seeds, and against the emitter's own area.
#[test]
fn the_light_of_a_flat_emitter_does_not_depend_on_the_lens() {
    let square = "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 50\nlens_diameter = 0\n\
        focal_distance = 4\n[emissive.lamp]\nradiance = 1\n\
        [[triangle]]\nvertices = [[0.2, 0.1, -6], [1.2, 0.1, -6], [1.2, 0.9, -6]]\nmaterial = \"lamp\"\n\
        [[triangle]]\nvertices = [[0.2, 0.1, -6], [1.2, 0.9, -6], [0.2, 0.9, -6]]\nmaterial = \"lamp\"\n";
    let check = |gpu: &Gpu| -> Result<String> {
        let mut settings = settings_of(square, [96, 72], 64);
        let mut first_seed = 0;
        let mut sums = |diameter: f32, focal_distance: f32, profile: f32| {
            settings.estimator.aperture.profile = profile;
            settings.estimator.lens.diameter = diameter;
            settings.estimator.lens.focal_distance = focal_distance;
            first_seed += 12;
            Moments::of((first_seed..first_seed + 12).map(|seed| {
                settings.estimator.seed = seed;
                film(gpu, &settings).iter().map(|texel| f64::from(texel[0])).sum::<f64>()
            }))
        };
        let k = 36.0 / 25_f64.to_radians().tan();
        let area = 1.0 * 0.8 * (k / 6.0).powi(2);
        let pinhole = sums(0.0, 4.0, 0.0);
        let lenses = [
            (0.2, 4.0, 0.0),
            (0.6, 4.0, 0.0),
            (0.6, 6.0, 0.0),
            (0.6, 30.0, 0.0),
            (1.0, 9.0, 0.0),
            (0.6, 4.0, -1.0),
            (0.6, 9.0, 1.0),
        ];
        let (mut least, mut worst) = (1.0_f64, 0.0_f64);
        for (diameter, focal_distance, profile) in lenses {
            let sum = sums(diameter, focal_distance, profile);
            least = least.min(sum.difference_p(&pinhole, 0.0));
            worst = worst.max((sum.mean / area - 1.0).abs());
            ensure!(
                least > sidak(lenses.len()) && worst < 0.005,
                "D {diameter}, F {focal_distance}, profile {profile}: {:.1} +- {:.1} pixels of light, {:.1} +- {:.1} through a pinhole, \
                 an area of {area:.1}",
                sum.mean,
                sum.mean_variance().sqrt(),
                pinhole.mean,
                pinhole.mean_variance().sqrt()
            );
        }
        Ok(format!("7 lenses, least p = {least:.2}, {:.2}% off the area at most", 100.0 * worst))
    };
    prove(check, &["throughput"]);
}

/// Catches weights that do not sum to one: where everything around has one radiance, every pixel has
/// it exactly, with and without things in the scene that give back all they get.
#[test]
fn a_furnace_shows_nothing() {
    let camera = "[camera]\neye = [0, 1, 4]\nlook_at = [0, 0, 0]\nvfov_degrees = 50\nlens_diameter = 0.7\n\
                  focal_distance = 3\n[background]\ncolor = [1, 1, 1]\n[ambient]\nradiance = 1\n";
    let white = "[matte.m]\nka = 1\nkd = 0\ncolor = [1, 1, 1]\n";
    let mirror = "[mirror.m]\nkr = 1\ncolor = [1, 1, 1]\n";
    let ball = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n\
                [[box]]\nlower = [1, -1, -1]\nupper = [2, 0, 0]\nmaterial = \"m\"\n";
    let check = |gpu: &Gpu| -> Result<String> {
        for things in ["".to_owned(), format!("{white}{ball}"), format!("{mirror}{ball}")] {
            let mut settings = settings_of(&format!("{camera}{things}"), [48, 36], 33);
            settings.estimator.max_bounces = 64;
            for texel in film(gpu, &settings) {
                ensure!(texel == [1.0, 1.0, 1.0, 33.0], "{texel:?} in a furnace of ones");
            }
        }
        Ok(format!("{} pixels of three furnaces, exact", 3 * 48 * 36))
    };
    prove(check, &["ambient_counted_twice", "mirror_loses_light"]);
}

const DARK: &str = "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = 0.1\n\
                    focal_distance = 3\n";
const MANY: u32 = 10_000_000;

/// Catches a mean that drifts: ten million samples of 0.3 are 0.3, to the bit. 0.5 would hide the
/// fault. The formula written down literally, in f32, must fail.
#[test]
fn ten_million_samples_of_a_constant_are_that_constant() {
    let check = |gpu: &Gpu| -> Result<String> {
        for constant in [0.3_f32, 0.7, 0.9] {
            let sky = format!("{DARK}[background]\ncolor = [{constant}, {constant}, {constant}]\n");
            // Later samples would make up for what a first one lacks.
            for texel in film(gpu, &settings_of(&sky, [64, 48], 1)) {
                ensure!(texel == [constant, constant, constant, 1.0], "a sample of {constant} is {texel:?}");
            }
            for texel in film(gpu, &settings_of(&sky, [4, 2], MANY)) {
                ensure!(
                    texel == [constant, constant, constant, MANY as f32],
                    "ten million samples of {constant} are {texel:?}"
                );
            }
        }
        Ok("0.3, 0.7 and 0.9, exact".to_owned())
    };
    prove(check, &["running_mean_literally", "background_by_mix"]);
}

/// Catches rounding that favours one side: ten million noisy samples average to what they do in
/// f64, within 2e-5. The oracle traces the same samples.
#[test]
fn ten_million_noisy_samples_average_as_in_f64() {
    let edge = format!(
        "{DARK}[background]\ncolor = [0.3, 0.7, 0.9]\n[emissive.lamp]\nradiance = 1\ncolor = [0.7, 0.1, 0.4]\n\
         [[box]]\nlower = [-9, -9, -3]\nupper = [0.2, 9, -2.5]\nmaterial = \"lamp\"\n"
    );
    let settings = settings_of(&edge, [2, 1], MANY);
    let oracle = Reference::new(&settings.estimator).render(MANY);
    let check = |gpu: &Gpu| -> Result<String> {
        let mut worst = 0.0_f64;
        for (device, oracle) in film(gpu, &settings).iter().zip(&oracle) {
            ensure!(f64::from(device[3]) == oracle[3], "{} samples, not {}", device[3], oracle[3]);
            for channel in 0..3 {
                let error = (f64::from(device[channel]) - oracle[channel]).abs();
                worst = worst.max(error);
                ensure!(error < 2e-5, "{device:?}, not {oracle:?}");
            }
        }
        Ok(format!("two pixels of ten million samples within {worst:.1e}"))
    };
    let mixed = |texel: &[f64; 4]| texel[0] > 0.31 && texel[0] < 0.69;
    assert!(oracle.iter().any(mixed), "the edge is in the picture: {oracle:?}");
    prove(check, &["running_mean_literally"]);
}
