//! A series of pictures with different lenses or focal distances.

use super::{Changes, Settings, Value, rounded};
use crate::error::{Error, Result};
use crate::scene::CameraModel;

/// The largest number of pictures on a sheet.
const MOST: usize = 64;

/// The value that changes from picture to picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Sweep {
    /// The lens, by its f-number.
    FNumbers(Vec<Value>),
    /// The lens, by its diameter.
    LensDiameters(Vec<Value>),
    /// The distance of the focal plane.
    FocalDistances(Vec<Value>),
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
        let (flag, values) = match self {
            Self::FNumbers(values) => ("f-number", values),
            Self::LensDiameters(values) => ("lens-diameter", values),
            Self::FocalDistances(values) => ("focal-distance", values),
        };
        let picture = |value: &Value| {
            let mut settings = settings.clone();
            Changes::of(flag, value.clone()).apply(&mut settings)?;
            Ok(settings)
        };
        let pictures = values.iter().map(picture).collect::<Result<Vec<Settings>>>()?;
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
        let stop =
            if f_number.is_finite() { format!("f/{}", rounded(f_number, 3)) } else { "pinhole".into() };
        let diameter = format!("lens diameter {}", rounded(f64::from(lens.diameter), 3));
        let plane = format!("focal plane at {}", rounded(f64::from(lens.focal_distance), 3));
        match self {
            Self::FNumbers(_) => [stop, diameter],
            Self::LensDiameters(_) => [diameter, stop],
            Self::FocalDistances(_) => [plane, stop],
        }
    }
}
