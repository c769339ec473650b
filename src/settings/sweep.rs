//! A series of pictures with different lenses or focal distances.

use super::{Changes, Settings, Value};
use crate::error::{Error, Result};
use crate::scene::CameraModel;

/// The largest number of pictures on a sheet.
const MOST: usize = 64;

/// The value that changes from picture to picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Sweep {
    /// The lens, by its f-number.
    FNumbers(Vec<f64>),
    /// The lens, by its diameter in scene units.
    LensDiameters(Vec<f32>),
    /// The distance of the focal plane in scene units.
    FocalDistances(Vec<f32>),
}

impl Sweep {
    /// The settings of each picture, in order: these settings with the one value changed.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for values out of range, too many of them, or a camera without a lens.
    pub fn pictures(&self, settings: &Settings) -> Result<Vec<Settings>> {
        if settings.estimator.model != CameraModel::ThinLens {
            return Err(Error::OutOfRange(
                "a sweep needs a lens, which this camera has not; add --camera thin-lens".into(),
            ));
        }
        let picture = |flag: &str, value: Value| {
            let mut settings = settings.clone();
            Changes::of(flag, value).apply(&mut settings)?;
            Ok(settings)
        };
        let single = |flag: &'static str| move |value: &f32| picture(flag, Value::Single(*value));
        let pictures: Result<Vec<Settings>> = match self {
            Self::FNumbers(values) => {
                values.iter().map(|value| picture("f-number", Value::Double(*value))).collect()
            }
            Self::LensDiameters(values) => values.iter().map(single("lens-diameter")).collect(),
            Self::FocalDistances(values) => values.iter().map(single("focal-distance")).collect(),
        };
        let pictures = pictures?;
        if pictures.is_empty() || pictures.len() > MOST {
            let count = pictures.len();
            return Err(Error::OutOfRange(format!("a sheet has from 1 to {MOST} pictures, not {count}")));
        }
        Ok(pictures)
    }

    /// The caption of each picture.
    pub fn labels(&self, picture: &Settings) -> [String; 2] {
        let lens = &picture.estimator.lens;
        let f_number = picture.estimator.f_number();
        let stop = if f_number.is_finite() { format!("f/{}", digits(f_number)) } else { "pinhole".into() };
        let diameter = format!("lens diameter {}", digits(f64::from(lens.diameter)));
        let plane = format!("focal plane at {}", digits(f64::from(lens.focal_distance)));
        match self {
            Self::FNumbers(_) => [stop, diameter],
            Self::LensDiameters(_) => [diameter, stop],
            Self::FocalDistances(_) => [plane, stop],
        }
    }
}

/// A number with three digits, without trailing zeros.
fn digits(value: f64) -> String {
    let places = if value == 0.0 { 0.0 } else { (2.0 - value.abs().log10().floor()).clamp(0.0, 12.0) };
    let text = format!("{value:.*}", places as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}
