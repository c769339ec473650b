//! What lies under a place of the picture.

use super::Renderer;
use crate::error::Result;
use crate::gpu_types::{Camera, PickPush, PickedRay};
use crate::passes::Pick;
use crate::scene::SceneRef;
use crate::vulkan::{Commands, FRAMES_IN_FLIGHT, Recording};
use glam::Vec3;

/// What a place of the picture shows, through the centre of the lens.
#[derive(Debug, Clone, PartialEq)]
pub struct Picked {
    /// The place, in pixels from the picture's upper left corner.
    pub position: [f32; 2],
    /// What is there; none where the sky is.
    pub surface: Option<Surface>,
}

/// A point of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// In the world.
    pub point: Vec3,
    /// Its depth along the optical axis, in scene units: the focal distance at which it is in focus.
    pub depth: f64,
    /// The name of its material.
    pub material: String,
}

/// A question that a frame in flight will answer.
#[derive(Debug, Clone)]
pub(super) struct Question {
    position: [f32; 2],
    scene: SceneRef,
    camera: crate::scene::Camera,
}

impl Renderer {
    /// Records the question what is at `position`, in pixels from the picture's upper left corner. A place
    /// outside the picture is moved to its edge. [`Renderer::picked`] has the answer once the commands of `frame` are done.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn record_pick(
        &mut self,
        recording: &mut Recording<'_>,
        frame: usize,
        position: [f32; 2],
    ) -> Result<()> {
        let (Some(settings), Some(loaded), Some(passes)) = (&self.settings, &mut self.scene, &self.passes)
        else {
            return Ok(());
        };
        let estimator = &settings.estimator;
        let pick = match &mut loaded.pick {
            Some(pick) => pick,
            none => {
                let shader = self.shaders.pick;
                none.insert(Pick::new(&self.device, shader, passes.constants, &loaded.buffers)?)
            }
        };
        let extent = estimator.size;
        // The last f32 below the extent still has a pixel.
        let inside = |axis: usize| position[axis].clamp(0.0, (extent[axis] as f32).next_down());
        let position = [inside(0), inside(1)];
        recording.barrier();
        pick.record(recording, frame, &PickPush { camera: Camera::new(estimator), extent, position });
        recording.barrier();
        let (scene, camera) = (estimator.scene.clone(), estimator.camera);
        self.questions[frame] = Some(Question { position, scene, camera });
        Ok(())
    }

    /// The answer of `frame`, whose commands are done: once, and none where none was asked for, or where
    /// the scene has changed since.
    pub fn picked(&mut self, frame: usize) -> Option<Picked> {
        let Question { position, scene, camera } = self.questions[frame].take()?;
        let loaded = self.scene.as_ref().filter(|loaded| loaded.scene == scene)?;
        let PickedRay { origin, distance, direction, material } = loaded.pick.as_ref()?.read(frame);
        let [origin, direction] = [origin, direction].map(Vec3::from_array);
        let surface = (distance < MISS).then(|| {
            let point = origin + distance * direction;
            let depth = camera.frame().axial_depth(camera.eye, point);
            let material = scene.material_names.get(material as usize).cloned().unwrap_or_default();
            Surface { point, depth, material }
        });
        Some(Picked { position, surface })
    }

    /// What is at `position`, at once, without a window.
    ///
    /// # Errors
    /// What Vulkan says.
    pub fn pick(&mut self, position: [f32; 2]) -> Result<Option<Picked>> {
        let mut commands = Commands::new(&self.device)?;
        let mut recording = commands.begin()?;
        self.record_pick(&mut recording, 0, position)?;
        recording.submit()?;
        commands.wait()?;
        Ok(self.picked(0))
    }
}

/// `MISS` of intersect.glsl.
const MISS: f32 = 1e30;

pub(super) fn no_questions() -> [Option<Question>; FRAMES_IN_FLIGHT] {
    std::array::from_fn(|_| None)
}
