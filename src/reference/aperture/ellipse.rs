//! An ellipse. Before it is stretched, it is a disc.

pub(super) use super::disc::point;
