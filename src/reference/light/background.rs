//! The sky, from the horizon to the zenith.

use crate::scene::Gradient;
use glam::DVec3;

pub(super) fn radiance(sky: &Gradient, direction: DVec3) -> DVec3 {
    let height = direction.y.clamp(0.0, 1.0);
    sky.horizon.as_dvec3().lerp(sky.zenith.as_dvec3(), height * (2.0 - height))
}
