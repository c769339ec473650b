//! The message that is shown over the picture.

use super::telemetry;
use std::time::{Duration, Instant};

/// How long a message is shown about which nothing has to be done, before it begins to fade.
const SHOWN: Duration = Duration::from_secs(6);
/// How long it fades.
const FADES: Duration = Duration::from_millis(500);

/// What the viewer tells the user. A question and a message about something that failed stay until they are closed or
/// replaced; any other one fades.
#[derive(Default)]
pub(super) struct Messages {
    shown: Option<Message>,
    /// The number of the last message.
    number: u32,
}

/// What a message offers to do, each by a button.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Offer {
    /// Save over the file that has the name already.
    Replace(Kind),
    /// Save under the next name that no file has.
    KeepBoth(Kind),
    /// Save the picture once it has all of its points.
    SaveWhenDone,
    /// Use an image that is no picture of thinlens as the shape of the aperture.
    UseAsAperture,
}

impl Offer {
    /// The text of its button.
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::Replace(_) => "Replace it",
            Self::KeepBoth(_) => "Keep both",
            Self::SaveWhenDone => "Save when done",
            Self::UseAsAperture => "Use as aperture",
        }
    }
}

/// What is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Picture,
    Scene,
}

pub(super) struct Message {
    pub(super) text: String,
    /// What can be done about it.
    pub(super) offers: Vec<Offer>,
    /// Whether it stays until it is closed or replaced.
    stays: bool,
    /// No two messages have the same number.
    pub(super) number: u32,
    /// When a frame first showed it.
    since: Option<Instant>,
}

impl Message {
    /// Whether something failed.
    pub(super) fn failed(&self) -> bool {
        self.stays && self.offers.is_empty()
    }
}

impl Messages {
    /// Shows that something was done.
    pub(super) fn say(&mut self, text: String) {
        self.show(text, false, Vec::new());
    }

    /// Shows that something was done, and offers to do more.
    pub(super) fn say_and_offer(&mut self, text: String, offer: Offer) {
        self.show(text, false, vec![offer]);
    }

    /// Asks what to do.
    pub(super) fn ask(&mut self, text: String, offers: Vec<Offer>) {
        self.show(text, true, offers);
    }

    /// Shows that something failed.
    pub(super) fn fail(&mut self, text: String) {
        self.show(text, true, Vec::new());
    }

    fn show(&mut self, text: String, stays: bool, offers: Vec<Offer>) {
        log::debug!("{} {text}", telemetry::MESSAGE);
        self.number += 1;
        self.shown = Some(Message { text, offers, stays, number: self.number, since: None });
    }

    pub(super) fn close(&mut self) {
        self.shown = None;
    }

    /// The message to draw in this frame and its opacity. The time begins with the first frame, so that nobody misses
    /// a message whose frame came late.
    pub(super) fn in_this_frame(&mut self) -> Option<(&Message, f32)> {
        let message = self.shown.as_mut()?;
        let faded = message.since.get_or_insert_with(Instant::now).elapsed().saturating_sub(SHOWN);
        let opacity = if message.stays { 1.0 } else { 1.0 - faded.as_secs_f32() / FADES.as_secs_f32() };
        if opacity <= 0.0 {
            self.shown = None;
        }
        self.shown.as_ref().map(|message| (message, opacity))
    }

    /// When the message begins to fade. From then on, each frame shows it fainter.
    pub(super) fn fades_at(&self) -> Option<Instant> {
        let message = self.shown.as_ref().filter(|message| !message.stays)?;
        message.since.map(|since| since + SHOWN)
    }
}
