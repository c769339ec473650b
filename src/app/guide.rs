//! Settings that are made by clicks on the picture. A sentence over the picture says what to click next.

use super::area::Area;
use super::over_picture::{Over, Place};
use super::theme::BLUR_WIDTH;
use super::words::length;
use crate::settings::Settings;
use imgui::{Key, Ui};

/// What the next clicks on the picture are for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Guide {
    /// Focus on what is clicked.
    Focus,
    /// Choose the lens that is sharp at the first place and blurs the second over so many pixels.
    Blur {
        /// The depth of the first place, once it has been clicked.
        sharp: Option<f64>,
        pixels: f32,
    },
    /// Choose the lens with which everything between two places is sharp.
    Range {
        /// The depth of the first place, once it has been clicked.
        first: Option<f64>,
    },
}

/// The blur that is offered first, in pixels.
const DEFAULT_BLUR: f32 = 20.0;
/// The blurs to choose from, in pixels.
const BLURS: [f32; 2] = [1.0, 200.0];

impl Guide {
    /// What the lens should be sharp at, and how far it should blur another place.
    pub(super) fn blur() -> Self {
        Self::Blur { sharp: None, pixels: DEFAULT_BLUR }
    }

    /// What should be sharp from here to there.
    pub(super) fn range() -> Self {
        Self::Range { first: None }
    }

    /// Takes the depth of what was clicked, which is infinite for the background. Returns what comes next, and what to
    /// say.
    pub(super) fn take_click(
        self,
        depth: f64,
        settings: &mut Settings,
    ) -> (Option<Self>, Option<Result<String, String>>) {
        let set = match self {
            Self::Focus => return (None, None),
            Self::Blur { sharp: None, pixels } => {
                return (Some(Self::Blur { sharp: Some(depth), pixels }), None);
            }
            Self::Range { first: None } => return (Some(Self::Range { first: Some(depth) }), None),
            Self::Blur { sharp: Some(sharp), pixels } => settings.blur_by_lens(sharp, depth, pixels),
            Self::Range { first: Some(first) } => settings.sharpen_by_lens(first, depth),
        };
        let estimator = &settings.estimator;
        let said = match set {
            Ok(()) => {
                let distance = length(estimator.lens.focal_distance.into());
                Ok(format!("The lens is now f/{:.2}, focused at {distance}.", estimator.f_number()))
            }
            Err(reason) => Err(format!("No lens does this: {reason}.")),
        };
        (None, Some(said))
    }

    /// Shows the sentence that says what to click. Returns the guide, unless it is left by Escape or the button.
    pub(super) fn draw(mut self, ui: &Ui, area: &Area) -> Option<Self> {
        let sentence = match self {
            Self::Focus => "Click what should be sharp.",
            Self::Blur { sharp: None, .. } => "1 of 2: click what should be sharp.",
            Self::Blur { .. } => "2 of 2: choose the blur, and click what should be blurred so far.",
            Self::Range { first: None } => "1 of 2: click where it should begin to be sharp.",
            Self::Range { .. } => "2 of 2: click where it should end to be sharp.",
        };
        let mut left_by_button = false;
        let width = ui.calc_text_size(sentence)[0].max(BLUR_WIDTH);
        Over::new("##guide", Place::Top, [width, 0.0]).draw(ui, area, || {
            ui.text_wrapped(sentence);
            if let Self::Blur { sharp: Some(_), pixels } = &mut self {
                ui.set_next_item_width(BLUR_WIDTH);
                let [low, high] = BLURS;
                ui.slider_config("##pixels", low, high).display_format("blurred over %.0f px").build(pixels);
                ui.same_line();
            }
            left_by_button = ui.button("Leave (Esc)");
        });
        (!left_by_button && !ui.is_key_pressed(Key::Escape)).then_some(self)
    }
}
