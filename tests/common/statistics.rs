//! When chance explains a difference, and when it does not.

use anyhow::{Result, ensure};
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal, StudentsT};

/// A test that chance alone turns red this often, whatever the number of things it looks at. The
/// seeds are fixed, so it is red always or never.
pub const SIGNIFICANCE: f64 = 0.01;

/// How unlikely one of `tests` independent results must be, so that the unlikeliest of them is below
/// it by chance in a share of [`SIGNIFICANCE`]: Z. Sidak, JASA 62, 1967.
pub fn sidak(tests: usize) -> f64 {
    // 1 - (1 - SIGNIFICANCE)^(1 / tests), with all its digits.
    -f64::exp_m1(f64::ln_1p(-SIGNIFICANCE) / tests as f64)
}

/// The chance of a standard normal value at least that far from zero.
pub fn normal_p(z: f64) -> f64 {
    2.0 * Normal::standard().sf(z.abs())
}

/// The chance of a Student's t at least that far from zero.
pub fn student_p(t: f64, degrees_of_freedom: f64) -> f64 {
    let t_distribution = StudentsT::new(0.0, 1.0, degrees_of_freedom).expect("degrees of freedom");
    2.0 * t_distribution.sf(t.abs())
}

/// The chance of counts at least that uneven, where all are expected to be equal.
pub fn evenness_p(counts: &[u32]) -> f64 {
    let expected = counts.iter().map(|count| f64::from(*count)).sum::<f64>() / counts.len() as f64;
    assert!(expected >= 5.0, "too few for a chi-square test");
    let chi_square = counts.iter().map(|count| (f64::from(*count) - expected).powi(2) / expected).sum();
    ChiSquared::new(counts.len() as f64 - 1.0).expect("two counts or more").sf(chi_square)
}

/// Mean and variance of a few numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct Moments {
    pub count: f64,
    pub mean: f64,
    sum_of_squares: f64,
}

impl Moments {
    /// B. Welford, Technometrics 4(3), 1962.
    pub fn add(&mut self, value: f64) {
        self.count += 1.0;
        let before = value - self.mean;
        self.mean += before / self.count;
        self.sum_of_squares += before * (value - self.mean);
    }

    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut moments = Self::default();
        values.into_iter().for_each(|value| moments.add(value));
        moments
    }

    /// Of so many numbers whose mean, and whose mean's standard error, are known.
    pub fn known(count: f64, mean: f64, error: f64) -> Self {
        Self { count, mean, sum_of_squares: error * error * count * (count - 1.0) }
    }

    pub fn variance(&self) -> f64 {
        self.sum_of_squares / (self.count - 1.0)
    }

    /// The variance of the mean.
    pub fn mean_variance(&self) -> f64 {
        self.variance() / self.count
    }

    /// How unlikely it is by chance that two means differ as much, beyond a share of them that may
    /// be lost by rounding: B. Welch, Biometrika 34, 1947. Numbers without any spread differ surely
    /// or not at all.
    pub fn difference_p(&self, other: &Self, rounding: f64) -> f64 {
        let difference = ((self.mean - other.mean).abs() - rounding * other.mean.abs()).max(0.0);
        let (a, b) = (self.mean_variance(), other.mean_variance());
        if a + b == 0.0 {
            return if difference == 0.0 { 1.0 } else { 0.0 };
        }
        let freedom = (a + b).powi(2) / (a * a / (self.count - 1.0) + b * b / (other.count - 1.0));
        student_p(difference / (a + b).sqrt(), freedom)
    }
}

/// Holds every channel of every pixel of some pictures against other pictures of the same scene, by a
/// test on their means. No share of the pixels may fail.
pub fn pixels_agree(pixels: &[[Moments; 3]], expected: &[[Moments; 3]], rounding: f64) -> Result<String> {
    assert_eq!(pixels.len(), expected.len());
    let (mut least, mut largest) = (1.0_f64, 0.0_f64);
    for (number, (pixel, expected)) in pixels.iter().zip(expected).enumerate() {
        for (got, expected) in pixel.iter().zip(expected) {
            least = least.min(got.difference_p(expected, rounding));
            largest = largest.max((got.mean - expected.mean).abs());
            ensure!(
                least > sidak(3 * pixels.len()),
                "pixel {number} is {:.5} +- {:.5}, not {:.5} +- {:.5}: p = {least:.1e}",
                got.mean,
                got.mean_variance().sqrt(),
                expected.mean,
                expected.mean_variance().sqrt()
            );
        }
    }
    let allowed = sidak(3 * pixels.len());
    Ok(format!(
        "{} pixels, least p = {least:.1e} of {allowed:.1e} allowed, {largest:.1e} off at most",
        pixels.len()
    ))
}
