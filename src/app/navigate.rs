//! Moves the camera with the mouse and the keys: around the point that it looks at, sideways, nearer or away, and in
//! flight.

use super::area::Area;
use crate::scene::{Camera, MAX_LENGTH};
use crate::settings::Estimator;
use glam::{DQuat, DVec3};
use imgui::{Key, MouseButton, Ui};

/// The camera turns by this many radians for each point that the mouse moves.
const TURN: f64 = 0.006;
/// One notch of the wheel multiplies the distance by this.
const DOLLY: f64 = 0.9;
/// One second of flight covers this fraction of the distance to the point that the camera looks at.
const FLIGHT: f64 = 0.6;
/// The smallest angle between the line of sight and straight up or down, in radians.
const POLE: f64 = 0.02;
/// What is finite fills this share of the picture's width or height when all of it is framed.
const FILL: f64 = 0.9;
/// The mouse has to move this far, in points, before a press becomes a drag.
const STILL: f32 = 3.0;

/// The keys for flight, each with its direction: right, up, forward.
const FLYING: [(Key, [f64; 3]); 6] = [
    (Key::W, [0.0, 0.0, 1.0]),
    (Key::S, [0.0, 0.0, -1.0]),
    (Key::A, [-1.0, 0.0, 0.0]),
    (Key::D, [1.0, 0.0, 0.0]),
    (Key::Q, [0.0, -1.0, 0.0]),
    (Key::E, [0.0, 1.0, 0.0]),
];

/// The movement of the camera that is going on.
#[derive(Default)]
pub(super) struct Navigate {
    /// The button that is held, and whether it has become a drag.
    held: Option<(MouseButton, bool)>,
    /// Which keys of [`FLYING`] move the camera: those that were pressed without a modifier. After Ctrl+S, an S that is
    /// still held when Ctrl is released does not count.
    flying: [bool; FLYING.len()],
}

impl Navigate {
    /// Handles mouse and keys, and moves the camera.
    pub(super) fn take_input(&mut self, ui: &Ui, estimator: &mut Estimator, area: &Area) {
        let io = ui.io();
        // Right and up in the picture are left and down in the world if the picture is upside down.
        let side = if estimator.is_upside_down() { -1.0 } else { 1.0 };
        let camera = &mut estimator.camera;
        let over_picture = !io.want_capture_mouse;
        for button in [MouseButton::Left, MouseButton::Middle] {
            if over_picture && self.held.is_none() && ui.is_mouse_clicked(button) {
                self.held = Some((button, false));
            }
        }
        if let Some((button, drags)) = &mut self.held {
            if ui.is_mouse_down(*button) {
                let [x, y] = ui.mouse_drag_delta_with_threshold(*button, 0.0);
                *drags |= x.hypot(y) > STILL;
                if *drags {
                    let [x, y] = [x, y].map(|points| side * f64::from(points));
                    if *button == MouseButton::Middle || io.key_shift {
                        pan(camera, [x, y], area.size()[1]);
                    } else {
                        orbit(camera, [-TURN * x, -TURN * y]);
                    }
                    ui.reset_mouse_drag_delta(*button);
                }
            } else {
                self.held = None;
            }
        }
        if over_picture && io.mouse_wheel != 0.0 && !io.key_ctrl {
            dolly(camera, DOLLY.powf(f64::from(io.mouse_wheel)));
        }
        let keys = !io.want_text_input && !io.key_ctrl && !io.key_alt;
        let mut way = DVec3::ZERO;
        for ((key, towards), flies) in FLYING.iter().zip(&mut self.flying) {
            *flies |= ui.is_key_pressed_no_repeat(*key);
            *flies &= keys && ui.is_key_down(*key);
            if *flies {
                way += DVec3::from_array(*towards);
            }
        }
        if way != DVec3::ZERO {
            way *= DVec3::new(side, side, 1.0);
            fly(camera, (way * FLIGHT * f64::from(io.delta_time.min(0.1))).to_array());
        }
    }

    /// Whether the camera is being moved.
    pub(super) fn is_moving(&self) -> bool {
        self.flying.contains(&true) || self.held.is_some_and(|(_, drags)| drags)
    }
}

/// Turns the camera to a point, which it orbits from then on.
pub(super) fn look_at(camera: &mut Camera, point: DVec3) {
    place(camera, camera.eye, point);
}

/// Moves the camera along its line of sight and sideways, so that the picture has all of the scene that is finite.
pub(super) fn frame_all(estimator: &mut Estimator) {
    let [width, height] = estimator.size.map(f64::from);
    let bounds = estimator.scene.shapes.iter().filter_map(|of| of.shape.bounds());
    let Some([lower, upper]) = bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]) else {
        return;
    };
    let (camera, center, half) = (&mut estimator.camera, 0.5 * (lower + upper), 0.5 * (upper - lower));
    let frame = camera.frame();
    let highest = FILL * (0.5 * camera.vfov_radians).tan();
    let widest = highest * width / height;
    let distance = (0..8).map(|corner| {
        let side = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let corner = half * DVec3::new(side(0), side(1), side(2));
        let aside = (corner.dot(frame.u()).abs() / widest).max(corner.dot(frame.v()).abs() / highest);
        corner.dot(frame.w()) + aside.max(0.1 * half.length())
    });
    place(camera, center + distance.fold(0.0, f64::max) * frame.w(), center);
}

/// Places the camera there, unless it could not see from that place.
fn place(camera: &mut Camera, eye: DVec3, look_at: DVec3) {
    let moved = Camera { eye, look_at, ..*camera }.with_few_digits();
    let within = |point: DVec3| point.abs().max_element() <= f64::from(MAX_LENGTH);
    if within(moved.eye) && within(moved.look_at) && moved.has_frame() {
        *camera = moved;
    }
}

/// Turns the camera around the point that it looks at: to the right by the first angle and up by the second.
fn orbit(camera: &mut Camera, [right, up]: [f64; 2]) {
    let (eye, look_at) = (camera.eye, camera.look_at);
    let pole = camera.up.normalize();
    let away = DQuat::from_axis_angle(pole, right) * (eye - look_at);
    let from_pole = away.angle_between(pole);
    let turned = (from_pole - up).clamp(POLE, std::f64::consts::PI - POLE) - from_pole;
    let aside = pole.cross(away).normalize();
    place(camera, look_at + DQuat::from_axis_angle(aside, turned) * away, look_at);
}

/// Moves the camera sideways, so that the point that it looks at follows the mouse by this many points. The picture is so many
/// points high.
fn pan(camera: &mut Camera, [x, y]: [f64; 2], height: f32) {
    let (eye, look_at, frame) = (camera.eye, camera.look_at, camera.frame());
    let pixel = 2.0 * (0.5 * camera.vfov_radians).tan() * eye.distance(look_at) / f64::from(height);
    let shift = (y * frame.v() - x * frame.u()) * pixel;
    place(camera, eye + shift, look_at + shift);
}

/// Moves the camera along the line of sight, to this fraction of its distance.
fn dolly(camera: &mut Camera, share: f64) {
    let (eye, look_at) = (camera.eye, camera.look_at);
    place(camera, look_at + (eye - look_at) * share, look_at);
}

/// Moves the camera right, up and forward. The unit is the distance to the point that it looks at.
fn fly(camera: &mut Camera, [right, up, forward]: [f64; 3]) {
    let (eye, look_at, frame) = (camera.eye, camera.look_at, camera.frame());
    let shift = (right * frame.u() + up * frame.v() - forward * frame.w()) * eye.distance(look_at);
    place(camera, eye + shift, look_at + shift);
}
