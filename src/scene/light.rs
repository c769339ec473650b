//! Lights and background. Radiance is linear r, g, b.

use glam::{DVec3, Vec3};

/// A light without extent: Suffern, chapter 14. It does not weaken with distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where it is, or where it comes from.
    pub kind: LightKind,
    /// What it sends to every point.
    pub radiance: Vec3,
    /// Whether what stands between keeps it off.
    pub shadows: bool,
}

/// Where light comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// From a point.
    Point(DVec3),
    /// Along parallel lines. The vector points to the light and has any length but zero.
    Directional(Vec3),
}

/// Radiance where nothing is hit: `horizon` up to the horizontal, `zenith` straight up, and in
/// between mixed by `y (2 - y)` of the unit direction's height `y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Background {
    /// At and below the horizon.
    pub horizon: Vec3,
    /// Straight up.
    pub zenith: Vec3,
}
