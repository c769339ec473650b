//! How the error is spread over the picture: what is left of it for an eye that averages neighbours.

mod common;

use anyhow::{Result, ensure};
use common::{Gpu, prove, render, small};
use thinlens::renderer::Renderer;
use thinlens::settings::{Sampler, Settings};

const SIZE: [u32; 2] = [192, 144];
const COUNTS: [u32; 5] = [1, 2, 4, 8, 16];
/// Standard deviation in pixels of the eye's blur.
const BLUR: f64 = 1.5;

/// Red, green and blue of each pixel, less those of the converged picture.
fn error(renderer: &mut Renderer, settings: &Settings, converged: &[[f32; 4]]) -> Result<Vec<[f64; 3]>> {
    let film = render(renderer, settings)?;
    let less = |(texel, of): (&[f32; 4], &[f32; 4])| [0, 1, 2].map(|i| f64::from(texel[i] - of[i]));
    Ok(film.iter().zip(converged).map(less).collect())
}

/// A picture blurred by a Gaussian, as far in from its border as the Gaussian reaches.
fn blurred(picture: &[[f64; 3]], sigma: f64) -> Vec<[f64; 3]> {
    let reach = (3.0 * sigma).ceil() as usize;
    let weights: Vec<f64> =
        (0..=2 * reach).map(|at| (-0.5 * ((at as f64 - reach as f64) / sigma).powi(2)).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let [width, height] = SIZE.map(|size| size as usize);
    let along = |from: &[[f64; 3]], at: usize, step: usize| {
        let mut mean = [0.0; 3];
        for (number, weight) in weights.iter().enumerate() {
            (0..3).for_each(|channel| mean[channel] += weight / sum * from[at + number * step][channel]);
        }
        mean
    };
    let inner = width - 2 * reach;
    let rows: Vec<_> = (0..inner * height)
        .map(|pixel| along(picture, pixel / inner * width + pixel % inner, 1))
        .collect();
    (0..inner * (height - 2 * reach)).map(|pixel| along(&rows, pixel, inner)).collect()
}

fn power(picture: &[[f64; 3]]) -> f64 {
    picture.iter().flatten().map(|value| value * value).sum::<f64>() / (3 * picture.len()) as f64
}

#[test]
fn figures() {
    let gpu = Gpu::new();
    let mut renderer = gpu.renderer();
    for scene in ["version-4", "suffern-boxes", "suffern-mirror"] {
        let mut settings = small(scene);
        settings.estimator.size = SIZE;
        settings.estimator.sampler = Sampler::Sobol;
        settings.samples = 8192;
        settings.estimator.seed = 99;
        let converged = render(&mut renderer, &settings).unwrap();
        for count in [1, 2, 4, 8, 16, 64] {
            settings.samples = count;
            let mut of = |sampler, seed| {
                (settings.estimator.sampler, settings.estimator.seed) = (sampler, seed);
                let e = error(&mut renderer, &settings, &converged).unwrap();
                [power(&e), power(&blurred(&e, 1.0)), power(&blurred(&e, 1.5)), power(&blurred(&e, 2.5))]
            };
            let mut mean = |sampler, seeds: std::ops::Range<u32>| {
                let n = seeds.len() as f64;
                let mut sum = [0.0; 4];
                for seed in seeds { of(sampler, seed).iter().zip(&mut sum).for_each(|(p, s)| *s += p / n); }
                sum
            };
            let (random, sobol, blue, other) = (mean(Sampler::Random, 0..4), mean(Sampler::Sobol, 0..8), mean(Sampler::BlueNoise, 0..1), mean(Sampler::BlueNoise, 1..9));
            let r = |a: [f64; 4], b: [f64; 4]| [0, 1, 2, 3].map(|i| (a[i] / b[i]).sqrt());
            println!("{scene} {count}: blue/sobol {:.3?}, other seeds {:.3?}, blue/random {:.3?}", r(blue, sobol), r(other, sobol), r(blue, random));
        }
    }
}
