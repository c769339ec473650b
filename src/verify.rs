//! Compares what a device renders with the oracle, sample by sample.

use crate::error::{Error, Result};
use crate::reference::Reference;
use crate::reference::film::Film;
use crate::renderer::Renderer;
use crate::scene::Integrator;
use crate::settings::{DeviceChoice, Estimator, Settings};
use crate::vulkan::{Device, Instance};

/// Two samples agree when every channel differs by at most this share of the oracle's value or of 1, whichever is larger.
/// That is about a hundred times what f32 loses along a ray.
pub const TOLERANCE: f64 = 1e-3;
/// The share of samples of one ray that may differ. Next to edges, rounding decides what a ray hits, so some samples differ entirely.
/// This is several times the share that the built-in scenes show.
pub const MAX_MISMATCH_SHARE: f64 = 1e-3;

/// The whole picture may be brighter or darker by this share, however many samples differ.
pub const MAX_BRIGHTNESS_DIFFERENCE: f64 = 3e-3;

/// After so many samples the film starts anew, for one more would change a mean in f32 too little to be compared.
const SAMPLES_PER_SEED: u32 = 16;

/// How far a device and the oracle agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// By how much more samples may differ than [`MAX_MISMATCH_SHARE`]: see [`Agreement::of`].
    pub leeway: u32,
    /// Samples compared.
    pub samples: u64,
    /// Samples that differ by more than [`TOLERANCE`].
    pub mismatches: u64,
    /// The largest difference of samples that agree, as a share of the oracle's value or of 1, whichever is larger.
    pub worst_agreeing: f64,
    /// Sum over samples and channels of the device's values, and of the oracle's.
    pub sums: [f64; 2],
}

impl Agreement {
    /// Adds samples of the device and of the oracle: the r, g, b of each pixel, and how many samples it got.
    pub fn add(&mut self, device: &[[f64; 4]], oracle: &[[f64; 4]]) {
        // A pixel that got no sample on either side has nothing to compare.
        let texels =
            device.iter().zip(oracle).filter(|(device, oracle)| device[3] != 0.0 || oracle[3] != 0.0);
        for (device, oracle) in texels {
            let mut difference = device[3] - oracle[3];
            for channel in 0..3 {
                let (device, oracle) = (device[channel], oracle[channel]);
                let relative = (device - oracle).abs() / oracle.abs().max(1.0);
                // A NaN is the largest difference of all.
                difference = if relative.is_nan() { f64::INFINITY } else { difference.abs().max(relative) };
                self.sums[0] += device;
                self.sums[1] += oracle;
            }
            self.samples += 1;
            if difference > TOLERANCE {
                self.mismatches += 1;
            } else {
                self.worst_agreeing = self.worst_agreeing.max(difference);
            }
        }
    }

    /// Nothing compared yet.
    pub fn new(leeway: u32) -> Self {
        Self { leeway, samples: 0, mismatches: 0, worst_agreeing: 0.0, sums: [0.0; 2] }
    }

    /// Nothing compared yet, of a picture with these settings. With colour errors, a sample has three rays, each of which
    /// may meet an edge. A path has many, and each curved surface that scatters it magnifies what rounding has changed.
    pub fn of(estimator: &Estimator) -> Self {
        let colors = if estimator.dispersion() == 0.0 { 1 } else { 3 };
        let bounces = match estimator.integrator {
            Integrator::Whitted => 1,
            Integrator::Path => 10,
        };
        Self::new(colors * bounces)
    }

    /// The share of samples that may differ.
    pub fn max_mismatch_share(&self) -> f64 {
        f64::from(self.leeway) * MAX_MISMATCH_SHARE
    }

    /// The share of samples that differ.
    pub fn mismatch_share(&self) -> f64 {
        self.mismatches as f64 / (self.samples as f64).max(1.0)
    }

    /// How much brighter the device's whole picture is than the oracle's, as a share.
    pub fn brightness_difference(&self) -> f64 {
        // Two black pictures are equally bright.
        if self.sums[0] == self.sums[1] { 0.0 } else { self.sums[0] / self.sums[1] - 1.0 }
    }

    /// Whether the differences are within bounds.
    pub fn holds(&self) -> bool {
        // Samples that differ at edges are as often brighter as darker, so the brightness differs by less than their share.
        self.samples > 0
            && self.mismatch_share() <= self.max_mismatch_share()
            && self.brightness_difference().abs() <= self.max_mismatch_share().min(MAX_BRIGHTNESS_DIFFERENCE)
    }
}

/// Renders sample after sample of each pixel on the device and with the oracle, compares what each
/// adds to the film, and fails outside the bounds. Every `SAMPLES_PER_SEED` samples the seed is raised
/// by one.
///
/// # Errors
/// [`Error::Disagreement`], [`Error::OutOfRange`], or those of rendering.
pub fn verify(renderer: &mut Renderer, settings: &Settings) -> Result<Agreement> {
    let mut agreement = Agreement::of(&settings.estimator);
    let mut settings = settings.clone();
    let samples = settings.samples;
    for first in (0..samples).step_by(SAMPLES_PER_SEED as usize) {
        let reference = Reference::new(&settings.estimator);
        let mut film = Film::new(settings.estimator.size);
        let empty = vec![[0.0; 4]; film.texels().len()];
        let mut before = [empty.clone(), empty];
        for index in 0..samples.saturating_sub(first).min(SAMPLES_PER_SEED) {
            settings.samples = index + 1;
            renderer.set(&settings)?;
            renderer.render(|_| ())?;
            reference.add_sample(&mut film, index);
            let device = renderer.read_film()?.iter().map(|texel| texel.map(f64::from)).collect();
            let after = [device, film.texels().to_vec()];
            let [device, oracle] = [0, 1].map(|side| added(&before[side], &after[side]));
            agreement.add(&device, &oracle);
            before = after;
        }
        settings.estimator.seed = settings.estimator.seed.wrapping_add(1);
    }
    if agreement.holds() {
        return Ok(agreement);
    }
    Err(Error::Disagreement {
        scene: settings.estimator.scene.name.clone(),
        mismatches: agreement.mismatch_share(),
        brightness: agreement.brightness_difference(),
    })
}

/// The mean and number of the samples that landed in each pixel between two states of a film.
fn added(before: &[[f64; 4]], after: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let texel = |(before, after): (&[f64; 4], &[f64; 4])| {
        let count = after[3] - before[3];
        let mean = |channel: usize| match count {
            0.0 => 0.0,
            _ => (after[3] * after[channel] - before[3] * before[channel]) / count,
        };
        [mean(0), mean(1), mean(2), count]
    };
    before.iter().zip(after).map(texel).collect()
}

/// Verifies a device with several pictures, and gives a line about each.
///
/// # Errors
/// As [`verify`] for the first picture that disagrees, and [`Error::Validation`] if the layer had something to say.
pub fn run(pictures: &[Settings], choice: &DeviceChoice) -> Result<String> {
    let instance = Instance::new(choice.validation, None)?;
    let device = Device::open(&instance, choice.device.as_deref(), None)?;
    device.keep_pipelines();
    let mut lines = vec![format!("{} ({})", device.info().name, device.info().driver)];
    for settings in pictures {
        let agreement = verify(&mut Renderer::new(&device, settings)?, settings)?;
        let [width, height] = settings.estimator.size;
        lines.push(format!(
            "{:16} {width}x{height}, {} samples: {} differ ({:.4}%, at most {}%), the others by {:.1e} at most, \
             brightness by {:+.4}%",
            settings.estimator.scene.name,
            agreement.samples,
            agreement.mismatches,
            100.0 * agreement.mismatch_share(),
            100.0 * agreement.max_mismatch_share(),
            agreement.worst_agreeing,
            100.0 * agreement.brightness_difference(),
        ));
    }
    drop(device);
    instance.check_validation()?;
    Ok(lines.join("\n"))
}
