//! The same colour everywhere.

use crate::scene::Constant;
use glam::DVec3;

pub(super) fn value(of: &Constant) -> DVec3 {
    of.color.as_dvec3()
}
