//! The images that a picture is made in.

use crate::error::Result;
use crate::passes::AdaptiveBuffers;
use crate::scene::{self, SceneRef};
use crate::settings::{Estimator, Settings};
use crate::vulkan::{Device, Image, Recording};
use std::sync::Arc;

/// The images that the passes write and read, all in the size of the picture.
pub(super) struct FilmImages {
    key: FilmKey,
    /// The tracing image: for each pixel the mean of the last batch and its number of samples.
    pub(super) traced: Arc<Image>,
    /// The accumulation image: for each pixel the mean of all batches and the number of samples.
    pub(super) film: Arc<Image>,
    /// The resolved picture.
    pub(super) picture: Arc<Image>,
    pub(super) adaptive: Arc<AdaptiveBuffers>,
    /// Whether the images have been cleared since they were made. Clearing gives them their layout.
    have_layout: bool,
}

/// The properties of a picture that the images depend on.
#[derive(Clone, Copy, PartialEq)]
struct FilmKey {
    size: [u32; 2],
    has_moments: bool,
}

impl FilmKey {
    fn new(estimator: &Estimator) -> Self {
        Self { size: estimator.size, has_moments: estimator.has_moments() }
    }
}

impl FilmImages {
    pub(super) fn new(device: &Arc<Device>, estimator: &Estimator) -> Result<Self> {
        let key @ FilmKey { size, has_moments } = FilmKey::new(estimator);
        Ok(Self {
            key,
            traced: Arc::new(Image::rgba32f(device, "tracing image", size)?),
            film: Arc::new(Image::rgba32f(device, "accumulation image", size)?),
            picture: Arc::new(Image::rgba8(device, "picture", size)?),
            adaptive: Arc::new(AdaptiveBuffers::new(device, has_moments.then_some(size))?),
            have_layout: false,
        })
    }

    pub(super) fn fit(&self, estimator: &Estimator) -> bool {
        self.key == FilmKey::new(estimator)
    }

    /// Clears the tracing image if `traced` says so, so that nothing of the last picture is shown. That is not needed
    /// if it is read only where it has been written since. The film need not be cleared: the first accumulation
    /// overwrites it.
    pub(super) fn record_clear(&mut self, recording: &mut Recording<'_>, traced: bool) {
        if !self.have_layout {
            recording.clear(&self.film);
            recording.clear(&self.picture);
            self.adaptive.moments().iter().for_each(|moments| recording.clear(moments));
        }
        if traced || !self.have_layout {
            recording.clear(&self.traced);
        }
        self.have_layout = true;
    }
}

/// The surface that the middle of each pixel sees, for the overlays that show it. One pixel in size if no overlay does.
pub(super) struct SurfaceImage {
    pub(super) image: Arc<Image>,
    /// The view that the image was traced for, if it was.
    shows: Option<Seen>,
    has_layout: bool,
}

/// What a surface image depends on besides its size. It depends on the lens only by the field of
/// view.
#[derive(Clone, PartialEq)]
pub(super) struct Seen {
    scene: SceneRef,
    camera: scene::Camera,
    upside_down: bool,
}

impl Seen {
    pub(super) fn new(estimator: &Estimator) -> Self {
        Self {
            scene: estimator.scene.clone(),
            camera: estimator.focused_camera(),
            upside_down: estimator.is_upside_down(),
        }
    }
}

impl SurfaceImage {
    pub(super) fn new(device: &Arc<Device>, settings: &Settings) -> Result<Self> {
        let image = Arc::new(Image::rgba32f(device, "surfaces", Self::extent(settings))?);
        Ok(Self { image, shows: None, has_layout: false })
    }

    pub(super) fn fits(&self, settings: &Settings) -> bool {
        self.image.extent() == Self::extent(settings)
    }

    fn extent(settings: &Settings) -> [u32; 2] {
        let shows_surface = settings.view.overlay.is_some_and(scene::Overlay::shows_surface);
        if shows_surface { settings.estimator.size } else { [1, 1] }
    }

    /// Clears the image once, which gives it its layout.
    pub(super) fn record_layout(&mut self, recording: &mut Recording<'_>) {
        if !self.has_layout {
            recording.clear(&self.image);
            self.has_layout = true;
        }
    }

    /// Whether this view has to be traced. It counts as traced from then on.
    pub(super) fn goes_to(&mut self, seen: Seen) -> bool {
        self.shows.replace(seen.clone()) != Some(seen)
    }
}
