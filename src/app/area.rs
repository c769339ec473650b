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
    /// What is left of a window of this many pixels beside a column and above a strip of so many points.
    pub(super) fn beside([column, strip]: [f32; 2], window: [u32; 2], scale: f32) -> Self {
        let taken =
            |points: f32, axis: usize| ((points * scale).round() as u32).min(window[axis].saturating_sub(1));
        let (left, below) = (taken(column, 0), taken(strip, 1));
        Self { corner: [left, 0], pixels: [window[0] - left, window[1] - below], scale }
    }

    /// All of the window.
    pub(super) fn window(ui: &Ui) -> Self {
        let scale = ui.io().display_framebuffer_scale[0];
        let pixels = ui.io().display_size.map(|points| (points * scale).round() as u32);
        Self { corner: [0; 2], pixels, scale }
    }

    /// The middle of this area, as large as it can be with the proportions of a picture of this size.
    pub(super) fn with_proportions(&self, size: [u32; 2]) -> Self {
        let [width, height] = size.map(f64::from);
        let scale = (f64::from(self.pixels[0]) / width).min(f64::from(self.pixels[1]) / height);
        let pixels = [0, 1].map(|axis| {
            let extent = (scale * f64::from(size[axis])).round() as u32;
            extent.clamp(1, self.pixels[axis])
        });
        let corner = [0, 1].map(|axis| self.corner[axis] + (self.pixels[axis] - pixels[axis]) / 2);
        Self { corner, pixels, scale: self.scale }
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
