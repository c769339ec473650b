//! Everything that is on the device for a picture.

use super::film::{FilmImages, SurfaceImage};
use super::pick::Asked;
use super::prepared::{Prepared, Preparer};
use crate::error::Result;
use crate::passes::{Accumulate, Geometry, Pick, PickBindings, Resolve, Select, Trace};
use crate::settings::Settings;
use crate::vulkan::{BindingSet, FRAMES_IN_FLIGHT};
use std::sync::Arc;

/// The parts that were prepared for the settings, the images, and the passes with their bindings.
pub(super) struct Loaded {
    pub(super) prepared: Prepared,
    pub(super) images: FilmImages,
    pub(super) surfaces: SurfaceImage,
    pub(super) passes: Passes,
}

/// The passes, each with the resources that are bound to it.
pub(super) struct Passes {
    pub(super) trace: Bound<Trace>,
    pub(super) accumulate: Bound<Accumulate>,
    /// Only for adaptive pictures.
    pub(super) select: Option<Bound<Select>>,
    pub(super) resolve: BoundResolve,
    /// Only for overlays that show surfaces.
    pub(super) geometry: Option<(Arc<Geometry>, BindingSet)>,
    /// Only if questions are asked.
    pub(super) pick: Option<BoundPick>,
}

/// A pass over the pixels of the film, with one set of bindings for each of the two lists of active pixels.
pub(super) struct Bound<P> {
    pub(super) pass: Arc<P>,
    pub(super) by_list: [BindingSet; 2],
}

pub(super) struct BoundResolve {
    pub(super) without_holes: Arc<Resolve>,
    pub(super) with_holes: Arc<Resolve>,
    pub(super) overlay: Option<Arc<Resolve>>,
    pub(super) film: BindingSet,
    /// Bindings that resolve the tracing image instead of the film.
    pub(super) preview: BindingSet,
}

/// The pass that answers questions. Each frame in flight has its own buffer for the answer.
pub(super) struct BoundPick {
    pub(super) pass: Arc<Pick>,
    pub(super) frames: [(PickBindings, Option<Asked>); FRAMES_IN_FLIGHT],
}

impl Loaded {
    pub(super) fn new(preparer: &Preparer, settings: &Settings, prepared: Prepared) -> Result<Self> {
        let images = FilmImages::new(&preparer.device, &settings.estimator)?;
        let surfaces = SurfaceImage::new(&preparer.device, settings)?;
        let passes = Passes::new(preparer, &prepared, &images, &surfaces)?;
        Ok(Self { prepared, images, surfaces, passes })
    }

    /// Uses these prepared parts from now on, and keeps the images if they fit the settings. After an error, everything
    /// is as before.
    pub(super) fn replace(
        &mut self,
        preparer: &Preparer,
        settings: &Settings,
        prepared: Prepared,
    ) -> Result<()> {
        let device = &preparer.device;
        let fits = self.images.fit(&settings.estimator);
        let images = (!fits).then(|| FilmImages::new(device, &settings.estimator)).transpose()?;
        let surfaces =
            (!self.surfaces.fits(settings)).then(|| SurfaceImage::new(device, settings)).transpose()?;
        let passes = Passes::new(
            preparer,
            &prepared,
            images.as_ref().unwrap_or(&self.images),
            surfaces.as_ref().unwrap_or(&self.surfaces),
        )?;
        // Frames in flight use the old parts, so these can be dropped only once the device is idle.
        device.wait_idle()?;
        (self.passes, self.prepared) = (passes, prepared);
        images.into_iter().for_each(|images| self.images = images);
        surfaces.into_iter().for_each(|surfaces| self.surfaces = surfaces);
        Ok(())
    }

    /// Whether these settings and prepared parts need nothing replaced.
    pub(super) fn fits(&self, settings: &Settings, prepared: &Prepared) -> bool {
        self.prepared.is(prepared) && self.images.fit(&settings.estimator) && self.surfaces.fits(settings)
    }
}

impl Passes {
    /// Makes all bindings anew, which is fast. So no binding can refer to a resource that was replaced.
    fn new(preparer: &Preparer, of: &Prepared, images: &FilmImages, surfaces: &SurfaceImage) -> Result<Self> {
        let FilmImages { traced, film, picture, adaptive, .. } = images;
        let surfaces = &surfaces.image;
        let resolve = &preparer.resolve_with_holes;
        Ok(Self {
            trace: bound(&of.trace, |list| {
                of.trace.bind(&of.scene, &of.aperture, traced, &preparer.counters, adaptive, list)
            })?,
            accumulate: bound(&of.accumulate, |list| of.accumulate.bind(traced, film, adaptive, list))?,
            select: (of.select.as_ref())
                .map(|select| bound(select, |list| select.bind(traced, film, adaptive, list)))
                .transpose()?,
            resolve: BoundResolve {
                film: resolve.bind(film, picture, surfaces, adaptive)?,
                preview: resolve.bind(traced, picture, surfaces, adaptive)?,
                without_holes: Arc::clone(&preparer.resolve_without_holes),
                with_holes: Arc::clone(resolve),
                overlay: of.resolve_overlay.clone(),
            },
            geometry: (of.geometry.as_ref())
                .map(|geometry| Ok((Arc::clone(geometry), geometry.bind(&of.scene, surfaces)?)))
                .transpose()?,
            pick: (of.pick.as_ref())
                .map(|pick| {
                    let frame = || Ok((pick.bind(&of.scene, &of.aperture)?, None));
                    Ok(BoundPick { pass: Arc::clone(pick), frames: [frame()?, frame()?] })
                })
                .transpose()?,
        })
    }
}

fn bound<P>(pass: &Arc<P>, bind: impl Fn(usize) -> Result<BindingSet>) -> Result<Bound<P>> {
    Ok(Bound { pass: Arc::clone(pass), by_list: [bind(0)?, bind(1)?] })
}
