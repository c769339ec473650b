//! Holds what a device renders against the oracle, sample by sample.

use crate::error::{Error, Result};
use crate::reference::Reference;
use crate::renderer::Renderer;
use crate::settings::{DeviceChoice, Settings};
use crate::vulkan::{Device, Instance};

/// Two samples agree when every channel does within this share of the oracle's value or of one,
/// whichever is larger: some hundred times what f32 loses on the way of a ray.
pub const TOLERANCE: f64 = 1e-3;
/// Next to edges rounding decides what a ray hits, so samples may differ entirely. This share of
/// them may: several times what the built-in scenes show.
pub const MAX_MISMATCH_SHARE: f64 = 1e-3;

/// How far a device and the oracle agree.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Agreement {
    /// Samples compared.
    pub samples: u64,
    /// Of which so many differ by more than [`TOLERANCE`].
    pub mismatches: u64,
    /// The largest difference of those that agree, as a share of the oracle's value or of one.
    pub worst_agreeing: f64,
    /// Sum over samples and channels of the device's values, and of the oracle's.
    pub sums: [f64; 2],
}

impl Agreement {
    /// Takes in single samples: the device's and the oracle's, r, g, b and count of each pixel.
    pub fn add(&mut self, device: &[[f32; 4]], oracle: &[[f64; 4]]) {
        for (device, oracle) in device.iter().zip(oracle) {
            let mut difference = f64::from(device[3]) - oracle[3];
            for channel in 0..3 {
                let (device, oracle) = (f64::from(device[channel]), oracle[channel]);
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

    /// The share of samples that differ.
    pub fn mismatch_share(&self) -> f64 {
        self.mismatches as f64 / (self.samples as f64).max(1.0)
    }

    /// How much brighter the device's picture is than the oracle's, all in all, as a share.
    pub fn brightness_difference(&self) -> f64 {
        self.sums[0] / self.sums[1] - 1.0
    }

    /// Whether it is within bounds.
    pub fn holds(&self) -> bool {
        // Mismatches at edges go either way, so the brightness moves by less than their share.
        self.samples > 0
            && self.mismatch_share() <= MAX_MISMATCH_SHARE
            && self.brightness_difference().abs() <= MAX_MISMATCH_SHARE
    }
}

/// Renders one sample a pixel with each of the seeds `seed .. seed + samples` on the device and with
/// the oracle, compares sample by sample, and fails outside the bounds.
///
/// # Errors
/// What Vulkan says, [`Error::OutOfRange`], or [`Error::Disagreement`].
pub fn verify(renderer: &mut Renderer, settings: &Settings) -> Result<Agreement> {
    let mut agreement = Agreement::default();
    let mut settings = settings.clone();
    let (first, count) = (settings.estimator.seed, settings.samples);
    settings.samples = 1;
    for seed in 0..count {
        settings.estimator.seed = first.wrapping_add(seed);
        renderer.set(&settings)?;
        renderer.render(|_| ())?;
        agreement.add(&renderer.read_film()?, &Reference::new(&settings.estimator).render(1));
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

/// Verifies a device with several pictures and says how they agree, a line each.
///
/// # Errors
/// As [`verify`], for the first that does not hold; [`Error::Validation`] if the layer spoke.
pub fn run(pictures: &[Settings], choice: &DeviceChoice) -> Result<String> {
    let instance = Instance::new(choice.validation, None)?;
    let device = Device::open(&instance, choice.device.as_deref(), None)?;
    let mut renderer = Renderer::new(&device)?;
    let mut lines = vec![format!("{} ({})", device.info().name, device.info().driver)];
    for settings in pictures {
        let agreement = verify(&mut renderer, settings)?;
        let [width, height] = settings.estimator.size;
        lines.push(format!(
            "{:16} {width}x{height}, {} samples: {} differ ({:.4}%, at most {}%), the others by {:.1e} at most, \
             brightness by {:+.4}%",
            settings.estimator.scene.name,
            agreement.samples,
            agreement.mismatches,
            100.0 * agreement.mismatch_share(),
            100.0 * MAX_MISMATCH_SHARE,
            agreement.worst_agreeing,
            100.0 * agreement.brightness_difference(),
        ));
    }
    drop((renderer, device));
    instance.check_validation()?;
    Ok(lines.join("\n"))
}
