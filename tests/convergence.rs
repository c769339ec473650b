//! How fast pictures converge.

mod common;

use anyhow::{Result, ensure};
use common::{Gpu, circle_of_confusion, film, pixels, prove, small};
use thinlens::reference::Reference;
use thinlens::reference::intersect::intersect;
use thinlens::settings::{Sampler, Settings};

/// The pixels of a picture whose middle shows something blurred over two pixels or more.
fn blurred(settings: &Settings) -> Vec<bool> {
    let estimator = &settings.estimator;
    let (camera, lens) = (&estimator.camera, &estimator.lens);
    let k = camera.view_distance_pixels(estimator.size[1]);
    let (diameter, focal_distance) = (f64::from(lens.diameter), f64::from(lens.focal_distance));
    let reference = Reference::new(estimator);
    pixels(estimator.size)
        .map(|pixel| {
            let ray = reference.primary_ray(pixel, [0.0, 0.0], [0.0, 0.0], 0.0);
            intersect(&estimator.scene, ray, 0.0).is_some_and(|hit| {
                let depth = hit.distance * ray.direction.dot(-camera.frame().w());
                circle_of_confusion(diameter, focal_distance, depth, k) > 2.0
            })
        })
        .collect()
}

/// The root of the mean square by which the chosen pixels are off.
fn rmse(film: &[[f32; 4]], converged: &[[f32; 4]], chosen: &[bool]) -> f64 {
    let (mut sum, mut count) = (0.0_f64, 0.0);
    for ((got, expected), _) in film.iter().zip(converged).zip(chosen).filter(|(_, chosen)| **chosen) {
        for channel in 0..3 {
            sum += f64::from(got[channel] - expected[channel]).powi(2);
            count += 1.0;
        }
    }
    (sum / count).sqrt()
}

/// Catches points that do not keep apart, in the film's pair or the lens's, or not across batches: in
/// the blurred parts of a picture 64 points of the Sobol sequence, scrambled or masked for each pixel, leave
/// at most 0.6 of the error of independent ones, and the error falls by a steeper power of their number.
#[test]
fn blur_converges_faster_than_with_independent_points() {
    const SEEDS: u32 = 4;
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for scene in ["suffern-boxes", "suffern-mirror"] {
            let mut settings = small(scene);
            settings.estimator.size = [120, 80];
            let chosen = blurred(&settings);
            let pixels = chosen.iter().filter(|chosen| **chosen).count();
            ensure!(pixels > 2000, "{pixels} pixels are blurred");
            let mut render = |sampler, samples, seed| {
                (settings.estimator.sampler, settings.samples, settings.estimator.seed) =
                    (sampler, samples, seed);
                film(gpu, &settings)
            };
            let converged = render(Sampler::Sobol, 4096, 99);
            let mut errors = |sampler| {
                [16, 64, 256].map(|samples| {
                    let power = |seed| rmse(&render(sampler, samples, seed), &converged, &chosen).powi(2);
                    ((0..SEEDS).map(power).sum::<f64>() / f64::from(SEEDS)).sqrt()
                })
            };
            let power = |errors: [f64; 3]| (errors[2] / errors[0]).log(16.0);
            let random = errors(Sampler::Random);
            // A Sobol sequence that converges to a picture of its own would spoil the others' power.
            ensure!(
                (power(random) + 0.5).abs() < 0.06,
                "{scene}: independent points fall with {}",
                power(random)
            );
            for sampler in [Sampler::Sobol, Sampler::BlueNoise] {
                let even = errors(sampler);
                let ratio = even[1] / random[1];
                figures.push(format!(
                    "{scene}, {pixels} blurred pixels, {sampler:?}: at 64 points {ratio:.3} of the error of \
                     independent ones, falling with the power {:.3}, theirs with {:.3}",
                    power(even),
                    power(random)
                ));
                let steeper = power(even) < power(random) - 0.08;
                ensure!(ratio < 0.6 && steeper, "{}", figures.join("; "));
            }
        }
        Ok(figures.join("; "))
    };
    prove(check, &["convergence"]);
}
