//! Focusing by the pointer: what lies under it, and the focal plane on its way there.

use crate::renderer::Picked;
use crate::scene::{Lens, MAX_LENGTH, MIN_LENGTH};
use imgui::{Key, MouseButton, Ui};
use std::time::{Duration, Instant};

/// How long the focal plane takes to where it is sent: the eye can follow.
const GLIDE: Duration = Duration::from_millis(300);
/// How long the place is marked.
const MARK: Duration = Duration::from_millis(1200);
/// What a notch of the wheel does to the focal distance.
const NUDGE: f32 = 1.02;
/// Points across the mark.
const MARK_RADIUS: f32 = 13.0;

/// What the pointer has asked for.
#[derive(Default)]
pub(super) struct Focus {
    /// Where the pointer is, if it is over the picture.
    pointer: Option<[f32; 2]>,
    /// What is to be brought into focus.
    wanted: Option<[f32; 2]>,
    /// The last question, while there is no answer.
    asked: Option<[f32; 2]>,
    /// The last answer.
    under_pointer: Option<Picked>,
    glide: Option<Glide>,
    mark: Option<Mark>,
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
    /// Takes in what mouse and keys did over the picture.
    pub(super) fn take_input(&mut self, ui: &Ui, lens: &mut Lens) {
        let io = ui.io();
        let over_picture = !io.want_capture_mouse && ui.is_mouse_pos_valid(io.mouse_pos);
        let scale = io.display_framebuffer_scale;
        // The pointer names a pixel, and the middle of it is what is asked for.
        self.pointer =
            over_picture.then(|| [0, 1].map(|axis| (io.mouse_pos[axis] * scale[axis]).floor() + 0.5));
        if self.pointer.is_none() {
            return;
        }
        if ui.is_mouse_clicked(MouseButton::Right) || (ui.is_key_pressed(Key::F) && !io.want_text_input) {
            self.wanted = self.pointer;
        }
        if io.key_ctrl && io.mouse_wheel != 0.0 {
            self.glide = None;
            let distance = lens.focal_distance * NUDGE.powf(io.mouse_wheel);
            lens.focal_distance = distance.clamp(MIN_LENGTH, MAX_LENGTH);
        }
    }

    /// Brings this place of the picture into focus, in physical pixels.
    pub(super) fn send_to(&mut self, position: [f32; 2]) {
        self.wanted = Some(position);
    }

    /// The place to ask the device about now, if any. `again`: what it said may not hold any more.
    pub(super) fn question(&mut self, again: bool) -> Option<[f32; 2]> {
        if self.asked.is_some() {
            return None;
        }
        let known = self.under_pointer.as_ref().map(|picked| picked.question.position);
        let pointer = self.pointer.filter(|pointer| again || known != Some(*pointer));
        self.asked = self.wanted.or(pointer);
        self.asked
    }

    /// What the device says. None: it could not tell.
    pub(super) fn answer(&mut self, picked: Option<Picked>, lens: &Lens) {
        let asked = self.asked.take();
        let Some(picked) = picked else {
            return;
        };
        if self.wanted.is_some() && asked == self.wanted {
            self.wanted = None;
            let found = picked.surface.as_ref().map(|surface| surface.depth as f32);
            self.mark =
                Some(Mark { at: picked.question.position, since: Instant::now(), found: found.is_some() });
            if let Some(to) = found {
                let to = to.clamp(MIN_LENGTH, MAX_LENGTH);
                self.glide = Some(Glide { from: lens.focal_distance, to, since: Instant::now() });
                log::debug!("focusing at {to}");
            }
        }
        self.under_pointer = Some(picked);
    }

    /// Moves the focal plane on.
    pub(super) fn advance(&mut self, lens: &mut Lens) {
        if let Some(Glide { from, to, since }) = &self.glide {
            let t = (since.elapsed().as_secs_f32() / GLIDE.as_secs_f32()).min(1.0);
            let eased = t * t * (3.0 - 2.0 * t);
            // Even steps of the inverse are even steps of the blur.
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

    /// Marks the place that was sent for.
    pub(super) fn draw(&self, ui: &Ui) {
        let Some(Mark { at, since, found }) = &self.mark else {
            return;
        };
        let scale = ui.io().display_framebuffer_scale;
        let centre = [at[0] / scale[0], at[1] / scale[1]];
        let fade = 1.0 - since.elapsed().as_secs_f32() / MARK.as_secs_f32();
        let (color, text) =
            if *found { ([1.0, 0.85, 0.3], None) } else { ([1.0, 0.4, 0.35], Some("nothing to focus on")) };
        let with_alpha = |alpha: f32| [color[0], color[1], color[2], alpha];
        let list = ui.get_background_draw_list();
        list.add_circle(centre, MARK_RADIUS, with_alpha(fade)).thickness(2.0).num_segments(32).build();
        list.add_circle(centre, 1.5, with_alpha(fade)).filled(true).build();
        if let Some(text) = text {
            list.add_text([centre[0] + MARK_RADIUS + 6.0, centre[1] - 8.0], with_alpha(fade), text);
        }
    }

    /// Whether another frame is needed for it.
    pub(super) fn is_busy(&self) -> bool {
        self.asked.is_some() || self.wanted.is_some() || self.glide.is_some() || self.mark.is_some()
    }

    /// Whether the focal plane is on its way.
    pub(super) fn is_gliding(&self) -> bool {
        self.glide.is_some()
    }

    /// What lies under the pointer, while it is over the picture.
    pub(super) fn under_pointer(&self) -> Option<&Picked> {
        self.under_pointer.as_ref().filter(|_| self.pointer.is_some())
    }
}
