//! Whole scenes, on the device and by the oracle.

mod common;

use anyhow::{Result, ensure};
use common::scenes::{EVERYTHING, ROOM};
use common::statistics::{Moments, SIGNIFICANCE, pixels_agree};
use common::{Gpu, film, prove, scene_of, small};
use thinlens::reference::Reference;
use thinlens::settings::Settings;
use thinlens::verify::{Agreement, verify};

fn with(scene: &str) -> Settings {
    let mut settings = small("version-4");
    let scene = scene_of(scene);
    (settings.estimator.camera, settings.estimator.lens) = (scene.camera, scene.lens);
    settings.estimator.scene = scene;
    settings
}

/// Catches a shader that strays from the mathematics anywhere on the way from the sampler to the
/// radiance: every sample of every scene is held against the oracle's. At edges rounding decides what
/// a ray meets, so a few may differ, and are counted.
#[test]
fn the_device_renders_what_the_oracle_does() {
    let scenes =
        [with(EVERYTHING), with(ROOM), small("version-4"), small("suffern-boxes"), small("suffern-mirror")];
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer();
        let (mut samples, mut mismatches, mut share, mut brightness) = (0, 0, 0.0_f64, 0.0_f64);
        for settings in &scenes {
            for jitter in [1.0, 0.0] {
                let mut settings = settings.clone();
                settings.estimator.jitter = jitter;
                let agreement = verify(&mut renderer, &settings)?;
                ensure!(agreement.samples == 64 * 48 * 8, "{} samples compared", agreement.samples);
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
            "lens_radius_times_1.05",
            "lens_radius_square_root",
            "focal_sphere",
            "focal_distance_times_1.02",
            "jitter_dropped",
            "one_pair_for_film_and_lens",
            "picture_upside_down",
            "picture_mirrored",
            "half_a_pixel_off",
            "sampler_without_seed",
            "disk_sector_mirrored",
            "shadow_limit_ignored",
            "light_by_the_cosine_to_the_axis",
        ],
    );
}

/// Catches a comparison that lets a NaN, a missing sample or a small tint over everything pass.
#[test]
fn the_bounds_are_bounds() {
    let oracle = vec![[0.5, 0.5, 0.5, 1.0]; 1000];
    let holds = |texel: [f32; 4], how_many: usize| {
        let mut device = vec![[0.5, 0.5, 0.5, 1.0]; 1000];
        device[..how_many].fill(texel);
        let mut agreement = Agreement::default();
        agreement.add(&device, &oracle);
        agreement.holds()
    };
    assert!(holds([0.5, 0.5, 0.5, 1.0], 1000) && holds([0.9, 0.5, 0.5, 1.0], 1));
    assert!(!holds([0.9, 0.5, 0.5, 1.0], 2));
    assert!(!holds([f32::NAN, 0.5, 0.5, 1.0], 2));
    assert!(!holds([0.5, 0.5, 0.5, 0.0], 2));
    assert!(!holds([0.502, 0.5, 0.5, 1.0], 1000));
    assert!(!Agreement::default().holds(), "nothing compared is nothing proved");
}

/// The share of a value that f32 may lose on a sample's way.
const ROUNDING: f64 = 1e-5;

/// Pictures of one scene with different seeds: of each pixel's channels, and of the whole picture's
/// mean, how the pictures' values are spread.
struct Spread {
    pixels: Vec<[Moments; 3]>,
    mean: Moments,
}

impl Spread {
    fn of(pictures: impl IntoIterator<Item = Vec<[f64; 3]>>) -> Self {
        let mut spread = Self { pixels: Vec::new(), mean: Moments::default() };
        for picture in pictures {
            spread.pixels.resize(picture.len(), Default::default());
            for (moments, pixel) in spread.pixels.iter_mut().zip(&picture) {
                (0..3).for_each(|channel| moments[channel].add(pixel[channel]));
            }
            spread.mean.add(picture.iter().flatten().sum::<f64>() / (3 * picture.len()) as f64);
        }
        spread
    }

    /// Holds the pictures, pixel by pixel and in their mean, against other ones of the same scene.
    fn agree(&self, other: &Self) -> Result<String> {
        let pixels = pixels_agree(&self.pixels, &other.pixels, ROUNDING)?;
        let p = self.mean.difference_p(&other.mean, ROUNDING);
        ensure!(p > SIGNIFICANCE, "a mean of {}, not {}: p = {p:.1e}", self.mean.mean, other.mean.mean);
        Ok(format!("{pixels}; mean, p = {p:.2}"))
    }
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

/// Catches what comparing the same samples cannot: a device and an oracle that agree on samples that
/// are wrong together. They get seeds of their own here, and only pictures that estimate the same
/// integral agree: in every channel of every pixel, with no share of failures allowed, and on the
/// whole.
#[test]
fn independent_seeds_estimate_the_same_picture() {
    const PICTURES: u32 = 24;
    // Many samples of the lamps: a rim that is 5% off must stand out of the noise of a pixel.
    let scenes: Vec<_> =
        [(with(LAMPS), [24, 18], 4096), (small("version-4"), [64, 36], 64), (with(EVERYTHING), [40, 30], 64)]
            .into_iter()
            .map(|(mut settings, size, samples)| {
                (settings.estimator.size, settings.samples) = (size, samples);
                let oracle = |seed| {
                    let mut estimator = settings.estimator.clone();
                    estimator.seed = 2000 + seed;
                    let film = Reference::new(&estimator).render(samples);
                    film.iter().map(|texel| [texel[0], texel[1], texel[2]]).collect()
                };
                // Two halves, side by side.
                let half = |seeds: std::ops::Range<u32>| seeds.map(oracle).collect::<Vec<Vec<[f64; 3]>>>();
                let pictures = std::thread::scope(|scope| {
                    let second = scope.spawn(|| half(PICTURES / 2..PICTURES));
                    let mut pictures = half(0..PICTURES / 2);
                    pictures.extend(second.join().expect("the oracle"));
                    pictures
                });
                (settings, Spread::of(pictures))
            })
            .collect();
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for (settings, expected) in &scenes {
            let mut settings = settings.clone();
            let pictures = (0..PICTURES).map(|seed| {
                settings.estimator.seed = seed;
                film(gpu, &settings)
                    .iter()
                    .map(|texel| [texel[0], texel[1], texel[2]].map(f64::from))
                    .collect()
            });
            figures.push(Spread::of(pictures).agree(expected)?);
        }
        Ok(figures.join("; "))
    };
    prove(
        check,
        &[
            "lens_radius_times_1.05",
            "lens_radius_square_root",
            "focal_sphere",
            "jitter_dropped",
            "one_pair_for_film_and_lens",
            "picture_upside_down",
            "half_a_pixel_off",
            "disk_radius_squared",
            "merge_forgets_the_batch",
            "light_by_the_lens_area",
        ],
    );
}
