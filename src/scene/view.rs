//! How a picture is shown.

use super::Overlay;

/// The film's speed, unless the scene says otherwise.
const DEFAULT_ISO: f32 = 100.0;

/// Whatever changes only how the film is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Brightness, in stops: the picture is multiplied by two to this power.
    pub exposure_stops: f32,
    /// The film's speed: twice as fast is twice as bright.
    pub iso: f32,
    /// Whether the brightness stays when the aperture changes.
    pub exposure_lock: bool,
    /// What is shown instead of the picture, or on it, if anything.
    pub overlay: Option<Overlay>,
    /// How wide a circle of confusion may be that counts as sharp, in pixels.
    pub tolerance: f32,
}

impl Default for View {
    fn default() -> Self {
        Self { exposure_stops: 0.0, iso: DEFAULT_ISO, exposure_lock: true, overlay: None, tolerance: 1.0 }
    }
}
