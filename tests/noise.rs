//! How the error is spread over a picture: what is left of it for an eye that averages neighbours.

mod common;

use anyhow::{Result, ensure};
use common::probe::{STEP, indices, sample_bits};
use common::{Gpu, pixels, prove, render, small};
use std::f64::consts::TAU;
use std::ops::Range;
use thinlens::reference::sampler::TILE;
use thinlens::settings::{Sampler, Settings};

const SIZE: [u32; 2] = [400, 300];
/// Standard deviation in pixels of the eye's blur.
const BLUR: f64 = 1.5;

/// A picture blurred by a Gaussian, as far in from its border as the Gaussian reaches.
fn blurred(picture: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let reach = (3.0 * BLUR).ceil() as usize;
    let weight = |at: usize| (-0.5 * ((at as f64 - reach as f64) / BLUR).powi(2)).exp();
    let sum: f64 = (0..=2 * reach).map(weight).sum();
    let weights: Vec<f64> = (0..=2 * reach).map(|at| weight(at) / sum).collect();
    let along = |from: &[[f64; 3]], at: usize, step: usize| {
        let mut mean = [0.0; 3];
        for (number, weight) in weights.iter().enumerate() {
            (0..3).for_each(|channel| mean[channel] += weight * from[at + number * step][channel]);
        }
        mean
    };
    let [width, height] = SIZE.map(|size| size as usize);
    let (inner_width, inner_height) = (width - 2 * reach, height - 2 * reach);
    let across = |pixel| along(picture, pixel / inner_width * width + pixel % inner_width, 1);
    let rows: Vec<_> = (0..inner_width * height).map(across).collect();
    (0..inner_width * inner_height).map(|pixel| along(&rows, pixel, inner_width)).collect()
}

/// Catches a tile that does not fit its pixels, or a sampler that no tile arranges: after one sample and
/// after four, what blurring leaves of the error is less than with a Sobol sequence of its own for each
/// pixel, and the error itself is as large.
#[test]
fn blurring_leaves_less_of_blue_noise() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        // The largest shares of the blurred error: after one sample with seed 0, with other seeds, and after four samples.
        let bounds = [
            ("version-4", [0.90, 0.92, 0.96]),
            ("suffern-boxes", [0.76, 0.80, 0.95]),
            ("suffern-mirror", [0.73, 0.82, 0.96]),
        ];
        for (scene, [first, first_of_others, fourth]) in bounds {
            let settings = Settings { samples: 256, ..small(scene) };
            let mut renderer = gpu.renderer(&settings);
            let mut film = |sampler, samples, seed| {
                let mut settings = settings.clone();
                (settings.estimator.size, settings.estimator.sampler) = (SIZE, sampler);
                (settings.samples, settings.estimator.seed) = (samples, seed);
                render(&mut renderer, &settings)
            };
            let converged = film(Sampler::Sobol, 256, 99)?;
            // The mean powers of the error and of the blurred error.
            let mut powers = |sampler, samples, seeds: Range<u32>| -> Result<[f64; 2]> {
                let mut powers = [0.0; 2];
                for seed in seeds.clone() {
                    let film = film(sampler, samples, seed)?;
                    let of_pixel = |(a, b): (&[f32; 4], &[f32; 4])| {
                        [0, 1, 2].map(|channel| f64::from(a[channel] - b[channel]))
                    };
                    let error: Vec<_> = film.iter().zip(&converged).map(of_pixel).collect();
                    for (power, picture) in powers.iter_mut().zip([&error, &blurred(&error)]) {
                        let sum: f64 = picture.iter().flatten().map(|value| value * value).sum();
                        *power += sum / picture.len() as f64 / seeds.len() as f64;
                    }
                }
                Ok(powers)
            };
            for (samples, most, max_of_others) in [(1, first, first_of_others), (4, fourth, fourth)] {
                let sobol = powers(Sampler::Sobol, samples, 0..3)?;
                for (seeds, most) in [(0..1, most), (1..4, max_of_others)] {
                    let blue = powers(Sampler::BlueNoise, samples, seeds.clone())?;
                    let [error, blurred] = [0, 1].map(|kind| (blue[kind] / sobol[kind]).sqrt());
                    figures.push(format!(
                        "{scene}, {samples} samples, seeds {seeds:?}: {blurred:.3} of the blurred error, \
                         {error:.3} of the error"
                    ));
                    ensure!(blurred < most && (error - 1.0).abs() < 0.05, "{}", figures.join("; "));
                }
            }
        }
        Ok(figures.join("; "))
    };
    prove(check, &["noise"]);
}

/// Catches a tile that prefers numbers with which a pixel errs little, those in the middle of pixel and
/// lens: it would be sure of a wrong picture. Each number occurs once.
#[test]
fn the_tile_only_arranges() {
    let tile = include_bytes!("../shaders/blue_noise_tile.bin");
    let mut numbers: Vec<u16> =
        tile.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    numbers.sort_unstable();
    assert!(numbers.into_iter().map(u32::from).eq(0..TILE * TILE));
}

/// Catches a tile that is arranged for one dimension only, or has a seam: in the first sample's values
/// over the tile, each dimension has little power at low frequencies.
#[test]
fn the_tile_has_no_low_frequencies() {
    const LOW: i32 = 12;
    let check = |gpu: &Gpu| -> Result<String> {
        let size = [TILE; 2];
        let values = sample_bits(gpu, Sampler::BlueNoise, &indices(size, 0, 0));
        let mut figures = Vec::new();
        for (axis, name) in ["film x", "film y", "lens x", "lens y"].iter().enumerate() {
            let (mut sum, mut count) = (0.0, 0.0);
            for (fx, fy) in (-LOW..=LOW).flat_map(|fy| (0..=LOW).map(move |fx| (fx, fy))) {
                if fx * fx + fy * fy > LOW * LOW || (fx, fy) == (0, 0) {
                    continue;
                }
                let (mut real, mut imaginary) = (0.0, 0.0);
                for ([x, y], values) in pixels(size).zip(&values) {
                    let turns = (fx as f64 * f64::from(x) + fy as f64 * f64::from(y)) / f64::from(TILE);
                    let value = f64::from(values[axis]) * STEP - 0.5;
                    real += value * (TAU * turns).cos();
                    imaginary += value * (TAU * turns).sin();
                }
                // Independent uniform values have variances of 1/12, and so a mean power of one.
                let power = 12.0 * (real * real + imaginary * imaginary) / f64::from(TILE * TILE);
                (sum, count) = (sum + power, count + 1.0);
            }
            let mean = sum / count;
            figures.push(format!("{name} {mean:.3}"));
            ensure!(mean < [0.95, 0.95, 0.1, 0.1][axis], "{}", figures.join("; "));
        }
        Ok(format!("of the power of white noise: {}", figures.join("; ")))
    };
    prove(check, &["noise"]);
}
