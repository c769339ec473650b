//! The part of the window that the picture takes.

use imgui::Ui;

/// A rectangle of the window. The mouse and the panel measure in points, the picture in physical pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Area {
    /// The upper left corner, in physical pixels of the window.
    pub(super) corner: [u32; 2],
    /// Width and height in physical pixels.
    pub(super) pixels: [u32; 2],
    /// Physical pixels per point.
    scale: f32,
}

impl Area {
    /// What is left of a window of this many pixels beside a column of this many points.
    pub(super) fn beside(column: f32, window: [u32; 2], scale: f32) -> Self {
        let left = ((column * scale).round() as u32).min(window[0].saturating_sub(1));
        Self { corner: [left, 0], pixels: [window[0] - left, window[1]], scale }
    }

    /// The upper left corner, in points.
    pub(super) fn min(&self) -> [f32; 2] {
        self.corner.map(|pixels| pixels as f32 / self.scale)
    }

    /// Width and height in points.
    pub(super) fn size(&self) -> [f32; 2] {
        self.pixels.map(|pixels| pixels as f32 / self.scale)
    }

    /// The lower right corner, in points.
    pub(super) fn max(&self) -> [f32; 2] {
        let (min, size) = (self.min(), self.size());
        [min[0] + size[0], min[1] + size[1]]
    }

    /// The place in the picture, in its pixels, where the mouse is.
    pub(super) fn under_mouse(&self, ui: &Ui) -> [f32; 2] {
        let mouse = ui.io().mouse_pos;
        [0, 1].map(|axis| mouse[axis] * self.scale - self.corner[axis] as f32)
    }

    /// Where a place in the picture is, in points of the window. The place is in pixels of the picture.
    pub(super) fn in_window(&self, place: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| (place[axis] + self.corner[axis] as f32) / self.scale)
    }
}

/// Where a window was drawn that the user can move: its position and size in points.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Placed(Option<[[f32; 2]; 2]>);

impl Placed {
    /// Notes where the current window is.
    pub(super) fn note(&mut self, ui: &Ui) {
        self.0 = Some([ui.window_pos(), ui.window_size()]);
    }

    /// The position and size with which the window lies in the area, if it did not when it was drawn last.
    pub(super) fn moved_into(&self, area: &Area) -> Option<[[f32; 2]; 2]> {
        let [position, size] = self.0?;
        let (min, room) = (area.min(), area.size());
        let size_within = [0, 1].map(|axis| size[axis].min(room[axis].floor()));
        let within =
            [0, 1].map(|axis| position[axis].min(min[axis] + room[axis] - size_within[axis]).max(min[axis]));
        (within != position || size_within != size).then_some([within, size_within])
    }

    /// Whether the window covers a part of this rectangle, which is given by its upper left corner and its size.
    pub(super) fn covers(&self, [min, size]: [[f32; 2]; 2]) -> bool {
        self.0.is_some_and(|[position, extent]| {
            (0..2).all(|axis| {
                position[axis] < min[axis] + size[axis] && min[axis] < position[axis] + extent[axis]
            })
        })
    }
}
