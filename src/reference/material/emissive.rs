//! Emits light.

use super::Kind;
use crate::scene::Emissive;
use glam::DVec3;

impl Kind for Emissive {
    fn emission(&self) -> DVec3 {
        self.radiance.as_dvec3()
    }
}
