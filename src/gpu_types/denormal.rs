//! Replaces denormal numbers, with which some processors are a hundred times slower, by zero.

use glam::Vec3;

/// The number, or zero if it is denormal.
pub(super) fn flush_denormal(value: f32) -> f32 {
    if value.is_subnormal() { 0.0 } else { value }
}

/// The components of a vector, with zeros in place of denormal numbers.
pub(super) fn flush_denormals(vector: Vec3) -> [f32; 3] {
    vector.to_array().map(flush_denormal)
}
