//! How deep each pixel sees, for the overlays that want to know.

use super::Renderer;
use crate::error::Result;
use crate::gpu_types::Camera;
use crate::passes::Geometry;
use crate::scene::{self, CameraModel, Overlay, SceneRef};
use crate::settings::{Estimator, Settings};
use crate::vulkan::Recording;

/// What the depths depend on, besides the film's size: the lens is not among it.
#[derive(Clone, PartialEq)]
pub(super) struct Seen {
    scene: SceneRef,
    camera: scene::Camera,
    upside_down: bool,
}

impl Seen {
    fn of(estimator: &Estimator) -> Self {
        Self {
            scene: estimator.scene.clone(),
            camera: estimator.camera,
            upside_down: estimator.model == CameraModel::Hole && !estimator.hole.upright,
        }
    }
}

impl Renderer {
    /// Makes ready what the overlay of these settings needs, if there is one.
    pub(super) fn fit_overlay(&mut self, settings: &Settings) -> Result<()> {
        let Some(overlay) = settings.view.overlay else {
            return Ok(());
        };
        self.resolve.prepare_overlay(&self.device, settings.estimator.has_moments())?;
        if !overlay.shows_surface() {
            return Ok(());
        }
        let (Some(film), Some(loaded)) = (&mut self.film, &mut self.scene) else {
            return Ok(());
        };
        film.fit_depth(&self.device, &self.resolve)?;
        if !loaded.geometry.as_ref().is_some_and(|geometry| geometry.writes(&film.depth)) {
            self.device.wait_idle()?;
            let shader = self.shaders.geometry;
            loaded.geometry = Some(Geometry::new(&self.device, shader, &loaded.buffers, &film.depth)?);
            self.seen = None;
        }
        Ok(())
    }

    /// Finds the depths anew, if an overlay shows some and they are not of this view.
    pub(super) fn record_depth(&mut self, recording: &mut Recording<'_>) {
        let (Some(settings), Some(film), Some(loaded)) = (&self.settings, &mut self.film, &self.scene) else {
            return;
        };
        film.record_depth_layout(recording);
        let seen = Seen::of(&settings.estimator);
        let wanted =
            settings.view.overlay.is_some_and(Overlay::shows_surface) && self.seen.as_ref() != Some(&seen);
        let Some(geometry) = loaded.geometry.as_ref().filter(|_| wanted) else {
            return;
        };
        recording.barrier();
        geometry.record(recording, Camera::new(&settings.estimator));
        recording.barrier();
        self.seen = Some(seen);
    }
}
