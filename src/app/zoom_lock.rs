//! What stays when the user zooms: the f-number or the diameter of the lens.

use crate::scene::{Camera, Lens, Preset};
use crate::settings::{Estimator, Part};

/// What stays when the field of view or the sensor changes. It is what the user set last: the f-number, by its slider, by
/// a stop or by a known lens of photographers; or the diameter, by its slider or by an eye. At the start it is the
/// f-number if the lens is such a known lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ZoomLock {
    pub(super) keeps_f_number: bool,
}

impl ZoomLock {
    pub(super) fn new(estimator: &Estimator) -> Self {
        Self { keeps_f_number: preset(estimator).is_some_and(Preset::has_f_number) }
    }

    /// Follows what the user changed in a part of the panel.
    pub(super) fn follow(&mut self, part: Part, (camera, lens): (Camera, Lens), now: &mut Estimator) {
        let f_number = camera.f_number(lens.diameter);
        if now.lens.diameter.to_bits() != lens.diameter.to_bits() {
            let known = preset(now).is_none_or(Preset::has_f_number);
            self.keeps_f_number = part == Part::Lens && known;
        } else if self.keeps_f_number && f_number.is_finite() {
            let zoomed = now.camera.film_distance() != camera.film_distance();
            // The length of a scene unit changes the distance of the film too, but that is no zooming.
            if zoomed && now.camera.metres_per_unit == camera.metres_per_unit {
                now.set_f_number(f_number);
            }
        }
    }
}

fn preset(estimator: &Estimator) -> Option<&'static Preset> {
    Preset::on(&estimator.camera, estimator.model, &estimator.lens)
}
