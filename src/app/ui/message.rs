//! The message over the picture.

use super::icons::{Icon, IconButton};
use super::widgets::{Layout, note_item};
use crate::app::area::Area;
use crate::app::message::{Messages, Offer};
use crate::app::over_picture::{Over, Place};
use crate::app::theme::{self, BELOW_LABELS, ICON, MESSAGE_WIDTH, OFFERS_WIDTH, PADDING, SPACING};
use imgui::Ui;

impl Messages {
    /// Draws the message at the top of the picture, and closes it when its button is pressed. Returns what the user
    /// accepts of what the message offers.
    pub(super) fn draw(&mut self, ui: &Ui, area: &Area, layout: &mut Layout) -> Option<Offer> {
        let (message, opacity) = self.in_this_frame()?;
        // The button that closes the message stands at the right of the text.
        let button = ICON + SPACING[0];
        let wrap = Over::room(area).min(MESSAGE_WIDTH) - button;
        let text_size = ui.calc_text_size_with_opts(&message.text, false, wrap);
        let width = text_size[0].min(wrap).max(if message.offers.is_empty() { 0.0 } else { OFFERS_WIDTH });
        let height = text_size[1].max(ICON);
        let offers = if message.offers.is_empty() { 0.0 } else { ui.frame_height() + SPACING[1] };
        let _fading = theme::fading(ui, opacity);
        let (mut closed, mut accepted) = (false, None);
        // A new window is in front of all others, so each message has a window of its own.
        let name = format!("##message {}", message.number);
        let size = [width + button, height + offers];
        let ground = if message.failed() { theme::FAILED } else { theme::OVER };
        let over = Over { below: BELOW_LABELS, ground, ..Over::new(name, Place::UpperLeft, size) };
        over.draw(ui, area, || {
            let [x, y] = ui.cursor_pos();
            ui.set_cursor_pos([x, y + 0.5 * (height - text_size[1])]);
            let wrapping = ui.push_text_wrap_pos_with_pos(x + wrap);
            ui.text_wrapped(&message.text);
            drop(wrapping);
            ui.set_cursor_pos([ui.window_size()[0] - PADDING - ICON, y]);
            let plain = theme::plain(ui);
            let help = "Closes the message.";
            let close =
                IconButton { icon: Icon::Close, name: "Close message", help, is_on: false, can: true };
            closed = close.draw(ui, layout);
            drop(plain);
            ui.set_cursor_pos([x, y + height + SPACING[1]]);
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
