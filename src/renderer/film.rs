//! The images of one picture size, and what binds them to the passes.

use super::EstimatorPasses;
use crate::error::Result;
use crate::passes::{Adaptive, Resolve};
use crate::vulkan::{BindingSet, Device, Image, Recording};
use std::sync::Arc;

/// The images between the passes.
pub(super) struct Film {
    /// The tracing image: the mean of the last batch and its number of samples.
    pub(super) batch: Arc<Image>,
    /// The accumulation image: the running mean and count.
    pub(super) film: Arc<Image>,
    /// The resolved picture.
    pub(super) picture: Arc<Image>,
    /// How deep each pixel sees, once an overlay wants to know; of one pixel until then.
    pub(super) depth: Arc<Image>,
    pub(super) adaptive: Adaptive,
    /// By the list that is read.
    pub(super) accumulate: [BindingSet; 2],
    /// Likewise, of an adaptive picture. The other list is written.
    pub(super) select: Option<[BindingSet; 2]>,
    pub(super) resolve: BindingSet,
    /// Resolves the tracing image instead of the film.
    pub(super) resolve_preview: BindingSet,
    initialized: bool,
    /// Of the depth.
    has_layout: bool,
}

impl Film {
    pub(super) fn new(
        device: &Arc<Device>,
        size: [u32; 2],
        passes: &EstimatorPasses,
        resolve: &Resolve,
    ) -> Result<Self> {
        let batch = Arc::new(Image::rgba32f(device, "tracing image", size)?);
        let film = Arc::new(Image::rgba32f(device, "accumulation image", size)?);
        let picture = Arc::new(Image::rgba8(device, "picture", size)?);
        let depth = Arc::new(Image::r32f(device, "depth", [1, 1])?);
        let adaptive = Adaptive::new(device, passes.has_moments.then_some(size))?;
        let merge = |list| passes.accumulate.bind(&batch, &film, &adaptive, list);
        let select = passes.select.as_ref().map(|select| {
            let choose = |list| select.bind(&batch, &film, &adaptive, list);
            Ok([choose(0)?, choose(1)?])
        });
        Ok(Self {
            accumulate: [merge(0)?, merge(1)?],
            select: select.transpose()?,
            resolve: resolve.bind(&film, &picture, &depth, &adaptive)?,
            resolve_preview: resolve.bind(&batch, &picture, &depth, &adaptive)?,
            batch,
            film,
            picture,
            depth,
            adaptive,
            initialized: false,
            has_layout: false,
        })
    }

    /// Makes room for the depth of every pixel, if there is none yet.
    pub(super) fn fit_depth(&mut self, device: &Arc<Device>, resolve: &Resolve) -> Result<()> {
        let size = self.film.extent();
        if self.depth.extent() == size {
            return Ok(());
        }
        device.wait_idle()?;
        self.depth = Arc::new(Image::r32f(device, "depth", size)?);
        self.resolve = resolve.bind(&self.film, &self.picture, &self.depth, &self.adaptive)?;
        self.resolve_preview = resolve.bind(&self.batch, &self.picture, &self.depth, &self.adaptive)?;
        self.has_layout = false;
        Ok(())
    }

    /// Gives the depth image its layout, if it has none yet.
    pub(super) fn record_depth_layout(&mut self, recording: &mut Recording<'_>) {
        if !self.has_layout {
            recording.clear(&self.depth);
            self.has_layout = true;
        }
    }

    /// Empties the tracing image, so that nothing of the last picture is shown, unless it is only looked
    /// at where it has been written since. The film itself is taken for empty by the first accumulation.
    pub(super) fn record_clear(&mut self, recording: &mut Recording<'_>, batch: bool) {
        if !self.initialized {
            recording.clear(&self.film);
            recording.clear(&self.picture);
            self.adaptive.moments().iter().for_each(|moments| recording.clear(moments));
        }
        if batch || !self.initialized {
            recording.clear(&self.batch);
        }
        self.initialized = true;
    }
}
