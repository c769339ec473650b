//! Questions about a place of the picture: what is seen there, and which rays lead to it.

use super::Renderer;
use crate::error::Result;
use crate::gpu_types::{Camera, PickPush};
use crate::interface::MISS;
use crate::passes::Pick;
use crate::scene;
use crate::vulkan::{Commands, Recording};
use glam::{DVec3, Vec3};

/// A question about a place of the picture, and the number of rays wanted with the answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Question {
    /// The place, in pixels from the upper left corner of the picture.
    pub position: [f32; 2],
    /// The number of rays in the fan on the vertical diameter of the lens, and in that on the horizontal one: at least
    /// two.
    pub fan: u32,
    /// The number of first samples of the pixel whose rays are wanted.
    pub samples: u32,
}

impl Question {
    /// A question about a place with as few rays as possible.
    pub fn at(position: [f32; 2]) -> Self {
        Self { position, fan: 2, samples: 0 }
    }
}

/// The answer to a [`Question`].
#[derive(Debug, Clone, PartialEq)]
pub struct Picked {
    /// The question.
    pub question: Question,
    /// The surface that is seen through the centre of the lens. `None` for the background.
    pub surface: Option<Surface>,
    /// The point where the centre ray meets the focal plane, as the device computes it. Not finite without a lens.
    pub focus: DVec3,
    /// The ray through the centre of the lens, then the vertical fan, the horizontal fan, and the samples.
    pub rays: Vec<LensRay>,
}

/// A ray from a point of the lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensRay {
    /// The point of the lens where the ray starts.
    pub origin: DVec3,
    /// The direction, of unit length.
    pub direction: DVec3,
    /// The distance to the surface that the ray hits, or infinity.
    pub distance: f64,
}

/// A point of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// The point in world coordinates.
    pub point: DVec3,
    /// The depth along the optical axis, in scene units.
    pub depth: f64,
    /// The focal distance at which the point is in focus: its depth, unless the lens is tilted. `None` if a tilted lens
    /// cannot be focused on it.
    pub focal_distance: Option<f64>,
    /// The name of the material.
    pub material: String,
}

/// A question that a frame in flight will answer.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    question: Question,
    camera: scene::Camera,
    lens: scene::Lens,
}

impl Picked {
    /// The rays of the vertical fan, from the lower rim of the lens to the upper one.
    pub fn fan_up(&self) -> &[LensRay] {
        let fan = self.question.fan as usize;
        &self.rays[1..=fan]
    }

    /// The rays of the horizontal fan, from left to right.
    pub fn fan_across(&self) -> &[LensRay] {
        let fan = self.question.fan as usize;
        &self.rays[1 + fan..=2 * fan]
    }

    /// The rays of the first samples of the pixel.
    pub fn samples(&self) -> &[LensRay] {
        &self.rays[1 + 2 * self.question.fan as usize..]
    }
}

impl Renderer {
    /// Records a question. A place outside the picture is moved to its edge, and at most as many rays are traced as
    /// [`Pick`] has room for. [`Renderer::picked`] returns the answer once the commands of `frame` are done. Returns
    /// false, and records nothing, if the renderer was not prepared for questions.
    pub fn record_pick(&mut self, recording: &mut Recording<'_>, frame: usize, question: Question) -> bool {
        self.record_aperture(recording);
        let Some(pick) = &mut self.loaded.passes.pick else {
            return false;
        };
        let estimator = &self.settings.estimator;
        let extent = estimator.size;
        // The position must stay below the extent, because there is no pixel at the extent itself.
        let inside = |axis: usize| question.position[axis].clamp(0.0, (extent[axis] as f32).next_down());
        let question = Question {
            position: [inside(0), inside(1)],
            fan: question.fan.clamp(2, Pick::MAX_FAN),
            samples: question.samples.min(Pick::MAX_SAMPLES),
        };
        let Question { position, fan, samples } = question;
        let push =
            PickPush { camera: Camera::new(estimator), extent, position, fan, samples, seed: estimator.seed };
        let (bindings, asked) = &mut pick.frames[frame];
        recording.barrier();
        pick.pass.record(recording, bindings, &push);
        recording.barrier();
        *asked = Some(Asked { question, camera: estimator.camera, lens: estimator.lens_in_use() });
        true
    }

    /// The answer to the question of `frame`, whose commands must be done. `None` if the frame had no question, if the
    /// answer was returned already, or if something else has been loaded since.
    pub fn picked(&mut self, frame: usize) -> Option<Picked> {
        let (bindings, asked) = &mut self.loaded.passes.pick.as_mut()?.frames[frame];
        let Asked { question, camera, lens } = asked.take()?;
        let scene = &self.settings.estimator.scene;
        let traced = bindings.read((1 + 2 * question.fan + question.samples) as usize);
        let vector = |vector: [f32; 3]| Vec3::from_array(vector).as_dvec3();
        let rays: Vec<LensRay> = (traced.iter())
            .map(|ray| LensRay {
                origin: scene.middle() + vector(ray.origin),
                direction: vector(ray.direction),
                distance: if ray.distance < MISS { ray.distance.into() } else { f64::INFINITY },
            })
            .collect();
        let centre = rays[0];
        let surface = centre.distance.is_finite().then(|| {
            let point = centre.origin + centre.distance * centre.direction;
            let depth = camera.frame().axial_depth(camera.eye, point);
            let material = scene.material_names.get(traced[0].material as usize).cloned();
            let focal_distance = camera.focal_distance_through(&lens, point);
            Surface { point, depth, focal_distance, material: material.unwrap_or_default() }
        });
        let focus = scene.middle() + vector(traced[0].focus);
        Some(Picked { question, surface, focus, rays })
    }

    /// Answers a question at once, without a window.
    ///
    /// # Errors
    /// As [`Renderer::set`].
    pub fn pick(&mut self, question: Question) -> Result<Option<Picked>> {
        self.set_and_answer(&self.settings.clone(), true)?;
        let mut commands = Commands::new(&self.preparer.device)?;
        let mut recording = commands.begin()?;
        self.record_pick(&mut recording, 0, question);
        recording.submit()?;
        commands.wait()?;
        Ok(self.picked(0))
    }
}
