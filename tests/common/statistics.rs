//! When chance explains a difference, and when it does not.

use anyhow::{Result, ensure};
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal, StudentsT};

/// How often chance alone turns a comparison red, whatever the number of things it looks at. The seeds
/// are fixed, so on one device it is red always or never.
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
    let counts: Vec<f64> = counts.iter().map(|count| f64::from(*count)).collect();
    fit_p(&counts, &vec![expected; counts.len()])
}

/// The chance of counts at least that far from what is expected: K. Pearson's chi-square test. Places of which little is
/// expected count as one.
pub fn fit_p(counts: &[f64], expected: &[f64]) -> f64 {
    let (mut chi_square, mut terms) = (0.0, 0.0);
    let mut add = |count: f64, expected: f64| {
        chi_square += (count - expected).powi(2) / expected;
        terms += 1.0;
    };
    let mut rest = (0.0, 0.0);
    for (count, expected) in counts.iter().zip(expected) {
        if *expected >= 5.0 {
            add(*count, *expected);
        } else {
            rest = (rest.0 + count, rest.1 + expected);
        }
    }
    // So few are expected there that at least one is divided by.
    if rest != (0.0, 0.0) {
        add(rest.0, rest.1.max(1.0));
    }
    ChiSquared::new(terms - 1.0).expect("two counts or more").sf(chi_square)
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

    /// The moments of numbers whose mean is known, with the standard error of that mean.
    pub fn known(count: f64, mean: f64, error: f64) -> Self {
        Self { count, mean, sum_of_squares: error * error * count * (count - 1.0) }
    }

    /// The variance of the mean.
    pub fn mean_variance(&self) -> f64 {
        self.sum_of_squares / (self.count - 1.0) / self.count
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

/// Pictures of one scene with different seeds: of each pixel's channels, and of the whole picture's
/// mean, how the pictures' values are spread.
pub struct Spread {
    pub pixels: Vec<[Moments; 3]>,
    pub mean: Moments,
}

impl Spread {
    pub fn of(pictures: impl IntoIterator<Item = Vec<[f64; 3]>>) -> Self {
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

    /// The spread of pictures of which only the moments of the pixels are known. The error of their mean is an upper bound:
    /// pixels are independent, but the channels of a pixel are not.
    pub fn of_pixels(pixels: Vec<[Moments; 3]>) -> Self {
        let all = || pixels.iter().flatten();
        let count = all().count() as f64;
        let mean = all().map(|moments| moments.mean).sum::<f64>() / count;
        let variance = 3.0 * all().map(Moments::mean_variance).sum::<f64>() / (count * count);
        Self { mean: Moments::known(pixels[0][0].count, mean, variance.sqrt()), pixels }
    }

    /// Holds these pictures against other ones of the same scene, by tests on every channel of every
    /// pixel's mean, and on the mean of all. No share of the pixels may fail.
    pub fn agree(&self, other: &Self, rounding: f64) -> Result<String> {
        ensure!(self.pixels.len() == other.pixels.len(), "pictures of another size");
        let allowed = sidak(3 * self.pixels.len());
        let (mut least, mut largest) = (1.0_f64, 0.0_f64);
        for (number, (pixel, expected)) in self.pixels.iter().zip(&other.pixels).enumerate() {
            for (got, expected) in pixel.iter().zip(expected) {
                ensure!(got.mean.is_finite(), "pixel {number} is {}", got.mean);
                least = least.min(got.difference_p(expected, rounding));
                largest = largest.max((got.mean - expected.mean).abs());
                ensure!(
                    least > allowed,
                    "pixel {number} is {:.5} +- {:.5}, not {:.5} +- {:.5}: p = {least:.1e}",
                    got.mean,
                    got.mean_variance().sqrt(),
                    expected.mean,
                    expected.mean_variance().sqrt()
                );
            }
        }
        let p = self.mean.difference_p(&other.mean, rounding);
        ensure!(p > SIGNIFICANCE, "a mean of {}, not {}: p = {p:.1e}", self.mean.mean, other.mean.mean);
        Ok(format!(
            "{} pixels, least p = {least:.1e} of {allowed:.1e} allowed, {largest:.1e} off at most; means {:.5} and \
             {:.5}, p = {p:.2}",
            self.pixels.len(),
            self.mean.mean,
            other.mean.mean
        ))
    }
}
