//! Materials: Suffern, chapters 14, 15 and 24.

use glam::Vec3;

/// Coefficients of one reflection model that the kinds of material fill in part. All are linear.
///
/// Radiance = `emission + ka color ambient + sum over lights of
/// (kd color / pi + ks (r . view)^exponent) radiance cos + reflectance * mirror image`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Material {
    /// Diffuse colour.
    pub color: Vec3,
    /// A second colour to alternate with.
    pub checker: Option<Checker>,
    /// Ambient reflection.
    pub ka: f32,
    /// Diffuse reflection.
    pub kd: f32,
    /// Specular highlight.
    pub ks: f32,
    /// Phong exponent of the highlight.
    pub exponent: f32,
    /// Colour of the mirror image, times how much of it.
    pub reflectance: Vec3,
    /// Radiance given off.
    pub emission: Vec3,
}

/// A 3D checker: [`Material::color`] where `floor(x / size) + floor(y / size) + floor(z / size)` is even, this
/// colour where it is odd. A surface on the boundary of two layers of cells belongs to the lower one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checker {
    /// Edge of a cell, in scene units.
    pub size: f64,
    /// The colour of odd cells.
    pub odd_color: Vec3,
}
