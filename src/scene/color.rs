//! Linear colours with the primaries of Rec. 709.

use glam::DVec3;

/// The luminance of a colour.
pub fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// The linear value of a channel from 0 to 1 that is encoded as sRGB: IEC 61966-2-1.
pub(crate) fn linear_of_srgb(level: f64) -> f64 {
    if level <= 0.04045 { level / 12.92 } else { ((level + 0.055) / 1.055).powf(2.4) }
}
