//! What the viewer says in its log of itself. Its tests wait for these lines, and read them with the same words.

use crate::renderer::Progress;
use crate::settings::Settings;

/// A frame begins.
pub const FRAME: &str = "frame";
/// All is drawn that there is to draw, and nothing is being made ready.
pub const IDLE: &str = "idle";
/// Where the pointer is: x and y.
pub const POINTER_AT: &str = "pointer at";
/// The pointer is outside the window.
pub const POINTER_LEFT: &str = "pointer left";
/// A button or a key: `Pressed`, `Released`; or `Turned`, a wheel.
pub const INPUT: &str = "input";
/// Milliseconds since the first event that a frame shows.
pub const PRESENTED: &str = "presented";
/// A control: its name in quotes, `at`, its left, top, width and height.
pub const CONTROL: &str = "control";
/// What the panel tells the user.
pub const MESSAGE: &str = "message";
/// The command line that was copied.
pub const COPIED: &str = "copied";
/// A file or scene that is to be opened.
pub const LOADING: &str = "loading";
/// A file or scene that is shown from now on.
pub const LOADED: &str = "loaded";
/// A pass is compiled, whose name follows.
pub const COMPILING: &str = "compiling";
/// The pixel whose optics are drawn, and p there.
pub const DIAGRAM: &str = "diagram of";
/// Lens diameter, focal distance, `jitter` and the jitter.
pub const LENS: &str = "lens";
/// The lens's centre, and what the camera looks at.
pub const CAMERA: &str = "camera";
/// Camera model, field of view in degrees, blades, cat's eye.
pub const VIEW: &str = "view";
/// Samples and their target, separated by a slash, and the picture's size.
pub const SHOWN: &str = "shown";
/// What is allocated on the device: its bytes, and each allocation's name and bytes.
pub const MEMORY: &str = "memory";

/// What was said last, so that only changes are.
#[derive(Default)]
pub(super) struct Telemetry {
    lens: String,
    camera: String,
    view: String,
    shown: String,
    memory: Vec<(String, u64)>,
}

impl Telemetry {
    /// Says what has changed of what is set, and of the picture that is shown.
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

    /// Says what is allocated, where anybody listens.
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
