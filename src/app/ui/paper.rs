//! A drawing surface for the optics: a rectangle of the window that shows the scene to scale.

use crate::diagram::Line;
use glam::DVec3;
use imgui::DrawListMut;

pub(super) type Color = [f32; 4];

const PAPER: Color = [0.045, 0.05, 0.065, 1.0];
pub(super) const FRAME: Color = [0.30, 0.33, 0.38, 1.0];
pub(super) const FAINT: Color = [0.55, 0.58, 0.64, 1.0];
const TEXT: Color = [0.86, 0.88, 0.92, 1.0];

/// The length of a dash of the centre ray and of a gap, in points.
const DASH: f32 = 5.0;
/// The space above the drawing, and below it, for text, in points.
const HEAD: f32 = 24.0;
const FOOT: f32 = 18.0;
/// About the width of a letter, in points.
pub(super) const LETTER: f32 = 8.0;

/// The direction of view.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum View {
    /// From the right: depth to the right, up is up.
    Side,
    /// From above: depth to the right, right is down.
    Top,
    /// From behind the camera.
    Front,
}

impl View {
    pub(super) fn flat(self, point: DVec3) -> [f64; 2] {
        match self {
            Self::Side => [point.z, point.y],
            Self::Top => [point.z, -point.x],
            Self::Front => [point.x, point.y],
        }
    }
}

/// A view: a rectangle of the window, and the mapping of the scene to it.
pub(super) struct Paper<'a> {
    pub(super) list: &'a DrawListMut<'a>,
    pub(super) min: [f32; 2],
    pub(super) max: [f32; 2],
    side: View,
    /// The point of the scene that is shown in the middle of the rectangle.
    middle: [f64; 2],
    /// Points per scene unit.
    scale: [f64; 2],
}

impl<'a> Paper<'a> {
    pub(super) fn new(list: &'a DrawListMut<'a>, min: [f32; 2], max: [f32; 2]) -> Self {
        let max = [max[0].max(min[0] + 1.0), max[1].max(min[1] + 1.0)];
        list.add_rect(min, max, PAPER).filled(true).rounding(3.0).build();
        list.add_rect(min, max, FRAME).rounding(3.0).build();
        Self { list, min, max, side: View::Side, middle: [0.0; 2], scale: [1.0; 2] }
    }

    /// Shows these bounds in the rectangle, as large as possible.
    pub(super) fn fit(&mut self, bounds: [[f64; 2]; 2], side: View) {
        let [width, height] = [0, 1].map(|axis| self.max[axis] - self.min[axis]);
        let room = [width, (height - HEAD - FOOT).max(1.0)].map(f64::from);
        let extent = bounds.map(|[low, high]| high - low);
        let scale = (room[0] / extent[0]).min(room[1] / extent[1].max(1e-12));
        self.side = side;
        self.middle = bounds.map(|[low, high]| 0.5 * (low + high));
        self.scale = [scale; 2];
    }

    pub(super) fn place(&self, point: DVec3) -> [f32; 2] {
        let flat = self.side.flat(point);
        let across = 0.5 * f64::from(self.min[0] + self.max[0]);
        [(across + (flat[0] - self.middle[0]) * self.scale[0]) as f32, self.height(flat[1])]
    }

    /// The vertical position at which something at this distance above the axis is drawn.
    fn height(&self, aside: f64) -> f32 {
        let middle = 0.5 * f64::from(self.min[1] + HEAD + self.max[1] - FOOT);
        (middle - (aside - self.middle[1]) * self.scale[1]) as f32
    }

    pub(super) fn line(&self, [from, to]: Line, color: Color, thickness: f32) {
        self.list.add_line(self.place(from), self.place(to), color).thickness(thickness).build();
    }

    pub(super) fn dashed(&self, [from, to]: Line, color: Color) {
        let (from, to) = (self.place(from), self.place(to));
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        // A line that leaves the rectangle could be extremely long, and its dashes would take forever.
        let visible = length.min((self.max[0] - self.min[0]).hypot(self.max[1] - self.min[1]) * 1.5);
        let at = |along: f32| [from[0] + dx / length * along, from[1] + dy / length * along];
        let mut along = 0.0;
        while along < visible {
            let end = (along + DASH).min(visible);
            self.list.add_line(at(along), at(end), color).thickness(1.5).build();
            along += 2.0 * DASH;
        }
    }

    /// Draws a line perpendicular to the axis at a depth, between two distances from the axis.
    pub(super) fn upright(&self, depth: f64, [low, high]: [f64; 2], color: Color, thickness: f32) {
        let [x, _] = self.place(DVec3::new(0.0, 0.0, depth));
        self.list.add_line([x, self.height(low)], [x, self.height(high)], color).thickness(thickness).build();
    }

    /// Draws a line perpendicular to the axis at a depth, over the whole height.
    pub(super) fn tall(&self, depth: f64, color: Color) {
        let [x, _] = self.place(DVec3::new(0.0, 0.0, depth));
        self.list.add_line([x, self.min[1]], [x, self.max[1]], color).thickness(1.5).build();
    }

    pub(super) fn dot(&self, point: DVec3, color: Color, name: &str) {
        let [x, y] = self.place(point);
        self.list.add_circle([x, y], 3.5, color).filled(true).build();
        let above = if y - 22.0 > self.min[1] + 18.0 { -20.0 } else { 4.0 };
        self.list.add_text([x + 4.0, y + above], color, name);
    }

    pub(super) fn title(&self, text: &str) {
        self.list.add_text([self.min[0] + 6.0, self.min[1] + 3.0], TEXT, text);
    }

    /// Writes a label at the bottom, to the right or left of this depth.
    pub(super) fn foot(&self, depth: f64, text: &str, color: Color, left: bool) {
        let [x, _] = self.place(DVec3::new(0.0, 0.0, depth));
        let aside = if left { -5.0 - LETTER * text.len() as f32 } else { 5.0 };
        self.list.add_text([x + aside, self.max[1] - 20.0], color, text);
    }

    /// Draws a scale bar of a round length at the upper right.
    pub(super) fn scale_bar(&self) {
        let most = 0.25 * f64::from(self.max[0] - self.min[0]) / self.scale[0];
        let power = 10.0_f64.powf(most.log10().floor());
        let round = [5.0, 2.0, 1.0].into_iter().find(|digit| digit * power <= most).unwrap_or(1.0) * power;
        let (right, y) = (self.max[0] - 8.0, self.min[1] + 24.0);
        let left = right - (round * self.scale[0]) as f32;
        self.list.add_line([left, y], [right, y], FAINT).thickness(2.0).build();
        let text = round.to_string();
        let width = LETTER * text.len() as f32;
        self.list.add_text([right - width, self.min[1] + 4.0], FAINT, text);
    }
}
