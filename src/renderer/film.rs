//! The images of one picture size.

use crate::error::Result;
use crate::passes::Adaptive;
use crate::scene::{self, CameraModel, SceneRef};
use crate::settings::{Estimator, Settings};
use crate::vulkan::{Device, Image, Recording};
use std::sync::Arc;

/// The images between the passes.
pub(super) struct FilmImages {
    key: FilmKey,
    /// The tracing image: the mean of the last batch and its number of samples.
    pub(super) traced: Arc<Image>,
    /// The accumulation image: the running mean and count.
    pub(super) film: Arc<Image>,
    /// The resolved picture.
    pub(super) picture: Arc<Image>,
    pub(super) adaptive: Arc<Adaptive>,
    /// Whether the images have been cleared since they were made, which gives them their layout.
    have_layout: bool,
}

/// What the images are made for.
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
            adaptive: Arc::new(Adaptive::new(device, has_moments.then_some(size))?),
            have_layout: false,
        })
    }

    pub(super) fn fit(&self, estimator: &Estimator) -> bool {
        self.key == FilmKey::new(estimator)
    }

    /// Empties the tracing image, so that nothing of the last picture is shown, unless it is only looked
    /// at where it has been written since. The film itself is taken for empty by the first accumulation.
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

/// What each pixel's middle sees, for the overlays that want to know; of one pixel where none does.
pub(super) struct SurfaceImage {
    pub(super) image: Arc<Image>,
    /// What it is of.
    shows: Option<Seen>,
    has_layout: bool,
}

/// What a surface image depends on, besides the size: the lens is not among it.
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
            camera: estimator.camera,
            upside_down: estimator.model == CameraModel::Hole && !estimator.hole.upright,
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

    /// Gives the image its layout, if it has none yet.
    pub(super) fn record_layout(&mut self, recording: &mut Recording<'_>) {
        if !self.has_layout {
            recording.clear(&self.image);
            self.has_layout = true;
        }
    }

    /// Whether this view has still to be traced. From now on it counts as traced.
    pub(super) fn goes_to(&mut self, seen: Seen) -> bool {
        self.shows.replace(seen.clone()) != Some(seen)
    }
}
