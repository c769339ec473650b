//! What the viewer logs about itself. Its tests wait for these lines, and use the same constants to find them.

use crate::renderer::Progress;
use crate::settings::Settings;

/// A frame begins.
pub const FRAME: &str = "frame";
/// Everything is drawn, and nothing is being loaded or prepared.
pub const IDLE: &str = "idle";
/// The position of the pointer: x and y.
pub const POINTER_AT: &str = "pointer at";
/// The pointer is outside the window.
pub const POINTER_LEFT: &str = "pointer left";
/// Input: `Pressed` or `Released` for a button or a key, `Turned` for the wheel.
pub const INPUT: &str = "input";
/// A frame was presented. Gives the milliseconds since the oldest event whose effect it shows.
pub const PRESENTED: &str = "presented";
/// A control was drawn: its name in quotes, `at`, and its left, top, width and height.
pub const CONTROL: &str = "control";
/// A message to the user.
pub const MESSAGE: &str = "message";
/// The user copied this command line.
pub const COPIED: &str = "copied";
/// The viewer begins to open this file or scene.
pub const LOADING: &str = "loading";
/// The viewer shows this file or scene from now on.
pub const LOADED: &str = "loaded";
/// The pass with this name is being compiled.
pub const COMPILING: &str = "compiling";
/// The drawing of the optics is new: its pixel, and the point p.
pub const DIAGRAM: &str = "diagram of";
/// Lens diameter, focal distance, `jitter` and the jitter.
pub const LENS: &str = "lens";
/// The centre of the lens, and the point that the camera looks at.
pub const CAMERA: &str = "camera";
/// Camera model, field of view in degrees, blades, cat's eye.
pub const VIEW: &str = "view";
/// The samples per pixel of the picture on the screen and their target, separated by a slash, and the picture's size.
pub const SHOWN: &str = "shown";
/// The window has closed.
pub const CLOSED: &str = "closed";
/// The memory that is allocated on the device: all bytes, then the name and the bytes of each allocation.
pub const MEMORY: &str = "memory";

/// What was logged last, so that only changes are logged.
#[derive(Default)]
pub(super) struct Telemetry {
    lens: String,
    camera: String,
    view: String,
    shown: String,
    memory: Vec<(String, u64)>,
}

impl Telemetry {
    /// Logs what has changed in the settings and in the picture that is shown.
    pub(super) fn report(&mut self, set: &Settings, shown: &Settings, progress: Progress) {
        let estimator = &set.estimator;
        let (lens, camera, aperture) = (&estimator.lens, &estimator.camera, &estimator.aperture);
        say(
            &mut self.lens,
            LENS,
            format!("{} {} jitter {}", lens.diameter, lens.focal_distance, estimator.jitter),
        );
        let [eye, at] = [camera.eye, camera.look_at];
        say(&mut self.camera, CAMERA, format!("{} {} {} {} {} {}", eye.x, eye.y, eye.z, at.x, at.y, at.z));
        let vfov = camera.vfov_radians.to_degrees();
        say(
            &mut self.view,
            VIEW,
            format!("{:?} {vfov:.3} {} {}", estimator.model, aperture.blades, aperture.cats_eye),
        );
        let [width, height] = shown.estimator.size;
        say(
            &mut self.shown,
            SHOWN,
            format!("{}/{} points of {width}x{height}", progress.samples, shown.samples),
        );
    }

    /// Logs what is allocated on the device, if the log is on.
    pub(super) fn report_memory(&mut self, memory: impl FnOnce() -> Vec<(String, u64)>) {
        if !log::log_enabled!(log::Level::Trace) {
            return;
        }
        let memory = memory();
        if memory != self.memory {
            let bytes: u64 = memory.iter().map(|(_, bytes)| bytes).sum();
            log::trace!("{MEMORY} {bytes} bytes: {memory:?}");
            self.memory = memory;
        }
    }
}

fn say(last: &mut String, what: &str, now: String) {
    if *last != now {
        log::debug!("{what} {now}");
        *last = now;
    }
}
