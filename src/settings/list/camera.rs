//! The position and the field of view of the camera.

use super::{EVEN, LOGARITHMIC, camera, field, row};
use crate::scene::{FOCAL_LENGTHS_MM, METRES_PER_UNIT, PLACES, PRESETS, Preset, VFOV_DEGREES};
use crate::settings::{Access, Choice, Estimator, Field, Key, Part, Role, Setting, Slider, Unit, Widget};

/// The position and the field of view of the camera. Known lenses come before the settings that they change.
pub(super) static CAMERA: &[Setting] = &[
    Setting {
        flag: "eye",
        letter: None,
        value_name: "X,Y,Z",
        help: "The position of the centre of the lens",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("eye"),
        access: Access::Vector(field!(estimator.camera.eye), PLACES),
        row: row(Part::Viewpoint, "Lens centre", "The position of the camera: x, y up, z.", Widget::Drag),
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
            "A point on the line of sight. Orbiting turns the camera around it.",
            Widget::Drag,
        ),
    },
    Setting {
        flag: "up",
        letter: None,
        value_name: "X,Y,Z",
        help: "The direction that is roughly up",
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
        help: "The length of a scene unit in metres: it relates the scene to the millimetres of film and lens",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("metres_per_unit"),
        access: Access::Double(field!(estimator.camera.metres_per_unit), METRES_PER_UNIT, Unit::Metres),
        row: None,
    },
    Setting {
        flag: "sensor",
        letter: None,
        value_name: "FORMAT",
        help: "The size of the film or sensor: full-frame, aps-c, micro-four-thirds, medium-format, 1-inch, phone, eye, or \
               its width and height in mm, such as 36x24. The field of view stays as it is, so the focal length changes",
        default: "the scene's, or full-frame",
        role: Role::Estimator,
        key: camera("sensor"),
        access: Access::Sensor(field!(estimator.camera.sensor)),
        row: row(
            Part::Lens,
            "Sensor",
            "The size of the film or sensor. A picture has its height. The field of view stays as it is, so another lens gives the same picture: its focal length changes.",
            Widget::List,
        ),
    },
    Setting {
        flag: "preset",
        letter: None,
        value_name: "NAME",
        help: "A known lens: a pinhole; a 50 mm lens, which also sets the field of view; or the human eye, by the width \
               of its pupil, which also sets the sensor and the field of view. Without --focus-breathing, the film \
               of a 50 mm lens stays where it is for focus at infinity. So at close range the field of view is wider \
               than that of a real lens: at 0.5 m it is that of a 45.5 mm lens. Other options change the lens further",
        default: "",
        role: Role::Alias(&["sensor", "vfov", "camera", "lens-diameter"]),
        key: camera("preset"),
        access: Access::Choice(
            Field {
                get: |settings| {
                    let Estimator { camera, model, lens, .. } = &settings.estimator;
                    Preset::on(camera, *model, lens).map_or("", |preset| preset.name)
                },
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
            "Puts a well-known lens on the camera. What is in focus stays in focus.",
            Widget::List,
        ),
    },
    Setting {
        flag: "vfov",
        letter: None,
        value_name: "DEG",
        help: "The vertical field of view, from the lower to the upper edge, in degrees",
        default: "the scene's",
        role: Role::Estimator,
        key: Some(Key {
            table: "camera",
            name: "vfov_degrees",
            otherwise: &["view_distance", "pixel_size"],
            rests_on: &["size", "sensor"],
        }),
        access: Access::Double(
            Field {
                get: |settings| settings.estimator.camera.vfov_degrees(),
                set: |settings, degrees| settings.estimator.camera.vfov_radians = degrees.to_radians(),
            },
            VFOV_DEGREES,
            Unit::Degrees,
        ),
        row: row(
            Part::Viewpoint,
            "Field of view",
            "The angle from the lower to the upper edge. Zooming moves the film. Under Lens you choose what stays: the f-number or the diameter.",
            Widget::Slider(Slider { range: |_| VFOV_DEGREES.map(|end| end as f32), ..EVEN }),
        ),
    },
    Setting {
        flag: "focal-length",
        letter: None,
        value_name: "MM",
        help: "The focal length in mm, such as 85 or 85mm, which gives the field of view in another way: the height of the sensor divided by \
               2 tan(vfov / 2)",
        default: "",
        role: Role::Alias(&["vfov"]),
        key: camera("focal_length"),
        access: Access::Double(
            Field {
                get: |settings| settings.estimator.camera.focal_length_mm(),
                set: |settings, mm| settings.estimator.camera.set_focal_length_mm(mm),
            },
            FOCAL_LENGTHS_MM,
            Unit::Millimetres,
        ),
        row: row(
            Part::Lens,
            "Focal length",
            "The focal length as photographers give it: it says how much the lens takes in with this sensor. A longer one shows less, and larger.",
            Widget::Slider(Slider { range: |_| [2.0, 800.0], ..LOGARITHMIC }),
        ),
    },
];
