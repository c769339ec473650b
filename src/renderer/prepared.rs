//! The parts that settings need on a device besides the images: pipelines and buffers. They take long to make, and any
//! thread can make them while another one renders.

use super::schedule::{self, LARGEST_BATCH};
use crate::error::{Error, Result};
use crate::gpu_types::{
    Counters, SceneColors, SceneData, aperture_sums, film_constants, integrator_number, lens_constants,
};
use crate::passes::{
    Accumulate, ApertureBuffers, BlueNoiseTile, FacetAlbedo, Geometry, Pick, Resolve, ResolveKind,
    SceneBuffers, Select, Shaders, Trace,
};
use crate::scene::{ApertureImage, Integrator, Overlay, SceneRef, Stage};
use crate::settings::{Estimator, Settings};
use crate::vulkan::{Buffer, Device, Residence};
use std::sync::Arc;

/// Makes [`Prepared`]. Holds the parts that are the same for all settings.
pub struct Preparer {
    pub(super) device: Arc<Device>,
    shaders: Shaders,
    tile: BlueNoiseTile,
    albedo: FacetAlbedo,
    pub(super) counters: Arc<Buffer>,
    pub(super) resolve_without_holes: Arc<Resolve>,
    pub(super) resolve_with_holes: Arc<Resolve>,
}

/// The parts that were made for some settings. Clones share them.
#[derive(Clone)]
pub struct Prepared {
    keys: Keys,
    pub(super) scene: Arc<SceneBuffers>,
    pub(super) aperture: Arc<ApertureBuffers>,
    pub(super) trace: Arc<Trace>,
    pub(super) accumulate: Arc<Accumulate>,
    /// Only for adaptive pictures.
    pub(super) select: Option<Arc<Select>>,
    /// Only for overlays.
    pub(super) resolve_overlay: Option<Arc<Resolve>>,
    /// Only for overlays that show surfaces.
    pub(super) geometry: Option<Arc<Geometry>>,
    /// Only if questions are asked.
    pub(super) pick: Option<Arc<Pick>>,
}

/// The values that the parts depend on. A part is made anew exactly when its key changes.
#[derive(Clone, PartialEq)]
pub struct Keys {
    scene: SceneKey,
    /// The image of the aperture, if it has one.
    aperture: Option<ApertureImage>,
    /// The constants of the passes that trace rays, besides those of the scene.
    lens: [(u32, u32); 6],
    /// The constants of the passes that work on the film alone.
    film: [(u32, u32); 2],
    /// The number of the integrator.
    integrator: u32,
    is_adaptive: bool,
    overlay: Option<ResolveKind>,
    shows_surface: bool,
    answers: bool,
}

#[derive(Clone, PartialEq)]
struct SceneKey {
    scene: SceneRef,
    /// How its model is to be shown. The scene may not be so yet, and then nothing that was prepared fits.
    stage: Stage,
    /// How long the shutter is open, if anything moves: the boxes of the tree enclose all that a shape passes
    /// meanwhile.
    shutter: Option<f32>,
}

impl SceneKey {
    /// Whether the shapes of both are the same, whatever their colours and lights.
    fn has_shapes_of(&self, other: &Self) -> bool {
        self.shutter == other.shutter && self.scene.shares_shapes(&other.scene)
    }
}

impl Keys {
    /// The keys of these settings. `answers` says whether questions will be asked.
    pub fn new(settings: &Settings, answers: bool) -> Self {
        let Settings { estimator, view, .. } = settings;
        let scene = estimator.scene.clone();
        let has_moments = estimator.has_moments();
        Self {
            scene: SceneKey {
                shutter: scene.moves().then_some(estimator.shutter),
                stage: estimator.stage,
                scene,
            },
            aperture: estimator.aperture.image.clone(),
            lens: lens_constants(estimator),
            film: film_constants(estimator),
            integrator: integrator_number(estimator.integrator),
            is_adaptive: estimator.is_adaptive(),
            overlay: view.overlay.map(|_| ResolveKind::Overlay { has_moments }),
            shows_surface: view.overlay.is_some_and(Overlay::shows_surface),
            answers,
        }
    }
}

impl Preparer {
    pub(super) fn new(device: &Arc<Device>, shaders: Shaders) -> Result<Self> {
        let size = size_of::<Counters>() as u64;
        let resolve = |kind| Resolve::new(device, shaders.resolve, kind).map(Arc::new);
        Ok(Self {
            shaders,
            tile: BlueNoiseTile::new(device)?,
            albedo: FacetAlbedo::new(device)?,
            counters: Arc::new(Buffer::new(device, "counters", size, Residence::Device)?),
            resolve_without_holes: resolve(ResolveKind::WithoutHoles)?,
            resolve_with_holes: resolve(ResolveKind::WithHoles)?,
            device: Arc::clone(device),
        })
    }

    /// Makes the parts that these settings need, and shares those that `old` has already. `answers` says whether
    /// questions will be asked.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the device cannot trace the scene, [`Error::Limit`], or those of
    /// [`crate::vulkan`].
    pub fn prepare(&self, settings: &Settings, answers: bool, old: Option<&Prepared>) -> Result<Prepared> {
        let keys = Keys::new(settings, answers);
        let (device, shaders, tile) = (&self.device, &self.shaders, &self.tile);

        let same = old.filter(|old| old.keys.scene == keys.scene);
        let recolored = old.filter(|old| old.keys.scene.has_shapes_of(&keys.scene));
        let scene = share_or(same.map(|old| &old.scene), || match recolored {
            Some(Prepared { scene: old, .. }) => {
                old.recolored(device, &SceneColors::new(&keys.scene.scene, old.reach()))
            }
            None => SceneBuffers::new(device, &SceneData::new(&keys.scene.scene, settings.estimator.shutter)),
        })?;
        // A scene that is too large must be refused first: a driver might fail to compile the passes for it.
        self.largest_batch(&scene, &settings.estimator)?;

        let same = old.filter(|old| old.keys.aperture == keys.aperture);
        let aperture = share_or(same.map(|old| &old.aperture), || {
            ApertureBuffers::new(device, &keys.aperture.as_ref().map(aperture_sums).unwrap_or_default())
        })?;

        // A driver compiles a pipeline on the thread that asks for it. The passes that trace rays take longest.
        let same_scene = old.filter(|old| old.scene.constants() == scene.constants());
        let same_lens = same_scene.filter(|old| old.keys.lens == keys.lens);
        let same_trace = same_lens.filter(|old| old.keys.integrator == keys.integrator);
        let same_film = old.filter(|old| old.keys.film == keys.film);
        let same_overlay = old.filter(|old| old.keys.overlay == keys.overlay);
        let (trace, pick, geometry, accumulate, select, resolve_overlay) = std::thread::scope(|scope| {
            let trace = scope.spawn(|| {
                share_or(same_trace.map(|old| &old.trace), || {
                    let shader = shaders.trace[keys.integrator as usize];
                    Trace::new(device, shader, &keys.lens, &scene, tile, &self.albedo)
                })
            });
            let pick = scope.spawn(|| {
                share_or_if(keys.answers, same_lens.and_then(|old| old.pick.as_ref()), || {
                    Pick::new(device, shaders.pick, &keys.lens, &scene, tile)
                })
            });
            let geometry =
                share_or_if(keys.shows_surface, same_scene.and_then(|old| old.geometry.as_ref()), || {
                    Geometry::new(device, shaders.geometry, &scene)
                });
            let accumulate = share_or(same_film.map(|old| &old.accumulate), || {
                Accumulate::new(device, shaders.accumulate, &keys.film, tile)
            });
            let select = share_or_if(keys.is_adaptive, same_film.and_then(|old| old.select.as_ref()), || {
                Select::new(device, shaders.select, &keys.film)
            });
            let resolve_overlay = keys.overlay.map(|kind| {
                share_or(same_overlay.and_then(|old| old.resolve_overlay.as_ref()), || {
                    Resolve::new(device, shaders.resolve, kind)
                })
            });
            (joined(trace), joined(pick), geometry, accumulate, select, resolve_overlay.transpose())
        });
        let (trace, pick, geometry) = (trace?, pick?, geometry?);
        let (accumulate, select, resolve_overlay) = (accumulate?, select?, resolve_overlay?);
        Ok(Prepared { keys, scene, aperture, trace, accumulate, select, resolve_overlay, geometry, pick })
    }

    /// The largest batch whose loops stay within the limit of the device in one invocation of the trace pass.
    pub(super) fn largest_batch(&self, scene: &SceneBuffers, estimator: &Estimator) -> Result<u32> {
        // With colour errors, a sample has three rays.
        let rays = if estimator.dispersion() == 0.0 { 1 } else { 3 };
        let bounces = most_bounces(scene, estimator);
        let steps = rays * scene.max_loop_steps(samples_lights(estimator), bounces);
        let Some(most) = self.device.traits().max_loop_steps else {
            return Ok(LARGEST_BATCH);
        };
        schedule::largest_batch(steps, most).ok_or_else(|| {
            Error::OutOfRange(format!(
                "the scene can take {steps} steps a sample, but software devices stop at {most}: {}; use fewer of \
                 these, or a GPU",
                scene.explain_max_loop_steps(bounces)
            ))
        })
    }
}

impl Prepared {
    /// Whether these parts are what the settings need.
    pub fn fits(&self, settings: &Settings, answers: bool) -> bool {
        self.keys == Keys::new(settings, answers)
    }

    /// Whether what the settings need beyond these parts is made at once: only colours and lights differ.
    pub fn nearly_fits(&self, settings: &Settings, answers: bool) -> bool {
        let keys = Keys::new(settings, answers);
        let scene = self.keys.scene.clone();
        let stands = keys.scene.scene.stage().is_none_or(|stage| *stage == keys.scene.stage);
        stands
            && scene.has_shapes_of(&keys.scene)
            && self.scene.shares_pipelines_with(&SceneColors::new(&keys.scene.scene, self.scene.reach()))
            && self.keys == Keys { scene, ..keys }
    }

    /// Whether all parts are the same as those of the other.
    pub(super) fn is(&self, other: &Self) -> bool {
        self.keys == other.keys
            && Arc::ptr_eq(&self.scene, &other.scene)
            && Arc::ptr_eq(&self.aperture, &other.aperture)
    }

    /// Whether questions can be asked.
    pub fn answers(&self) -> bool {
        self.keys.answers
    }
}

/// Whether the integrator samples lamps and the sky, and not each light of a list.
pub(super) fn samples_lights(estimator: &Estimator) -> bool {
    estimator.integrator == Integrator::Path
}

/// How often a ray can bounce in this scene.
pub(super) fn most_bounces(scene: &SceneBuffers, estimator: &Estimator) -> u32 {
    let bounces = samples_lights(estimator) || scene.reflects();
    if bounces { estimator.max_bounces } else { 0 }
}

/// What the thread returns. A panic goes on in this one.
fn joined<T>(thread: std::thread::ScopedJoinHandle<'_, T>) -> T {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

/// Shares the part if there is one, or else makes it.
fn share_or<T>(there: Option<&Arc<T>>, make: impl FnOnce() -> Result<T>) -> Result<Arc<T>> {
    match there {
        Some(there) => Ok(Arc::clone(there)),
        None => make().map(Arc::new),
    }
}

/// Shares or makes a part as [`share_or`] does, but only if it is needed.
fn share_or_if<T>(
    needed: bool,
    there: Option<&Arc<T>>,
    make: impl FnOnce() -> Result<T>,
) -> Result<Option<Arc<T>>> {
    needed.then(|| share_or(there, make)).transpose()
}
