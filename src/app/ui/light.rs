//! The part of the panel that says how bright the picture is.

use super::widgets::{Layout, named, note_item, tooltip};
use super::{LOGARITHMIC, Panel};
use crate::settings::Settings;
use imgui::{SliderFlags, Ui};

impl Panel {
    pub(super) fn exposure(&mut self, ui: &Ui, layout: &mut Layout) {
        let Settings { estimator, view, .. } = &mut self.settings;
        named(
            ui,
            "Shutter",
            "How long light comes in, in seconds. Twice as long is twice as bright, and what moves is blurred along its way. The aperture is not the shutter: its blur comes of depth, not of motion.",
            layout,
            |id| {
                // What is typed is read by the first part: a fraction would be read up to its bar.
                let shown = match estimator.shutter {
                    long if long >= 0.5 => "%.3g s".into(),
                    short => format!("%.3g s (1/{:.0})", short.recip()),
                };
                ui.slider_config(id, 1.0 / 8000.0, 4.0)
                    .display_format(shown)
                    .flags(LOGARITHMIC)
                    .build(&mut estimator.shutter);
            },
        );
        named(ui, "ISO", "The film's speed: twice as fast is twice as bright.", layout, |id| {
            ui.slider_config(id, 25.0, 25600.0)
                .display_format("ISO %.0f")
                .flags(LOGARITHMIC)
                .build(&mut view.iso);
        });
        ui.checkbox("Keep the brightness", &mut view.exposure_lock);
        note_item(ui, "Keep the brightness", layout);
        tooltip(
            ui,
            "On: the picture stays as bright while the aperture changes. Off: it goes with the area of the opening, as on film: half with each stop, and less through blades than through a disc.",
        );
        named(
            ui,
            "Exposure",
            "Brightness in stops: each doubles it. Changes only how the picture is shown.",
            layout,
            |id| {
                ui.slider_config(id, -5.0_f32, 5.0)
                    .display_format("%+.2f stops")
                    .flags(SliderFlags::ALWAYS_CLAMP)
                    .build(&mut view.exposure_stops);
            },
        );
    }
}
