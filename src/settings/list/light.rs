//! How bright the picture is, and what is shown of it.

use super::{EVEN, LOGARITHMIC, camera, field, row, view};
use crate::scene::{EXPOSURES, ISOS, OVERLAYS, Overlay, SHUTTERS, TOLERANCES};
use crate::settings::setting::NONE;
use crate::settings::{Access, Choice, Field, Part, Role, Setting, Slider, Widget, named};
use std::borrow::Cow;

/// What is typed into a slider is read by the first part of what it shows: a fraction would be read up to its bar.
fn shutter_time(seconds: f32) -> Cow<'static, str> {
    if seconds >= 0.5 { "%.3g s".into() } else { format!("%.3g s (1/{:.0})", seconds.recip()).into() }
}

/// How bright the picture is.
pub(super) static LIGHT: &[Setting] = &[
    Setting {
        flag: "shutter",
        letter: None,
        value_name: "SECONDS",
        help: "How long the shutter is open, in seconds, as 0.01 or 1/100: longer is brighter, and what moves is \
               blurred more",
        default: "the scene's, or 1/60",
        role: Role::Estimator,
        key: camera("shutter"),
        access: Access::Seconds(field!(estimator.shutter), SHUTTERS),
        row: row(
            Part::Light,
            "Shutter",
            "How long light comes in, in seconds. Twice as long is twice as bright, and what moves is blurred along its way. The aperture is not the shutter: its blur comes of depth, not of motion.",
            Widget::Slider(Slider { range: |_| [1.0 / 8000.0, 4.0], format: shutter_time, ..LOGARITHMIC }),
        ),
    },
    Setting {
        flag: "iso",
        letter: None,
        value_name: "ISO",
        help: "The film's speed: higher is brighter",
        default: "the scene's, or 100",
        role: Role::View,
        key: camera("iso"),
        access: Access::Single(field!(view.iso), ISOS),
        row: row(
            Part::Light,
            "ISO",
            "The film's speed: twice as fast is twice as bright.",
            Widget::Slider(Slider {
                range: |_| [25.0, 25600.0],
                format: |_| "ISO %.0f".into(),
                ..LOGARITHMIC
            }),
        ),
    },
    Setting {
        flag: "exposure-lock",
        letter: None,
        value_name: "true|false",
        help: "Whether the brightness stays as the scene's lens makes it; else it changes with the area of the \
               opening, as on film",
        default: "the scene's, or true",
        role: Role::View,
        key: view("exposure_lock"),
        access: Access::Switch(field!(view.exposure_lock)),
        row: row(
            Part::Light,
            "Keep the brightness",
            "On: the picture stays as bright while the aperture changes. Off: it goes with the area of the opening, as on film: half with each stop, and less through blades than through a disc.",
            Widget::Box,
        ),
    },
    Setting {
        flag: "exposure",
        letter: None,
        value_name: "STOPS",
        help: "Brightness of a PNG or the window in stops: +1 doubles it, -1 halves it; an EXR stays as it is",
        default: "the scene's, or 0",
        role: Role::View,
        key: view("exposure"),
        access: Access::Single(field!(view.exposure_stops), EXPOSURES),
        row: row(
            Part::Light,
            "Exposure",
            "Brightness in stops: each doubles it. Changes only how the picture is shown.",
            Widget::Slider(Slider { range: |_| [-5.0, 5.0], format: |_| "%+.2f stops".into(), ..EVEN }),
        ),
    },
];

/// What is shown of it.
pub(super) static VIEW: &[Setting] = &[
    Setting {
        flag: "overlay",
        letter: None,
        value_name: "",
        help: "What to show, in a PNG or the window, instead of the picture or on it",
        default: "the scene's, or none",
        role: Role::View,
        key: view("overlay"),
        access: Access::Choice(
            Field {
                get: |settings| settings.view.overlay.map_or(NONE, |shown| shown.entry().name),
                set: |settings, name| settings.show(named(&Overlay::NAMES, name)),
            },
            || {
                let picture = Choice { name: NONE, label: "Picture", help: "The picture alone." };
                let overlays = OVERLAYS.iter();
                let overlays = overlays.map(|of| Choice { name: of.name, label: of.label, help: of.help });
                [picture].into_iter().chain(overlays).collect()
            },
        ),
        row: row(Part::View, "Show", "What is shown, instead of the picture or on it.", Widget::List),
    },
    Setting {
        flag: "tolerance",
        letter: None,
        value_name: "PX",
        help: "How wide a circle of confusion may be that counts as sharp, in pixels",
        default: "the scene's, or 1",
        role: Role::View,
        key: view("tolerance"),
        access: Access::Single(field!(view.tolerance), TOLERANCES),
        row: row(
            Part::View,
            "Tolerance",
            "How wide a circle of confusion may be that counts as sharp.",
            Widget::Slider(Slider { range: |_| [0.1, 30.0], format: |_| "%.2f px".into(), ..LOGARITHMIC }),
        ),
    },
];
