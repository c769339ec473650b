//! Where the camera stands, and how much it sees.

use super::{EVEN, camera, field, row};
use crate::scene::{METRES_PER_UNIT, PLACES, PRESETS, Preset, VFOV_DEGREES};
use crate::settings::{Access, Choice, Field, Key, Part, Role, Setting, Slider, Widget};

/// Where the camera stands. A known lens comes before what can be changed of it.
pub(super) static CAMERA: &[Setting] = &[
    Setting {
        flag: "eye",
        letter: None,
        value_name: "X,Y,Z",
        help: "Where the lens centre is",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("eye"),
        access: Access::Vector(field!(estimator.camera.eye), PLACES),
        row: row(Part::Viewpoint, "Lens centre", "Where the camera stands: x, y up, z.", Widget::Drag),
    },
    Setting {
        flag: "look-at",
        letter: None,
        value_name: "X,Y,Z",
        help: "A point that the camera looks at",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("look_at"),
        access: Access::Vector(field!(estimator.camera.look_at), PLACES),
        row: row(
            Part::Viewpoint,
            "Looks at",
            "A point on the line of sight; orbiting goes around it.",
            Widget::Drag,
        ),
    },
    Setting {
        flag: "up",
        letter: None,
        value_name: "X,Y,Z",
        help: "Which way is roughly up",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("up"),
        access: Access::Vector(field!(estimator.camera.up), PLACES),
        row: None,
    },
    Setting {
        flag: "metres-per-unit",
        letter: None,
        value_name: "M",
        help: "Length of a scene unit in metres: it ties the scene to millimetres of film and lens",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("metres_per_unit"),
        access: Access::Double(field!(estimator.camera.metres_per_unit), METRES_PER_UNIT),
        row: None,
    },
    Setting {
        flag: "preset",
        letter: None,
        value_name: "NAME",
        help: "A known lens: pinhole; a 50 mm lens, which sets the field of view too; or the human eye, by the width \
               of its pupil. The film of a 50 mm lens stays where it is for infinity, so near by it frames wider than \
               a lens that is screwed out: at 0.5 m as one of 45.5 mm would. Other options change it further",
        default: "",
        role: Role::Alias(&["vfov", "camera", "lens-diameter"]),
        key: camera("preset"),
        access: Access::Choice(
            Field {
                get: |_| "",
                set: |settings, name| {
                    if let Some(preset) = Preset::named(name) {
                        settings.estimator.take_preset(preset);
                    }
                },
            },
            || {
                let choice = |of: &Preset| Choice { name: of.name, label: of.label, help: of.help };
                PRESETS.iter().map(choice).collect()
            },
        ),
        row: row(
            Part::Lens,
            "Known lenses",
            "Puts a lens that people know in front of the camera. What is in focus stays in focus.",
            Widget::List,
        ),
    },
    Setting {
        flag: "vfov",
        letter: None,
        value_name: "DEG",
        help: "Field of view from the lower to the upper edge, in degrees",
        default: "the scene's",
        role: Role::Estimator,
        key: Some(Key {
            table: "camera",
            name: "vfov_degrees",
            otherwise: &["view_distance", "pixel_size"],
            rests_on: &["size"],
        }),
        access: Access::Double(
            Field {
                get: |settings| settings.estimator.camera.vfov_degrees(),
                set: |settings, degrees| settings.estimator.camera.vfov_radians = degrees.to_radians(),
            },
            VFOV_DEGREES,
        ),
        row: row(
            Part::Viewpoint,
            "Field of view",
            "The angle from the lower to the upper edge. The f-number changes with it: the film moves, and the lens stays as wide.",
            Widget::Slider(Slider {
                range: |_| VFOV_DEGREES.map(|end| end as f32),
                format: |_| "%.1f degrees".into(),
                ..Slider { rounds: false, ..EVEN }
            }),
        ),
    },
];
