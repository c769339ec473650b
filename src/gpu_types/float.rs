//! Numbers as devices want them: without denormal ones, which are a hundred times slower on some processors.

use glam::Vec3;

/// Zero where the number is denormal.
pub(super) fn float(value: f32) -> f32 {
    if value.is_subnormal() { 0.0 } else { value }
}

/// A vector with zeros in place of denormal numbers.
pub(super) fn floats(vector: Vec3) -> [f32; 3] {
    vector.to_array().map(float)
}
