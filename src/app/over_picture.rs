//! Windows over the picture: greeting, lesson, messages, legend, keys, and what to click next.

use super::area::Area;
use super::theme::{self, Color, MARGIN, MIN_TEXT_WIDTH, PADDING};
use imgui::{Condition, Ui, WindowFlags};

/// Where a window stands in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    UpperLeft,
    Top,
    Middle,
    LowerLeft,
    LowerRight,
}

/// A window over the picture.
pub(super) struct Over {
    /// No two windows have the same name.
    pub(super) name: String,
    pub(super) place: Place,
    /// How much lower it stands than its place.
    pub(super) below: f32,
    /// Width and height of its content. A length that is 0 follows from the content.
    pub(super) size: [f32; 2],
    pub(super) ground: Color,
    /// Whether it takes what the pointer does. Otherwise that is for the picture.
    pub(super) takes_pointer: bool,
    /// Whether it scrolls where there is no room for it.
    pub(super) scrolls: bool,
}

impl Over {
    /// A window that takes what the pointer does.
    pub(super) fn new(name: impl Into<String>, place: Place, size: [f32; 2]) -> Self {
        Self {
            name: name.into(),
            place,
            below: 0.0,
            size,
            ground: theme::OVER,
            takes_pointer: true,
            scrolls: false,
        }
    }

    /// The widest content for which there is room in the picture.
    pub(super) fn room(area: &Area) -> f32 {
        (area.size()[0] - 2.0 * (MARGIN + PADDING)).max(MIN_TEXT_WIDTH)
    }

    /// Draws the window. It is no wider than the picture has room.
    pub(super) fn draw(&self, ui: &Ui, area: &Area, content: impl FnOnce()) {
        let ([left, top], [right, bottom]) = (area.min(), area.max());
        let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
        let (corner, pivot) = match self.place {
            Place::UpperLeft => ([left + MARGIN, top + MARGIN], [0.0, 0.0]),
            Place::Top => ([middle[0], top + MARGIN], [0.5, 0.0]),
            Place::Middle => (middle, [0.5, 0.5]),
            Place::LowerLeft => ([left + MARGIN, bottom - MARGIN], [0.0, 1.0]),
            Place::LowerRight => ([right - MARGIN, bottom - MARGIN], [1.0, 1.0]),
        };
        let widest = Self::room(area) + 2.0 * PADDING;
        let outer = |extent: f32| if extent > 0.0 { (extent + 2.0 * PADDING).ceil() } else { 0.0 };
        let mut flags = WindowFlags::NO_TITLE_BAR
            | WindowFlags::NO_RESIZE
            | WindowFlags::NO_COLLAPSE
            | WindowFlags::NO_MOVE
            | WindowFlags::NO_NAV
            | WindowFlags::NO_SAVED_SETTINGS
            | WindowFlags::NO_FOCUS_ON_APPEARING;
        flags.set(WindowFlags::NO_SCROLLBAR, !self.scrolls);
        flags.set(WindowFlags::NO_INPUTS, !self.takes_pointer);
        let _style = theme::over(ui, self.ground);
        ui.window(&self.name)
            .position([corner[0], corner[1] + self.below], Condition::Always)
            .position_pivot(pivot)
            .size([outer(self.size[0]).min(widest), outer(self.size[1])], Condition::Always)
            .size_constraints([0.0; 2], [widest, (bottom - top).max(MIN_TEXT_WIDTH)])
            .flags(flags)
            .build(content);
    }
}
