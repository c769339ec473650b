//! The message over the picture.

use super::MARGIN;
use super::widgets::{Layout, note_item};
use crate::app::area::Area;
use crate::app::message::{Messages, Offer};
use imgui::{Condition, StyleColor, StyleVar, Ui, WindowFlags};

/// The largest width of a message, in points.
const WIDTH: f32 = 560.0;
/// The least width of a message with buttons, in points.
const OFFERS: f32 = 200.0;
const PADDING: f32 = 12.0;
/// The room at the right for the button that closes the message, in points.
const BUTTON: f32 = 34.0;
const PLAIN: [f32; 4] = [0.08, 0.09, 0.11, 0.94];
const OFFER: [f32; 4] = [0.16, 0.29, 0.48, 1.0];
const FAILED: [f32; 4] = [0.48, 0.07, 0.09, 0.97];

impl Messages {
    /// Draws the message at the top of the picture, and closes it when its button is pressed. Returns what the user
    /// accepts of what the message offers.
    pub(super) fn draw(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) -> Option<Offer> {
        let (message, opacity) = self.in_this_frame()?;
        let [left, top] = area.min();
        let room = (area.size()[0] - 2.0 * MARGIN).clamp(80.0, WIDTH);
        let wrap = room - 2.0 * PADDING - BUTTON;
        let text_size = ui.calc_text_size_with_opts(&message.text, false, wrap);
        let width = text_size[0].min(wrap).max(if message.offers.is_empty() { 0.0 } else { OFFERS })
            + 2.0 * PADDING
            + BUTTON;
        let _style = (
            ui.push_style_var(StyleVar::Alpha(opacity)),
            ui.push_style_var(StyleVar::WindowPadding([PADDING; 2])),
            ui.push_style_color(StyleColor::WindowBg, if message.failed() { FAILED } else { PLAIN }),
            ui.push_style_color(StyleColor::Button, [0.0; 4]),
        );
        let (mut closed, mut accepted) = (false, None);
        let line = ui.frame_height();
        let height = text_size[1].max(line);
        let offers = if message.offers.is_empty() { 0.0 } else { line + 6.0 };
        // A new window is in front of all others, so each message has a window of its own.
        ui.window(format!("##message {}", message.number))
            // Below the labels of a comparison.
            .position([left + MARGIN, top + 48.0], Condition::Always)
            .size([width, height + offers + 2.0 * PADDING], Condition::Always)
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
                ui.set_cursor_pos([x, y + 0.5 * (height - text_size[1])]);
                let wrapping = ui.push_text_wrap_pos_with_pos(x + wrap);
                ui.text_wrapped(&message.text);
                drop(wrapping);
                ui.set_cursor_pos([width - BUTTON, y]);
                closed = ui.button("x");
                note_item(ui, "Close message", layout);
                let _color = ui.push_style_color(StyleColor::Button, OFFER);
                ui.set_cursor_pos([x, y + height + 6.0]);
                for offer in &message.offers {
                    if ui.button(offer.label()) {
                        accepted = Some(*offer);
                    }
                    note_item(ui, offer.label(), layout);
                    ui.same_line();
                }
            });
        if closed || accepted.is_some() {
            self.close();
        }
        accepted
    }
}
