//! Questions to the device about three pixels: the one under the pointer, the one whose optics are drawn, and the one
//! that was clicked. Also moves the focal plane to what was chosen, and keeps it there while the camera moves.

use super::area::Area;
use super::guide::Guide;
use super::optics::Pin;
use super::panel::Panel;
use super::theme::{self, DOT, FOCUS_MARK, FRAME_STROKE, PIN, SPACING, STROKE};
use super::words::{self, length};
use super::{navigate, telemetry};
use crate::diagram::Diagram;
use crate::renderer::{Picked, Question, Surface};
use crate::scene::{Camera, CameraModel, Lens, MAX_LENGTH, MIN_LENGTH};
use crate::settings::Estimator;
use glam::DVec3;
use imgui::{Key, MouseButton, Ui};
use std::time::{Duration, Instant};

/// How long the focal plane takes to reach a new distance: long enough that the eye can follow.
const GLIDE: Duration = Duration::from_millis(300);
/// How long the mark stays on the place that is brought into focus.
const MARK: Duration = Duration::from_millis(1200);
/// One notch of the wheel multiplies or divides the focal distance by this.
const NUDGE: f32 = 1.02;
/// A press and release that are at most this far apart, in points, are a click and not a drag.
const STILL: f32 = 3.0;
/// The focal plane goes through a point if it is this near to it, relative to its distance.
const IN_PLANE: f64 = 1e-4;

/// What the user asked for with the pointer, and the answers of the device.
#[derive(Default)]
pub(super) struct Focus {
    /// The position of the pointer, if it is over the picture.
    pointer: Option<[f32; 2]>,
    /// The place that was clicked, and what for, until the device has answered.
    wanted: Option<([f32; 2], Purpose)>,
    /// The point of the scene that was focused on last. The focal plane follows it for as long as it goes through it.
    target: Option<DVec3>,
    /// Where the left button was pressed, while it is held.
    pressed: Option<[f32; 2]>,
    /// The question that is not answered yet, and the settings of the picture that it is about.
    asked: Option<(Question, Estimator)>,
    /// The last answers.
    under_pointer: Option<Answer<Picked>>,
    diagram: Option<Answer<Diagram>>,
    glide: Option<Glide>,
    mark: Option<Mark>,
}

/// Why the device is asked about a place that was clicked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Purpose {
    /// To focus on it.
    Focus,
    /// To say what is there.
    Say,
    /// To turn the camera to it.
    LookAt,
    /// To go on with the [`Guide`].
    Guide,
}

/// An answer, with its question and the settings of the picture that it is about.
struct Answer<T> {
    known: T,
    question: Question,
    estimator: Estimator,
}

impl<T> Answer<T> {
    fn answers(&self, question: &Question, estimator: &Estimator) -> bool {
        self.question == *question && self.estimator == *estimator
    }
}

struct Glide {
    from: f32,
    to: f32,
    since: Instant,
}

struct Mark {
    at: [f32; 2],
    since: Instant,
    found: bool,
}

impl Focus {
    /// Handles mouse and keys over the picture.
    pub(super) fn take_input(&mut self, ui: &Ui, panel: &mut Panel, area: &Area) {
        let io = ui.io();
        let over_picture = !io.want_capture_mouse && ui.is_mouse_pos_valid(io.mouse_pos);
        let scale = io.display_framebuffer_scale;
        // The question is about the middle of the pixel under the pointer.
        self.pointer = over_picture.then(|| area.under_mouse(ui).map(|place| place.floor() + 0.5));
        let Some(pointer) = self.pointer else {
            self.pressed = None;
            return;
        };
        if ui.is_mouse_clicked(MouseButton::Left) {
            self.pressed = Some(pointer);
        }
        if ui.is_mouse_released(MouseButton::Left)
            && let Some(pressed) = self.pressed.take()
            && (pressed[0] - pointer[0]).hypot(pressed[1] - pointer[1]) <= STILL * scale[0]
        {
            if panel.guide.is_some() {
                self.wanted = Some((pointer, Purpose::Guide));
            } else {
                let share = [0, 1].map(|axis| pointer[axis] / area.pixels[axis] as f32);
                panel.optics.pin = Pin { share, depth: None };
                if !panel.optics.open && self.wanted.is_none() {
                    self.wanted = Some((pointer, Purpose::Say));
                }
            }
        }
        if panel.guide.is_none() && ui.is_mouse_double_clicked(MouseButton::Left) {
            self.wanted = Some((pointer, Purpose::LookAt));
        }
        if ui.is_mouse_clicked(MouseButton::Right) || (ui.is_key_pressed(Key::F) && !io.want_text_input) {
            self.wanted = Some((pointer, Purpose::Focus));
        }
        if io.key_ctrl && io.mouse_wheel != 0.0 {
            self.glide = None;
            let lens = &mut panel.settings.estimator.lens;
            let distance = lens.focal_distance * NUDGE.powf(io.mouse_wheel);
            lens.focal_distance = distance.clamp(MIN_LENGTH, MAX_LENGTH);
        }
    }

    /// Brings a place of the picture into focus. The position is in physical pixels.
    pub(super) fn send_to(&mut self, position: [f32; 2]) {
        self.wanted = Some((position, Purpose::Focus));
    }

    /// Stops the focal plane where it is.
    pub(super) fn stop(&mut self) {
        (self.wanted, self.glide) = (None, None);
    }

    /// Forgets what was focused on: it is not part of another scene.
    pub(super) fn leave_scene(&mut self) {
        self.stop();
        self.target = None;
    }

    /// Keeps the focal plane on the point that was focused on, if the camera has moved from `before` and the focal plane
    /// went through the point until then.
    pub(super) fn follow(&mut self, before: &Camera, panel: &mut Panel) {
        let Estimator { camera, lens, .. } = &mut panel.settings.estimator;
        let place = |camera: &Camera| [camera.eye, camera.look_at, camera.up];
        let Some(target) = self.target.filter(|_| panel.follows && place(before) != place(camera)) else {
            return;
        };
        let [Some(was), Some(is)] =
            [before, camera].map(|camera| camera.focal_distance_through(lens, target))
        else {
            return;
        };
        let distance = self.glide.as_mut().map_or(&mut lens.focal_distance, |glide| &mut glide.to);
        if is > f64::from(MIN_LENGTH) && (f64::from(*distance) - was).abs() <= IN_PLANE * was.abs() {
            *distance = (is as f32).min(MAX_LENGTH);
        }
    }

    /// The next question to the device about this picture, if there is one. `drawn` has the place whose optics are drawn
    /// and the number of rays, if the drawing is open.
    pub(super) fn question(&mut self, estimator: &Estimator, drawn: Option<(Pin, u32)>) -> Option<Question> {
        if self.asked.is_some() {
            return None;
        }
        let pinned = drawn.map(|(pin, rays)| {
            let position = pin.pixel(estimator.size).map(|at| at as f32 + 0.5);
            Question { position, fan: rays, samples: rays }
        });
        let pinned = pinned.filter(|question| {
            self.diagram.as_ref().is_none_or(|answer| !answer.answers(question, estimator))
        });
        let pointer = self.pointer.map(Question::at).filter(|question| {
            self.under_pointer.as_ref().is_none_or(|answer| !answer.answers(question, estimator))
        });
        let wanted = self.wanted.map(|(position, _)| Question::at(position));
        let question = wanted.or(pinned).or(pointer)?;
        self.asked = Some((question, estimator.clone()));
        Some(question)
    }

    /// Forgets the pending question: a lost device does not answer it.
    pub(super) fn forget(&mut self) {
        self.asked = None;
    }

    /// Handles the answer of the device, and returns what to say about it: an error if
    /// it cannot be done. No answer means that the device could not answer.
    pub(super) fn answer(
        &mut self,
        picked: Option<Picked>,
        panel: &mut Panel,
    ) -> Option<Result<String, String>> {
        let ((question, estimator), picked) = (self.asked.take()?, picked?);
        if question.samples > 0 {
            let known = Diagram::new(&estimator, &picked);
            if let Some((_, p)) = known.focus {
                log::trace!("{} {:?}: p at {p}", telemetry::DIAGRAM, question.position);
            }
            self.diagram = Some(Answer { known, question, estimator });
            return None;
        }
        let purpose = self.wanted.filter(|(position, _)| *position == question.position);
        let said = purpose.and_then(|(_, purpose)| {
            self.wanted = None;
            self.act(purpose, &picked, panel)
        });
        self.under_pointer = Some(Answer { known: picked, question, estimator });
        said
    }

    /// Does what the place was clicked for, and returns what to say.
    fn act(
        &mut self,
        purpose: Purpose,
        picked: &Picked,
        panel: &mut Panel,
    ) -> Option<Result<String, String>> {
        let surface = picked.surface.as_ref();
        match purpose {
            Purpose::Focus => {
                self.mark = Some(Mark {
                    at: picked.question.position,
                    since: Instant::now(),
                    found: surface.is_some(),
                });
                self.focus_on(surface, panel)
            }
            Purpose::Say => Some(Ok(format!(
                "{}. Press O to see the way of its light.",
                words::place(&panel.settings, surface)
            ))),
            Purpose::LookAt => {
                let Some(surface) = surface else {
                    return Some(Err("There is only the background: nothing to orbit around.".into()));
                };
                let before = panel.settings.estimator.camera;
                navigate::look_at(&mut panel.settings.estimator.camera, surface.point);
                self.follow(&before, panel);
                None
            }
            Purpose::Guide => {
                let guide = panel.guide.take()?;
                if guide == Guide::Focus {
                    return self.act(Purpose::Focus, picked, panel);
                }
                self.glide = None;
                let depth = surface.map_or(f64::INFINITY, |surface| surface.depth);
                let (next, said) = guide.take_click(depth, &mut panel.settings);
                panel.guide = next;
                said
            }
        }
    }

    /// Sends the focal plane to a surface, or for the background to the hyperfocal distance.
    fn focus_on(&mut self, surface: Option<&Surface>, panel: &Panel) -> Option<Result<String, String>> {
        let Estimator { model, lens, .. } = &panel.settings.estimator;
        if *model != CameraModel::ThinLens {
            return Some(Err(
                "This camera has no lens, and so nothing to focus. Choose a thin lens for that.".into(),
            ));
        }
        let (to, said) = match surface {
            Some(Surface { focal_distance: Some(distance), .. }) => (*distance, None),
            Some(_) => {
                return Some(Err(
                    "No focal distance makes the picture of this tilted lens sharp here. Tilt the lens less, or focus on another place.".into(),
                ));
            }
            None if lens.diameter == 0.0 => {
                return Some(
                    Ok("The lens is a point, so everything is sharp wherever it is focused.".into()),
                );
            }
            None => {
                let hyperfocal = panel.settings.hyperfocal_distance();
                let said = format!(
                    "The background is infinitely far away. The lens is focused at the hyperfocal distance, {}: \
                     everything from {} to infinity is sharp.",
                    length(hyperfocal),
                    length(0.5 * hyperfocal)
                );
                (hyperfocal, Some(Ok(said)))
            }
        };
        self.target = surface.map(|surface| surface.point);
        let to = (to as f32).clamp(MIN_LENGTH, MAX_LENGTH);
        self.glide = Some(Glide { from: lens.focal_distance, to, since: Instant::now() });
        log::debug!("focusing at {to}");
        said
    }

    /// Moves the focal plane on, for the time that has passed.
    pub(super) fn advance(&mut self, lens: &mut Lens) {
        if let Some(Glide { from, to, since }) = &self.glide {
            let t = (since.elapsed().as_secs_f32() / GLIDE.as_secs_f32()).min(1.0);
            let eased = t * t * (3.0 - 2.0 * t);
            // The blur is linear in the inverse of the distance, so equal steps of the inverse look even.
            lens.focal_distance =
                if t < 1.0 { (from.recip() + (to.recip() - from.recip()) * eased).recip() } else { *to };
            if t == 1.0 {
                self.glide = None;
            }
        }
        if self.mark.as_ref().is_some_and(|mark| mark.since.elapsed() > MARK) {
            self.mark = None;
        }
    }

    /// Draws the mark on the place that is brought into focus.
    pub(super) fn draw(&self, ui: &Ui, area: &Area) {
        let Some(Mark { at, since, found }) = &self.mark else {
            return;
        };
        let centre = area.in_window(*at);
        let fade = 1.0 - since.elapsed().as_secs_f32() / MARK.as_secs_f32();
        let (color, text) =
            if *found { (theme::ACCENT, None) } else { (theme::MARK, Some("infinitely far away")) };
        let color = theme::faded(color, fade);
        let list = ui.get_background_draw_list();
        list.add_circle(centre, FOCUS_MARK, color).thickness(FRAME_STROKE).num_segments(32).build();
        list.add_circle(centre, DOT, color).filled(true).build();
        if let Some(text) = text {
            let top = centre[1] - 0.5 * ui.text_line_height();
            list.add_text([centre[0] + FOCUS_MARK + SPACING[0], top], color, text);
        }
    }

    /// Whether another frame is needed.
    pub(super) fn is_busy(&self) -> bool {
        self.asked.is_some() || self.wanted.is_some() || self.glide.is_some() || self.mark.is_some()
    }

    /// Whether the focal plane is moving.
    pub(super) fn is_gliding(&self) -> bool {
        self.glide.is_some()
    }

    /// What is under the pointer, while the pointer is over the picture.
    pub(super) fn under_pointer(&self) -> Option<&Picked> {
        let answer = self.under_pointer.as_ref().filter(|_| self.pointer.is_some());
        answer.map(|answer| &answer.known)
    }

    /// The drawing of the optics of the pinned pixel.
    pub(super) fn diagram(&self) -> Option<&Diagram> {
        self.diagram.as_ref().map(|answer| &answer.known)
    }

    /// Marks the pinned pixel.
    pub(super) fn draw_pin(ui: &Ui, pin: Pin, area: &Area) {
        let centre = area.in_window([0, 1].map(|axis| pin.share[axis] * area.pixels[axis] as f32));
        let list = ui.get_background_draw_list();
        for (radius, color) in [(PIN + 1.0, theme::SHADE), (PIN, theme::MARK)] {
            list.add_circle(centre, radius, color).thickness(STROKE).build();
        }
    }
}
