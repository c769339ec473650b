//! The encoding of colours for displays.

/// The sRGB encoding of a linear value, clipped to [0, 1]: IEC 61966-2-1.
pub fn srgb(linear: f64) -> f64 {
    match linear.clamp(0.0, 1.0) {
        low if low <= 0.003_130_8 => 12.92 * low,
        high => 1.055 * high.powf(1.0 / 2.4) - 0.055,
    }
}
