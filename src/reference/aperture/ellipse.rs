//! An ellipse: a disc, before it is stretched.

pub(super) use super::disc::point;
