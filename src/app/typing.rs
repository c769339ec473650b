//! A value that the user types into a row of the panel.

use super::telemetry;
use crate::settings::{Called, Setting, Settings, Value};

/// A field that stands in the place of a slider until its text is taken or left.
pub(super) struct Typing {
    /// The setting whose value is typed.
    pub(super) setting: &'static Setting,
    /// What was typed.
    pub(super) text: String,
    /// The text that the field began with, which changes nothing.
    at_first: String,
    /// Why the text was refused, if it was.
    pub(super) refused: Option<String>,
    /// The number of frames for which the field has been without the keyboard. It asks for it in the first one.
    pub(super) without_keyboard: u32,
    /// Whether the row was drawn in this frame. A field whose row is gone is left.
    pub(super) drawn: bool,
}

impl Typing {
    pub(super) fn new(setting: &'static Setting, settings: &Settings) -> Self {
        let text = match setting.get(settings) {
            Value::Vector(place) => format!("{}, {}, {}", place.x, place.y, place.z),
            _ => {
                let shown = setting.shown(settings);
                // A length is shown in two units.
                shown.split(" = ").next().unwrap_or_default().to_owned()
            }
        };
        Self { setting, at_first: text.clone(), text, refused: None, without_keyboard: 0, drawn: true }
    }

    /// Changes the setting to what was typed. Returns whether it could; if not, the field stays, and says why.
    pub(super) fn take(&mut self, settings: &mut Settings) -> bool {
        if self.text == self.at_first {
            return true;
        }
        match changed(self.setting, &self.text, settings) {
            Ok(changed) => {
                *settings = changed;
                true
            }
            Err(reason) => {
                log::debug!("{} {reason}", telemetry::MESSAGE);
                self.refused = Some(reason);
                self.without_keyboard = 0;
                false
            }
        }
    }
}

/// The settings with this text as the value of one of them, or why it cannot be.
fn changed(setting: &Setting, text: &str, settings: &Settings) -> Result<Settings, String> {
    let value =
        setting.parse(text).map_err(|right| format!("\"{}\" cannot be read: {right}.", text.trim()))?;
    let refused = |error: crate::error::Error| format!("\"{}\": {error}.", text.trim());
    let mut changed = settings.clone();
    if setting.is_alias() {
        setting.check(&value, Called::Label).map_err(refused)?;
    }
    setting.set(&mut changed, &value).map_err(refused)?;
    changed.check_as(Called::Label).map_err(refused)?;
    Ok(changed)
}
