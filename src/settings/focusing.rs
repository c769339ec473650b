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
        let set = match focusing {
            Focusing::On(place) => {
                settings.estimator.lens.focal_distance = depth_at(place)? as f32;
                return Ok(settings);
            }
            Focusing::Blur { sharp, blurred, pixels } => {
                settings.blur_by_lens(depth_at(sharp)?, depth_at(blurred)?, pixels)
            }
            Focusing::Range { from, to } => settings.sharpen_by_lens(depth_at(from)?, depth_at(to)?),
        };
        set.map_err(Error::NoLens)?;
        Ok(settings)
    }

    /// Chooses the lens that is focused at the depth `sharp` and blurs the depth `blurred` over so many pixels.
    ///
    /// # Errors
    /// The reason why no lens does this. Then nothing changes.
    pub fn blur_by_lens(&mut self, sharp: f64, blurred: f64, pixels: f32) -> Result<(), String> {
        let Estimator { camera, size: [_, height], .. } = &self.estimator;
        let lens = camera.lens_for_blur(sharp, blurred, pixels.into(), *height)?;
        self.use_lens(lens);
        Ok(())
    }

    /// Chooses the lens with which everything between two depths is blurred over no more than the tolerance.
    ///
    /// # Errors
    /// The reason why no lens does this. Then nothing changes.
    pub fn sharpen_by_lens(&mut self, from: f64, to: f64) -> Result<(), String> {
        let Estimator { camera, size: [_, height], .. } = &self.estimator;
        let lens = camera.lens_for_range(from, to, self.tolerance_pixels(), *height)?;
        self.use_lens(lens);
        Ok(())
    }

    /// Gives the lens this diameter and focus. Its glass stays.
    fn use_lens(&mut self, lens: Lens) {
        let estimator = &mut self.estimator;
        estimator.lens = Lens { abbe_number: estimator.lens.abbe_number, ..lens };
        estimator.model = CameraModel::ThinLens;
    }
}
