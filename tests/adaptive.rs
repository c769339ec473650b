//! Adaptive sampling: where pixels stop, what that saves, and what it must not change.

mod common;

use anyhow::{Result, ensure};
use common::scenes::{EVERYTHING, Night, a_lamp_at_night};
use common::{Gpu, bits, film, pixels, plain_scene_of, prove, render, settings_of, small};
use glam::Vec3;
use std::f64::consts::E;
use std::time::Duration;
use thinlens::gpu_types::Brightest;
use thinlens::reference::Reference;
use thinlens::reference::tone::srgb;
use thinlens::renderer::Pace;
use thinlens::scene::Overlay;
use thinlens::scene::{Gradient, SceneRef};
use thinlens::settings::Settings;

/// Pixels may stop at multiples of 16 samples, from 32 on.
const CUTS: [usize; 3] = [32, 48, 64];

fn luminance(color: [f64; 3]) -> f64 {
    0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]
}

/// The standard error of the mean over the mean, or over 0.05: by two passes over the samples.
fn relative_error(samples: &[f64]) -> f64 {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let moment: f64 = samples.iter().map(|sample| (sample - mean).powi(2)).sum();
    (moment / (count * (count - 1.0))).sqrt() / mean.max(0.05)
}

/// The largest share of a pixel's brightness that is lost on average because all samples of 3 x 3 pixels miss the brightest
/// thing that the pixel can meet. `p (1 - p)^N` is largest where p is `1 / N`, and there it is about `1 / (e N)`.
fn possible_loss(samples: &[f64], brightest: f64) -> f64 {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    (brightest - mean).max(0.0) / (E * 9.0 * count) / mean.max(0.05)
}

/// How many samples each pixel gets, by the oracle's samples. At home, so that none lands elsewhere.
fn expected_counts(settings: &Settings) -> Vec<usize> {
    let size @ [width, height] = settings.estimator.size.map(|edge| edge as usize);
    let reference = Reference::new(&settings.estimator);
    let of_pixel = |pixel| {
        let sample = |index| luminance(reference.sample(pixel, index).radiance.to_array());
        (0..settings.samples).map(sample).collect::<Vec<_>>()
    };
    let samples: Vec<Vec<f64>> = pixels(settings.estimator.size).map(of_pixel).collect();
    let brightest = Brightest::new(&settings.estimator);
    let brightest: Vec<f64> =
        pixels(settings.estimator.size).map(|pixel| brightest.at(pixel).into()).collect();
    let threshold = f64::from(settings.estimator.noise_threshold);
    let mut counts = vec![CUTS[0]; width * height];
    let mut active = vec![true; width * height];
    for cut in CUTS.into_iter().filter(|cut| *cut < settings.samples as usize) {
        let noisy: Vec<bool> = (counts.iter().zip(&samples).zip(&brightest))
            .map(|((count, samples), brightest)| {
                let samples = &samples[..*count];
                relative_error(samples) >= threshold.min(0.2)
                    || possible_loss(samples, *brightest) >= threshold.min(0.02)
            })
            .collect();
        let near = |at: usize, edge: usize| at.saturating_sub(1)..(at + 2).min(edge);
        for (place, active) in active.iter_mut().enumerate() {
            let (x, y) = (place % width, place / width);
            *active &= near(y, size[1]).any(|y| near(x, size[0]).any(|x| noisy[y * width + x]));
        }
        for (count, _) in counts.iter_mut().zip(&active).filter(|(_, active)| **active) {
            *count = (cut + 16).min(settings.samples as usize);
        }
    }
    counts
}

fn adaptive(scene: &str, threshold: f32) -> Settings {
    let mut settings = small(scene);
    settings.estimator.noise_threshold = threshold;
    settings.samples = 64;
    settings
}

/// Holds the counts of a picture against those by the oracle's samples. A share may differ, for a sample next to an
/// edge does.
fn compare_counts(gpu: &Gpu, settings: &Settings) -> Result<String> {
    let got = film(gpu, settings);
    let expected = expected_counts(settings);
    let differ = got.iter().zip(&expected).filter(|(got, expected)| got[3] != **expected as f32).count();
    let of_each = CUTS.map(|cut| expected.iter().filter(|count| **count == cut).count());
    let figures = format!("{of_each:?} pixels stop at {CUTS:?} samples, {differ} differ");
    ensure!(of_each[0] > 100 && of_each[2] > 100, "nothing to tell: {figures}");
    ensure!(differ * 50 <= got.len(), "{figures}");
    Ok(figures)
}

/// Catches a wrong second moment, error, threshold, neighbourhood or cut: every pixel stops where the
/// oracle's samples say.
#[test]
fn pixels_stop_where_their_samples_say() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        // The scene is so dark that errors are measured relative to the least luminance.
        let mut dark = plain_scene_of(EVERYTHING);
        dark.lights.iter_mut().for_each(|light| light.radiance *= 0.02);
        dark.ambient *= 0.02;
        dark.background = Gradient { horizon: 0.01 * Vec3::ONE, zenith: 0.02 * Vec3::ONE }.into();
        let mut dim = adaptive("version-4", 0.01);
        dim.estimator.camera = dark.camera;
        dim.estimator.lens = dark.lens;
        dim.estimator.scene = SceneRef::new(dark);
        let scenes = [
            ("version-4", adaptive("version-4", 0.08)),
            ("suffern-boxes", adaptive("suffern-boxes", 0.08)),
            ("suffern-mirror", adaptive("suffern-mirror", 0.05)),
            ("in the dark", dim),
        ];
        for (scene, settings) in scenes {
            figures.push(format!("{scene}: {}", compare_counts(gpu, &settings)?));
        }
        Ok(figures.join("; "))
    };
    prove(check, &["error"]);
}

/// Catches light that is counted as lost where it cannot be, and light that may be lost and is not counted: of lamps
/// that the samples of their discs miss, pixels stop where what may be lost is little enough, whatever the
/// threshold.
#[test]
fn pixels_stop_where_little_can_be_lost() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        // Rays meet nothing in the corners around the lamp's disc, and what may be lost there gets small enough before the
        // end. The sizes give cells of one pixel, and of two.
        for (size, radiance, threshold) in
            [([64, 48], 1.0, 0.2), ([64, 48], 1.0, 1.0), ([64, 48], 0.25, 0.005), ([161, 119], 1.0, 0.2)]
        {
            let mut settings = settings_of(&a_lamp_at_night(size[1], 36.0, 0.1, radiance), size, 64);
            settings.estimator.noise_threshold = threshold;
            figures.push(format!("{size:?}, threshold {threshold}: {}", compare_counts(gpu, &settings)?));
        }
        Ok(figures.join("; "))
    };
    prove(check, &["loss"]);
}

/// Catches an adaptive picture that adds other samples, or the same in another order, than one that is
/// not: a threshold that no pixel is below gives the same bits, and stopped pixels hold what they held.
#[test]
fn what_does_not_stop_is_what_it_was() {
    let gpu = Gpu::new();
    for jitter in [1.0, 3.0] {
        let mut settings = adaptive("version-4", 1e-30);
        settings.estimator.jitter = jitter;
        // Any pixel without noise would stop.
        settings.estimator.scene = common::scene_of(EVERYTHING);
        settings.estimator.camera = settings.estimator.scene.camera;
        settings.estimator.lens.diameter = 3.0;
        let got = film(&gpu, &settings);
        settings.estimator.noise_threshold = 0.0;
        let mut renderer = gpu.renderer(&settings);
        // The same batches as in an adaptive picture, between which pixels may stop.
        renderer.set_usual_batch(16);
        let uniform = render(&mut renderer, &settings).expect("a film");
        let same = bits(&got).iter().zip(bits(&uniform)).filter(|(got, uniform)| **got == *uniform).count();
        let stopped = got.iter().zip(&uniform).filter(|(got, uniform)| got[3] < uniform[3]).count();
        assert!(same + stopped >= got.len(), "jitter {jitter}: {same} the same, {stopped} stopped");
        assert!(same * 2 > got.len(), "jitter {jitter}: {same} of {} are the same", got.len());
    }
}

/// Catches a list that follows the order of execution, tiles that lose pixels of the list, and a sum of
/// samples that is not what the film holds.
#[test]
fn tiles_previews_and_pauses_change_no_count() {
    let gpu = Gpu::new();
    for (jitter, size) in [(1.0, [64, 48]), (1.0, [37, 51]), (2.5, [37, 51]), (1.0, [160, 90])] {
        let mut settings = adaptive("version-4", 0.03);
        settings.estimator.jitter = jitter;
        settings.estimator.size = size;
        let expected = bits(&film(&gpu, &settings));
        for preview in [false, true] {
            let pace = Pace { budget: Duration::ZERO, preview };
            let mut renderer = gpu.renderer(&settings);
            renderer.render_at(pace, |_| ()).expect("a rendering");
            let got = renderer.read_film().expect("a film");
            assert!(bits(&got) == expected, "jitter {jitter}, size {size:?}, preview {preview}");
            let in_film: f64 = got.iter().map(|texel| f64::from(texel[3])).sum();
            let traced = renderer.progress().traced as f64;
            // What a wide jitter throws over the edge is traced all the same.
            let lost = traced - in_film;
            assert!(lost == 0.0 || jitter > 1.0 && lost > 0.0, "{traced} traced, {in_film} in the film");
        }
    }
}

/// Catches counts that are shown as something else than the share of what is wanted.
#[test]
fn counts_can_be_looked_at() {
    let gpu = Gpu::new();
    let mut settings = adaptive("version-4", 0.08);
    settings.view.overlay = Some(Overlay::Count);
    let mut renderer = gpu.renderer(&settings);
    let film = render(&mut renderer, &settings).expect("a film");
    let picture = renderer.read_picture().expect("a picture");
    for (texel, shown) in film.iter().zip(picture.chunks_exact(4)) {
        let expected = 255.0 * srgb(f64::from(texel[3]) / 64.0);
        let off = shown[..3].iter().map(|value| (f64::from(*value) - expected).abs()).fold(0.0, f64::max);
        assert!(off <= 1.0, "{} samples are shown as {shown:?}", texel[3]);
    }
}

/// Catches a picture that goes on after its last pixel has stopped, one that starts again there, and
/// counts still shown as shares of what was wanted before.
#[test]
fn a_picture_without_noise_stops_early() {
    let gpu = Gpu::new();
    let mut settings = settings_of(&Night::new(48, 20.0).toml(), [64, 48], 4096);
    settings.estimator.noise_threshold = 1.0;
    let mut renderer = gpu.renderer(&settings);
    let film = render(&mut renderer, &settings).expect("a film");
    assert!(film.iter().all(|texel| texel[3] == 32.0));
    let progress = renderer.progress();
    assert_eq!((progress.samples, progress.active_pixels), (32, Some(0)));
    settings.view.overlay = Some(Overlay::Count);
    let mut shown_of = |samples| {
        settings.samples = samples;
        renderer.set(&settings).expect("valid settings");
        assert!(renderer.finished(), "another ceiling changes nothing");
        renderer.read_picture().expect("a picture")[0]
    };
    assert_eq!([32, 64, 8192].map(&mut shown_of), [255, 188, 13]);
    settings.estimator.noise_threshold = 0.01;
    renderer.set(&settings).expect("valid settings");
    assert!(!renderer.finished(), "another threshold starts anew");
}

/// Catches adaptive sampling that does not pay: as small an error as with the same number of samples
/// everywhere, for at most 60% of them.
#[test]
fn the_same_error_for_fewer_samples() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    settings.estimator.size = [320, 180];
    settings.samples = 3000;
    settings.estimator.seed = 99;
    let converged = film(&gpu, &settings);
    settings.estimator.seed = 0;
    let rmse = |film: &[[f32; 4]]| {
        let squares = film.iter().zip(&converged).flat_map(|(got, expected)| {
            [0, 1, 2].map(|channel| f64::from(got[channel] - expected[channel]).powi(2))
        });
        (squares.sum::<f64>() / (3 * converged.len()) as f64).sqrt()
    };
    settings.samples = 256;
    let uniform = rmse(&film(&gpu, &settings));
    (settings.samples, settings.estimator.noise_threshold) = (1024, 0.0496);
    let adaptive = film(&gpu, &settings);
    let mean = adaptive.iter().map(|texel| f64::from(texel[3])).sum::<f64>() / adaptive.len() as f64;
    let error = rmse(&adaptive);
    println!("an error of {error:.5} with {mean:.1} samples a pixel, of {uniform:.5} with 256 everywhere");
    assert!(error <= uniform && mean <= 0.6 * 256.0);
}
