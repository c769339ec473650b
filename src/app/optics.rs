//! The state of the drawing of the optics. `ui` draws it.

use super::theme::STRIP;
use crate::diagram::{KEPT, Part, Scale, View};
use glam::DVec2;

/// The state of the strip below the picture that draws the optics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Optics {
    pub(super) open: bool,
    /// The number of rays in each fan, and of samples.
    pub(super) rays: u32,
    pub(super) view: View,
    /// Whether the section has the same scale everywhere.
    pub(super) to_scale: bool,
    pub(super) pin: Pin,
    /// The depths of further points whose light is drawn.
    pub(super) kept: [Option<f64>; KEPT],
    /// How far from the pixel the drawing shows the picture, in pixels.
    pub(super) reach: u32,
    /// The part of the drawing that is being moved.
    pub(super) held: Option<HeldPart>,
    /// The height of the strip below the picture in points, as the user has set it.
    pub(super) height: f32,
}

/// The place in the picture whose optics are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pin {
    /// As a fraction of the picture's size.
    pub(super) share: [f32; 2],
    /// The depth of the point whose light is drawn, if it was moved. Otherwise the picture shows it there.
    pub(super) depth: Option<f64>,
}

/// A part of the drawing that is being moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HeldPart {
    pub(super) part: Part,
    /// The scale that the drawing had when the part was grasped.
    pub(super) scale: Scale,
    /// How far from the part it was grasped, in points.
    pub(super) beside: [f32; 2],
    /// The diameter of the opening divided by its half extent in the drawing, when it was grasped.
    pub(super) diameter_per_half: f64,
    /// The slopes of the centre ray to the right and upwards.
    pub(super) slope: DVec2,
    /// The focal length in mm divided by the distance of the film, when it was grasped.
    pub(super) mm_per_distance: f64,
}

impl Pin {
    /// The column and the row of the pixel in a picture of this size.
    pub(super) fn pixel(&self, size: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| (self.share[axis] * size[axis] as f32).floor() as u32)
    }
}

impl Optics {
    /// Draws the light of the point that the picture shows, and of no other one.
    pub(super) fn forget_points(&mut self) {
        (self.pin.depth, self.kept) = (None, [None; KEPT]);
    }
}

impl Default for Optics {
    fn default() -> Self {
        Self {
            open: false,
            rays: 9,
            view: View::Side,
            to_scale: false,
            pin: Pin { share: [0.5; 2], depth: None },
            kept: [None; KEPT],
            reach: 0,
            held: None,
            height: STRIP,
        }
    }
}
