//! Lenses that follow from what the picture shows at some places.

use super::{Estimator, Settings};
use crate::error::{Error, Result};
use crate::scene::{CameraModel, Lens};

/// A place of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// The middle of the picture.
    Centre,
    /// A place in pixels from the upper left corner.
    At([f32; 2]),
}

/// A lens that follows from what the picture shows at some places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Focusing {
    /// Focused on what is at this place.
    On(Place),
    /// Focused on what is at the first place, and so wide that what is at the second is blurred over so many pixels.
    Blur {
        /// The place to focus on.
        sharp: Place,
        /// The place to blur.
        blurred: Place,
        /// The diameter of the circle of confusion there, in pixels.
        pixels: f32,
    },
    /// Everything between what is at the two places is blurred over no more than the tolerance.
    Range {
        /// Where the range begins.
        from: Place,
        /// Where the range ends.
        to: Place,
    },
}

impl Settings {
    /// These settings with the lens that was asked for. `depth_at` gives the depth of what the picture shows at a place,
    /// which is infinite for the background.
    ///
    /// # Errors
    /// Those of `depth_at`, and [`Error::NoLens`].
    pub fn focused(
        &self,
        focusing: Focusing,
        mut depth_at: impl FnMut(Place) -> Result<f64>,
    ) -> Result<Self> {
        let mut settings = self.clone();
        let Estimator { camera, lens, model, size: [_, height], .. } = &mut settings.estimator;
        let chosen = match focusing {
            Focusing::On(place) => {
                lens.focal_distance = depth_at(place)? as f32;
                return Ok(settings);
            }
            Focusing::Blur { sharp, blurred, pixels } => {
                camera.lens_for_blur(depth_at(sharp)?, depth_at(blurred)?, pixels.into(), *height)
            }
            Focusing::Range { from, to } => {
                camera.lens_for_range(depth_at(from)?, depth_at(to)?, self.tolerance_pixels(), *height)
            }
        };
        *lens = Lens { abbe_number: lens.abbe_number, ..chosen.map_err(Error::NoLens)? };
        *model = CameraModel::ThinLens;
        Ok(settings)
    }
}
