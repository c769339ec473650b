//! How the error falls.

use super::Spread;
use super::report::Convergence;
use crate::error::Result;
use crate::renderer::Renderer;
use crate::settings::Settings;
use std::time::Instant;

/// The error is measured at each power of two of samples per pixel up to here.
pub const ERROR_SAMPLES: u32 = 256;

/// Samples per pixel of the picture that others are compared with. Its own squared error is n / 2048 of that of a picture
/// of n independent samples: at most an eighth, at n = 256.
pub(super) const REFERENCE_SAMPLES: u32 = 2048;

/// No run has this seed, so that the errors of the reference picture are independent of theirs.
const REFERENCE_SEED: u32 = 0xC0FF_EE00;

/// The root of the mean square of the differences of two films, over pixels and the channels r, g, b. The values are
/// linear light, for a tone curve would hide errors in bright parts.
///
/// # Panics
/// If the films have different sizes.
pub fn rmse(film: &[[f32; 4]], reference: &[[f32; 4]]) -> f64 {
    assert_eq!(film.len(), reference.len(), "films of one size");
    let squares = film
        .iter()
        .zip(reference)
        .flat_map(|(a, b)| (0..3).map(|channel| (f64::from(a[channel]) - f64::from(b[channel])).powi(2)));
    (squares.sum::<f64>() / (3 * film.len()) as f64).sqrt()
}

/// The reference: a picture that has nearly converged.
pub(super) fn reference(renderer: &mut Renderer, settings: &Settings) -> Result<Vec<[f32; 4]>> {
    let mut settings = settings.clone();
    settings.samples = REFERENCE_SAMPLES;
    settings.estimator.seed = REFERENCE_SEED;
    renderer.set(&settings)?;
    renderer.render(|_| ())?;
    renderer.read_film()
}

/// The error at 1, 2, 4, ... samples per pixel of pictures with several seeds.
pub(super) fn converge(
    renderer: &mut Renderer,
    settings: &Settings,
    reference: &[[f32; 4]],
    runs: u32,
) -> Result<Vec<Convergence>> {
    let stops = || (0..=ERROR_SAMPLES.ilog2()).map(|power| 1 << power);
    let pixels = settings.estimator.size.map(f64::from).iter().product::<f64>();
    // For each number of samples: the samples that were traced, the seconds, and the errors of the runs.
    let mut points: Vec<[Vec<f64>; 3]> = stops().map(|_| Default::default()).collect();
    let mut settings = settings.clone();
    for seed in 1..=runs {
        settings.estimator.seed = seed;
        let mut seconds = 0.0;
        for (samples, [traced, times, errors]) in stops().zip(&mut points) {
            settings.samples = samples;
            let started = Instant::now();
            renderer.set(&settings)?;
            renderer.render(|_| ())?;
            seconds += started.elapsed().as_secs_f64();
            traced.push(renderer.progress().traced as f64 / pixels);
            times.push(seconds);
            errors.push(rmse(&renderer.read_film()?, reference));
        }
    }
    let point = |(samples, values): (u32, &[Vec<f64>; 3])| {
        let [samples_traced, seconds, rmse] = values.each_ref().map(|values| Spread::of(values));
        Convergence { samples, samples_traced, seconds, rmse }
    };
    Ok(stops().zip(&points).map(point).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches an error that is a mean of the differences, that counts the samples' number as a channel,
    /// or that forgets the root.
    #[test]
    fn the_error_is_the_root_of_the_mean_square() {
        let film = |value: f32, count: f32| vec![[value, 2.0 * value, -value, count]; 10];
        assert_eq!(rmse(&film(1.0, 1.0), &film(1.0, 2048.0)), 0.0);
        // Differences of 3, 6 and -3 in every pixel: the root of (9 + 36 + 9) / 3.
        assert!((rmse(&film(4.0, 1.0), &film(1.0, 1.0)) - 18.0_f64.sqrt()).abs() < 1e-12);
        // One channel of one of ten pixels is off by 1.
        let mut spot = film(1.0, 1.0);
        spot[3][1] += 1.0;
        assert!((rmse(&spot, &film(1.0, 1.0)) - 30.0_f64.sqrt().recip()).abs() < 1e-12);
    }
}
