//! The message over the picture.

use super::MARGIN;
use super::widgets::{Layout, note_item};
use crate::app::area::Area;
use crate::app::message::Messages;
use imgui::{Condition, StyleColor, StyleVar, Ui, WindowFlags};

/// The largest width of a message, in points.
const WIDTH: f32 = 560.0;
const PADDING: f32 = 12.0;
/// The room at the right for the button that closes the message, in points.
const BUTTON: f32 = 34.0;
const PLAIN: [f32; 4] = [0.08, 0.09, 0.11, 0.94];
const FAILED: [f32; 4] = [0.48, 0.07, 0.09, 0.97];

impl Messages {
    /// Draws the message at the top of the picture, and closes it when its button is pressed.
    pub(super) fn draw(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) {
        let Some((message, opacity)) = self.in_this_frame() else {
            return;
        };
        let [left, top] = area.min();
        let room = (area.size()[0] - 2.0 * MARGIN).clamp(80.0, WIDTH);
        let wrap = room - 2.0 * PADDING - BUTTON;
        let text_size = ui.calc_text_size_with_opts(&message.text, false, wrap);
        let width = text_size[0].min(wrap) + 2.0 * PADDING + BUTTON;
        let _style = (
            ui.push_style_var(StyleVar::Alpha(opacity)),
            ui.push_style_var(StyleVar::WindowPadding([PADDING; 2])),
            ui.push_style_color(StyleColor::WindowBg, if message.failed { FAILED } else { PLAIN }),
            ui.push_style_color(StyleColor::Button, [0.0; 4]),
        );
        let mut closed = false;
        // A new window is in front of all others, so each message has a window of its own.
        ui.window(format!("##message {}", message.number))
            // Below the labels of a comparison.
            .position([left + MARGIN, top + 48.0], Condition::Always)
            .size([width, text_size[1].max(ui.frame_height()) + 2.0 * PADDING], Condition::Always)
            .flags(
                WindowFlags::NO_DECORATION
                    | WindowFlags::NO_MOVE
                    | WindowFlags::NO_NAV
                    | WindowFlags::NO_DOCKING
                    | WindowFlags::NO_SAVED_SETTINGS
                    | WindowFlags::NO_FOCUS_ON_APPEARING,
            )
            .build(|| {
                let [x, y] = ui.cursor_pos();
                let wrapping = ui.push_text_wrap_pos_with_pos(x + wrap);
                ui.text_wrapped(&message.text);
                drop(wrapping);
                ui.set_cursor_pos([width - BUTTON, y - 2.0]);
                closed = ui.button("x");
                note_item(ui, "Close message", layout);
            });
        if closed {
            self.close();
        }
    }
}
