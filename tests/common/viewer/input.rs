//! What a user does with the pointer and the keys, by way of xdotool.

use super::{PANEL, Viewer};
use std::process::Command;

/// After an event the viewer draws three frames at least. Two see what comes of it, and are over when the third
/// one begins.
const FRAMES: usize = 3;

impl Viewer {
    /// Has xdotool do something, whenever the viewer may notice it.
    pub fn xdotool(&self, arguments: &str) {
        let status =
            Command::new("xdotool").args(arguments.split(' ')).env("DISPLAY", &self.display).status();
        assert!(status.expect("xdotool, which setup.sh installs").success(), "xdotool {arguments}");
    }

    /// Moves the pointer to a place in the window, and waits until the viewer has drawn what comes of it.
    pub fn point(&self, place: [i32; 2]) {
        let is_there = self.pointer.get() == Some(place);
        self.xdotool(&format!("mousemove {} {}", place[0], place[1]));
        if !is_there {
            self.wait_for("pointer", |viewer| viewer.pointer.get() == Some(place));
            self.frames(FRAMES);
        }
    }

    /// Presses or lets go, after which so many buttons and keys are held, and waits until the viewer has drawn
    /// what comes of it.
    pub fn hands(&self, arguments: &str, held: usize) {
        let before = self.inputs.get();
        self.xdotool(arguments);
        self.wait_for(arguments, |viewer| viewer.inputs.get() > before && viewer.held.get() == held);
        self.frames(FRAMES);
    }

    /// Presses keys and lets them go at once, for a key that is held acts again. Without a window manager, the
    /// window has to be told that it is meant.
    pub fn press(&self, keys: &str) {
        self.hands(&format!("search --class thinlens windowfocus --sync key --delay 0 {keys}"), 0);
    }

    /// Turns the wheel away at a place of the picture, while so many keys are held. Xvfb may send more than one
    /// notch: those that are still on their way come before the pointer's next move.
    pub fn wheel(&self, [x, y]: [i32; 2], held: usize) {
        self.point([x, y]);
        self.hands("click 4", held);
        self.point([x + 1, y]);
    }

    /// Drags over the picture, a step at a time.
    pub fn drag_picture(&self, button: u8, from: [i32; 2], to: [i32; 2]) {
        let at = |step: i32| {
            self.point([0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * step / 4));
        };
        at(0);
        self.hands(&format!("mousedown {button}"), 1);
        (1..=4).for_each(at);
        self.hands(&format!("mouseup {button}"), 0);
    }

    /// Drags a slider from one share of its width to others, a step at a time as a hand does.
    pub fn drag(&self, control: &str, shares: &[f64], reached: impl Fn(&Self) -> bool) {
        self.until(control, reached, || {
            let at = |share: f64| {
                let [x, y, width, height] = self.controls.borrow()[control];
                let x = x + (f64::from(width) * share).round() as i32;
                self.point([x.max(0), y + height / 2]);
            };
            at(shares[0]);
            self.hands("mousedown 1", 1);
            shares[1..].iter().copied().for_each(at);
            self.hands("mouseup 1", 0);
            self.point_away();
        });
    }

    /// Does something, once, and waits until it has come to this.
    pub fn until(&self, what: &str, reached: impl Fn(&Self) -> bool, act: impl Fn()) {
        act();
        self.wait_for(what, reached);
    }

    pub fn click(&self, control: &str, reached: impl Fn(&Self) -> bool) {
        self.until(control, reached, || self.click_once(control));
    }

    pub fn click_once(&self, control: &str) {
        // What has just unfolded may not have come to rest yet.
        loop {
            let place @ [x, y, _, height] = self.controls.borrow()[control];
            self.point([x + height / 2, y + height / 2]);
            if self.controls.borrow()[control] == place {
                break;
            }
        }
        self.hands("mousedown 1", 1);
        self.hands("mouseup 1", 0);
        self.point_away();
    }

    /// Out of the way of tooltips and highlights.
    pub fn point_away(&self) {
        self.point(self.size.map(|extent| i32::from(extent) - 5));
    }

    /// Gives the window another size, with which the picture has this one.
    pub fn resize(&mut self, [width, height]: [u16; 2]) {
        self.size = [width + PANEL, height];
        self.xdotool(&format!("search --class thinlens windowsize {} {height}", self.size[0]));
        let shown = format!("of {width}x{height}");
        self.wait_for("another size", |viewer| viewer.last_shown.borrow().contains(&shown));
    }

    /// Where a pixel of the picture is in the window.
    pub fn in_window(pixel: [u32; 2]) -> [i32; 2] {
        [pixel[0].cast_signed() + i32::from(PANEL), pixel[1].cast_signed()]
    }
}
