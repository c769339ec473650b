//! What lies under a place of the picture.

use super::Renderer;
use crate::error::Result;
use crate::gpu_types::{Camera, PickPush};
use crate::interface::MISS;
use crate::passes::Pick;
use crate::scene;
use crate::vulkan::{Commands, Recording};
use glam::{DVec3, Vec3};

/// A place of the picture, and how many rays are of interest there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Question {
    /// In pixels from the picture's upper left corner.
    pub position: [f32; 2],
    /// Rays of a fan up the lens, and of one across it: at least two each.
    pub fan: u32,
    /// The first samples of the pixel.
    pub samples: u32,
}

impl Question {
    /// What is there, with the fewest rays.
    pub fn at(position: [f32; 2]) -> Self {
        Self { position, fan: 2, samples: 0 }
    }
}

/// What a place of the picture shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Picked {
    /// What was asked.
    pub question: Question,
    /// What is seen through the centre of the lens; none where the sky is.
    pub surface: Option<Surface>,
    /// Where the centre ray meets the focal plane, as the device has it. Not finite without a lens.
    pub focus: DVec3,
    /// Through the centre of the lens, then those of the fan up, of the fan across, and the samples.
    pub rays: Vec<LensRay>,
}

/// A ray from a point of the lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensRay {
    /// The point of the lens.
    pub origin: DVec3,
    /// Unit length.
    pub direction: DVec3,
    /// The distance to what it meets; infinite where that is nothing.
    pub distance: f64,
}

/// A point of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// In the world.
    pub point: DVec3,
    /// Its depth along the optical axis, in scene units: the focal distance at which it is in focus.
    pub depth: f64,
    /// The name of its material.
    pub material: String,
}

/// A question that a frame in flight will answer.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    question: Question,
    camera: scene::Camera,
}

impl Picked {
    /// The rays of the fan up the lens, from its lower rim to its upper one.
    pub fn fan_up(&self) -> &[LensRay] {
        let fan = self.question.fan as usize;
        &self.rays[1..=fan]
    }

    /// The rays of the fan across the lens, from left to right.
    pub fn fan_across(&self) -> &[LensRay] {
        let fan = self.question.fan as usize;
        &self.rays[1 + fan..=2 * fan]
    }

    /// The first samples of the pixel.
    pub fn samples(&self) -> &[LensRay] {
        &self.rays[1 + 2 * self.question.fan as usize..]
    }
}

impl Renderer {
    /// Records a question. A place outside the picture is moved to its edge, and no more rays are traced than
    /// [`Pick`] has room for. [`Renderer::picked`] has the answer once the commands of `frame` are done. False where
    /// nothing was prepared for questions: then none is recorded.
    pub fn record_pick(&mut self, recording: &mut Recording<'_>, frame: usize, question: Question) -> bool {
        self.record_aperture(recording);
        let Some(pick) = &mut self.loaded.passes.pick else {
            return false;
        };
        let estimator = &self.settings.estimator;
        let extent = estimator.size;
        // The last f32 below the extent still has a pixel.
        let inside = |axis: usize| question.position[axis].clamp(0.0, (extent[axis] as f32).next_down());
        let question = Question {
            position: [inside(0), inside(1)],
            fan: question.fan.clamp(2, Pick::MOST_FAN),
            samples: question.samples.min(Pick::MOST_SAMPLES),
        };
        let Question { position, fan, samples } = question;
        let push =
            PickPush { camera: Camera::new(estimator), extent, position, fan, samples, seed: estimator.seed };
        let (bindings, asked) = &mut pick.frames[frame];
        recording.barrier();
        pick.pass.record(recording, bindings, &push);
        recording.barrier();
        *asked = Some(Asked { question, camera: estimator.camera });
        true
    }

    /// The answer of `frame`, whose commands are done: once, and none where none was asked for, or where
    /// something else has been loaded since.
    pub fn picked(&mut self, frame: usize) -> Option<Picked> {
        let (bindings, asked) = &mut self.loaded.passes.pick.as_mut()?.frames[frame];
        let Asked { question, camera } = asked.take()?;
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
            Surface { point, depth, material: material.unwrap_or_default() }
        });
        let focus = scene.middle() + vector(traced[0].focus);
        Some(Picked { question, surface, focus, rays })
    }

    /// What is at a place of the picture, at once, without a window.
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
