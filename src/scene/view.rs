//! How a picture is shown.

use super::Overlay;

/// The default speed of the film.
const DEFAULT_ISO: f32 = 100.0;

/// The settings that change only how the film is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The exposure in stops: the picture is multiplied by two to this power.
    pub exposure_stops: f32,
    /// The speed of the film: twice the value is twice as bright.
    pub iso: f32,
    /// Whether the brightness stays the same when the aperture changes.
    pub exposure_lock: bool,
    /// The overlay, if one is shown.
    pub overlay: Option<Overlay>,
    /// The largest circle of confusion that counts as sharp, in pixels.
    pub tolerance: f32,
}

impl Default for View {
    fn default() -> Self {
        Self { exposure_stops: 0.0, iso: DEFAULT_ISO, exposure_lock: true, overlay: None, tolerance: 1.0 }
    }
}
