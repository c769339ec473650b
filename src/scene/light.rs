//! Lights and background. Radiance is linear r, g, b.

use glam::{DVec3, Vec3};

/// A light without extent: Suffern, chapter 14. It does not weaken with distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// The place of a point light, or the direction of a directional one.
    pub kind: LightKind,
    /// The radiance that arrives at every point, however far away.
    pub radiance: Vec3,
    /// Whether shapes cast shadows in its light.
    pub shadows: bool,
}

/// Where light comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// Light from a point.
    Point(DVec3),
    /// Light along parallel lines. The vector points to the light and has any length but zero.
    Directional(Vec3),
}

/// Radiance where nothing is hit: `horizon` up to the horizontal, `zenith` straight up, and in
/// between mixed by `y (2 - y)` of the unit direction's height `y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Background {
    /// The radiance at and below the horizon.
    pub horizon: Vec3,
    /// The radiance straight up.
    pub zenith: Vec3,
}
