//! Whole scenes, on the device and by the oracle.

mod common;

use anyhow::{Result, ensure};
use common::scenes::{EVERYTHING, ROOM};
use common::statistics::Spread;
use common::{Gpu, pictures, pixels, prove, settings_of, small};
use glam::DVec3;
use std::f64::consts::TAU;
use std::ops::Range;
use thinlens::reference::Reference;
use thinlens::reference::integrator::whitted::radiance;
use thinlens::settings::{Sampler, Settings};
use thinlens::verify::{Agreement, verify};

/// Catches a shader that strays from the mathematics anywhere on the way from the sampler to the
/// radiance: every sample of every scene is compared with the oracle's. At edges rounding decides what
/// a ray meets, so a few samples may differ, and are counted.
#[test]
fn the_device_renders_what_the_oracle_does() {
    let own = [EVERYTHING, ROOM].map(|toml| settings_of(toml, [64, 48], 8));
    let builtin = ["version-4", "suffern-boxes", "suffern-mirror"].map(small);
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&own[0]);
        let (mut samples, mut mismatches, mut share, mut brightness) = (0, 0, 0.0_f64, 0.0_f64);
        for settings in own.iter().chain(&builtin) {
            for (jitter, sampler) in [
                (1.0, Sampler::BlueNoise),
                (1.0, Sampler::Sobol),
                (1.0, Sampler::Random),
                (0.0, Sampler::Sobol),
                (2.5, Sampler::BlueNoise),
            ] {
                let mut settings = settings.clone();
                (settings.estimator.jitter, settings.estimator.sampler) = (jitter, sampler);
                settings.estimator.seed = 7;
                let agreement = verify(&mut renderer, &settings)?;
                // With a wide jitter some pixels get several samples at once, and some none.
                let expected = if jitter > 1.0 { 64 * 48 * 4 } else { 64 * 48 * 8 };
                ensure!(agreement.samples >= expected, "{} samples compared", agreement.samples);
                (samples, mismatches) = (samples + agreement.samples, mismatches + agreement.mismatches);
                share = share.max(agreement.mismatch_share());
                brightness = brightness.max(agreement.brightness_difference().abs());
            }
        }
        Ok(format!(
            "{samples} samples, {mismatches} differ, {share:.1e} of a scene's at most, brightness by {brightness:.1e} at most"
        ))
    };
    prove(
        check,
        &[
            "lens",
            "framing",
            "film_and_lens",
            "sampler_without_index",
            "sobol_without_seed",
            "blue_noise_tile_transposed",
            "sobol_directions_of_another_bit",
            "disk_sector_mirrored",
            "shadow_limit_ignored",
            "light_by_the_cosine_to_the_axis",
            "rows_of_workgroups_visited_twice",
        ],
    );
}

/// Catches a comparison that lets a NaN, a missing sample or a small tint over everything pass.
#[test]
fn the_bounds_are_bounds() {
    let oracle = vec![[0.5, 0.5, 0.5, 1.0]; 1000];
    let holds = |texel: [f64; 4], how_many: usize| {
        let mut device = vec![[0.5, 0.5, 0.5, 1.0]; 1000];
        device[..how_many].fill(texel);
        let mut agreement = Agreement::new(1);
        agreement.add(&device, &oracle);
        agreement.holds()
    };
    assert!(holds([0.5, 0.5, 0.5, 1.0], 1000) && holds([0.9, 0.5, 0.5, 1.0], 1));
    assert!(!holds([0.9, 0.5, 0.5, 1.0], 2));
    assert!(!holds([f64::NAN, 0.5, 0.5, 1.0], 2));
    assert!(!holds([0.5, 0.5, 0.5, 0.0], 2));
    // Each sample agrees, but all are a little brighter.
    assert!(!holds([0.5009, 0.5009, 0.5009, 1.0], 1000));
    assert!(!Agreement::new(1).holds(), "nothing compared is nothing proved");
}

/// Two lamps far off the axis, one before and one behind the focal plane.
const LAMPS: &str = r#"
[camera]
eye = [0, 0, 0]
look_at = [0, 0, -1]
vfov_degrees = 50
lens_diameter = 1
focal_distance = 4
[emissive.lamp]
radiance = 1
[[sphere]]
center = [1.1, 0.7, -2.6]
radius = 0.08
material = "lamp"
[[sphere]]
center = [-3.5, -2.2, -9]
radius = 0.35
material = "lamp"
"#;

/// A picture by the oracle with random numbers of its own. It shares neither the sampler nor the map to the disk, for which
/// it uses the square root of the radius. `lens` maps the numbers of a lens point, given those of the film.
fn independent_picture(
    settings: &Settings,
    seed: u32,
    lens: impl Fn([f64; 2], [f64; 2]) -> [f64; 2],
) -> Vec<[f64; 3]> {
    let estimator = &settings.estimator;
    let reference = Reference::new(estimator);
    let mut random = fastrand::Rng::with_seed(seed.into());
    let mean = |pixel| {
        let mut sum = DVec3::ZERO;
        for _ in 0..settings.samples {
            let film = [random.f64(), random.f64()];
            let [square, turn] = lens([random.f64(), random.f64()], film);
            let (radius, angle) = (square.sqrt(), TAU * turn);
            let disk = [radius * angle.cos(), radius * angle.sin()];
            let ray = reference.primary_ray(pixel, film.map(|value| value - 0.5), disk, 0.0);
            sum += radiance(&estimator.scene, ray, estimator.max_bounces);
        }
        (sum / f64::from(settings.samples)).to_array()
    };
    pixels(estimator.size).map(mean).collect()
}

/// The spread of several such pictures, which two threads render.
fn independent_pictures(settings: &Settings, lens: fn([f64; 2], [f64; 2]) -> [f64; 2]) -> Spread {
    let half =
        |seeds: Range<u32>| seeds.map(|seed| independent_picture(settings, seed, lens)).collect::<Vec<_>>();
    let pictures = std::thread::scope(|scope| {
        let second = scope.spawn(|| half(PICTURES / 2..PICTURES));
        let mut pictures = half(0..PICTURES / 2);
        pictures.extend(second.join().expect("the oracle"));
        pictures
    });
    Spread::of(pictures)
}

const PICTURES: u32 = 24;

/// The share of a value that f32 may lose on a sample's way.
const ROUNDING: f64 = 1e-5;

/// Catches what comparing the same samples cannot: a sampler or a map to the disk that is wrong in
/// the shaders and in the oracle alike. The oracle takes random numbers and a map of its own, and
/// the pictures must estimate the same integral: in every channel of every pixel, with no share of
/// failures allowed, and on the whole.
#[test]
fn independent_samples_estimate_the_same_picture() {
    // Many samples of the lamps: a rim that is 5% off must stand out of the noise of a pixel.
    let mut version_4 = small("version-4");
    (version_4.estimator.size, version_4.samples) = ([64, 36], 64);
    let scenes = [settings_of(LAMPS, [24, 18], 4096), version_4, settings_of(EVERYTHING, [40, 30], 64)];
    let expected = scenes.each_ref().map(|settings| independent_pictures(settings, |lens, _| lens));
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for (settings, expected) in scenes.iter().zip(&expected) {
            let device = Spread::of(pictures(gpu, settings, PICTURES)?);
            figures.push(device.agree(expected, ROUNDING)?);
        }
        Ok(figures.join("; "))
    };
    prove(
        check,
        &[
            "film_and_lens",
            "lens_radius_times_1.05",
            "lens_radius_square_root",
            "focal_sphere",
            "lens_values_from_the_film",
            "picture_upside_down",
            "half_a_pixel_off",
            "disk_radius_squared",
            "disk_by_polar_angle",
            "merge_forgets_the_batch",
            "light_by_the_lens_area",
        ],
    );
    // A mistake that both would share: the lens point taken from the film's numbers.
    let shared = independent_pictures(&scenes[0], |_, film| film);
    let agreement = shared.agree(&expected[0], ROUNDING);
    assert!(agreement.is_err(), "a shared pair is not seen: {agreement:?}");
}

/// Catches a proof that fails where there is nothing but black on both sides: no light over no light is not a number.
#[test]
fn two_black_pictures_agree() {
    let mut agreement = thinlens::verify::Agreement::new(1);
    agreement.add(&[[0.0, 0.0, 0.0, 1.0]], &[[0.0, 0.0, 0.0, 1.0]]);
    assert!(agreement.holds(), "{agreement:?}");
    agreement.add(&[[1.0, 0.0, 0.0, 1.0]], &[[0.0, 0.0, 0.0, 1.0]]);
    assert!(!agreement.holds(), "light where there is none agrees: {agreement:?}");
}
