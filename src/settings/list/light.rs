//! The brightness of the picture, and overlays.

use super::{EVEN, LOGARITHMIC, camera, field, row, view};
use crate::scene::{EXPOSURES, ISOS, OVERLAYS, Overlay, SHUTTERS};
use crate::settings::setting::NONE;
use crate::settings::{Access, Choice, Field, Part, Role, Setting, Slider, Unit, Widget, named};

/// The brightness of the picture.
pub(super) static LIGHT: &[Setting] = &[
    Setting {
        flag: "shutter",
        letter: None,
        value_name: "SECONDS",
        help: "How long the shutter is open, in seconds, such as 0.01 or 1/100, or like 4ms. A longer time gives a brighter picture, \
               with more motion blur",
        default: "the scene's, or 1/60",
        role: Role::Estimator,
        key: camera("shutter"),
        access: Access::Single(field!(estimator.shutter), SHUTTERS, Unit::Seconds),
        row: row(
            Part::Light,
            "Shutter",
            "How long the shutter is open, in seconds. Twice as long is twice as bright, and moving things are blurred along their paths. The aperture also blurs, but by depth and not by motion.",
            Widget::Slider(Slider { range: |_| [1.0 / 8000.0, 4.0], ..LOGARITHMIC }),
        ),
    },
    Setting {
        flag: "iso",
        letter: None,
        value_name: "ISO",
        help: "The speed of the film: a higher value gives a brighter picture",
        default: "the scene's, or 100",
        role: Role::View,
        key: camera("iso"),
        access: Access::Single(field!(view.iso), ISOS, Unit::Iso),
        row: row(
            Part::Light,
            "ISO",
            "The speed of the film: twice the value is twice as bright.",
            Widget::Slider(Slider { range: |_| [25.0, 25600.0], ..LOGARITHMIC }),
        ),
    },
    Setting {
        flag: "exposure-lock",
        letter: None,
        value_name: "true|false",
        help: "Whether the brightness stays as it is with the scene's own lens. Otherwise it changes with the area of \
               the aperture, as on film",
        default: "the scene's, or true",
        role: Role::View,
        key: view("exposure_lock"),
        access: Access::Switch(field!(view.exposure_lock)),
        row: row(
            Part::Light,
            "Keep the brightness",
            "On: the picture keeps its brightness when the aperture changes. Off: the brightness is proportional to the area of the aperture, as on film. Each stop halves it, and blades let in less light than a disc.",
            Widget::Box,
        ),
    },
    Setting {
        flag: "exposure",
        letter: None,
        value_name: "STOPS",
        help: "The brightness of a PNG or of the window, in stops: +1 doubles it, -1 halves it. An EXR does not change",
        default: "the scene's, or 0",
        role: Role::View,
        key: view("exposure"),
        access: Access::Single(field!(view.exposure_stops), EXPOSURES, Unit::Stops),
        row: row(
            Part::Light,
            "Exposure",
            "The brightness in stops: each stop doubles it. This changes only how the picture is shown.",
            Widget::Slider(Slider { range: |_| [-5.0, 5.0], decimals: Some(2), ..EVEN }),
        ),
    },
];

/// Overlays, and what counts as sharp.
pub(super) static VIEW: &[Setting] = &[
    Setting {
        flag: "overlay",
        letter: None,
        value_name: "",
        help: "What a PNG or the window shows instead of the picture, or on top of it",
        default: "the scene's, or none",
        role: Role::View,
        key: view("overlay"),
        access: Access::Choice(
            Field {
                get: |settings| settings.view.overlay.map_or(NONE, |shown| shown.entry().name),
                set: |settings, name| settings.show(named(&Overlay::NAMES, name)),
            },
            || {
                let picture = Choice {
                    name: NONE,
                    label: "Picture alone",
                    help: "The picture, and nothing on top of it.",
                };
                let overlays = OVERLAYS.iter();
                let overlays = overlays.map(|of| Choice { name: of.name, label: of.label, help: of.help });
                [picture].into_iter().chain(overlays).collect()
            },
        ),
        row: row(Part::View, "Show", "What is shown instead of the picture, or on top of it.", Widget::List),
    },
    Setting {
        flag: "tolerance",
        letter: None,
        value_name: "LENGTH",
        help: "The largest circle of confusion that counts as sharp: a length on a film of 36 x 24 mm such as 0.03mm, or \
               in pixels, such as 2px or 2. On the film, what is sharp does not depend on the size of the picture",
        default: "the scene's, or 0.03mm",
        role: Role::View,
        key: view("tolerance"),
        access: Access::Tolerance(field!(view.tolerance)),
        row: row(
            Part::Sharp,
            "Tolerance",
            "The largest circle of confusion that counts as sharp. On the film, 0.03 mm is usual for 35 mm cameras, and what is sharp does not depend on the size of the window. In pixels, it does.",
            Widget::Length,
        ),
    },
];
