//! How a picture is shown.

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

/// What can be shown instead of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Overlay {
    /// Each pixel's number of samples, from black for none to white for as many as wanted.
    Count,
    /// The standard error of each pixel's mean luminance, as a share of it.
    Error,
    /// The distance along the axis: white at the lens, grey in the focal plane, black far away.
    Depth,
    /// The circle of confusion: blue in front of the focal plane, orange behind it, white where it is sharp.
    Blur,
    /// The picture, with all marked whose circle of confusion is below [`View::tolerance`].
    FocusPeaking,
    /// The picture, with the slice marked that the focal plane cuts out of the scene.
    FocalPlane,
}

impl Overlay {
    /// Every overlay, by its name.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("focus-peaking", Self::FocusPeaking),
        ("focal-plane", Self::FocalPlane),
        ("circle-of-confusion", Self::Blur),
        ("depth", Self::Depth),
        ("count", Self::Count),
        ("error", Self::Error),
    ];

    /// Whether it needs the depth of each pixel.
    pub fn shows_depth(self) -> bool {
        !matches!(self, Self::Count | Self::Error)
    }
}

impl Default for View {
    fn default() -> Self {
        Self { exposure_stops: 0.0, iso: DEFAULT_ISO, exposure_lock: true, overlay: None, tolerance: 1.0 }
    }
}
