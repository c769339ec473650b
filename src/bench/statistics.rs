//! Medians and quartiles of repeated measurements.

use serde::Serialize;

/// Repeated measurements of one thing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Half of them are below.
    pub median: f64,
    /// A quarter of them is below.
    pub lower_quartile: f64,
    /// A quarter of them is above.
    pub upper_quartile: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

impl Spread {
    /// The spread of these values, of which there must be at least one. Quartiles between two values are interpolated.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
            below + (above - below) * place.fract()
        };
        Self {
            median: at(0.5),
            lower_quartile: at(0.25),
            upper_quartile: at(0.75),
            min: at(0.0),
            max: at(1.0),
        }
    }

    /// The quartiles' distance from each other, as a share of the median.
    pub fn relative(&self) -> f64 {
        (self.upper_quartile - self.lower_quartile) / self.median
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches a mean in place of the median, and quartiles that are off by one place.
    #[test]
    fn a_spread_has_its_order_statistics() {
        let spread = Spread::of(&[5.0, 1.0, 100.0, 2.0, 3.0]);
        let Spread { median, lower_quartile, upper_quartile, min, max } = spread;
        assert_eq!([min, lower_quartile, median, upper_quartile, max], [1.0, 2.0, 3.0, 5.0, 100.0]);
        assert_eq!(spread.relative(), 1.0);
        let Spread { median, lower_quartile, .. } = Spread::of(&[2.0, 1.0]);
        assert_eq!([median, lower_quartile], [1.5, 1.25]);
        assert_eq!(Spread::of(&[7.0]).max, 7.0);
    }
}
