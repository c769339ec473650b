//! How a lone mesh is shown.

use super::{EVEN, LOGARITHMIC, by_name, field};
use crate::scene::{COLORS, LIGHT_STRENGTHS, ModelMaterial, PLACES, Stage, TURNS, UpAxis};
use crate::settings::{
    Access, Choice, Field, Part, Role, Row, Setting, Settings, Slider, Unit, Widget, name_of, named,
};
use glam::DVec3;

/// The range of the angle from which the light comes, in degrees.
const AZIMUTHS: [f64; 2] = [-360.0, 360.0];
/// The range of the height of the light above the horizon, in degrees.
const HEIGHTS: [f64; 2] = [-90.0, 90.0];

/// A row that is shown for a model.
const fn row(label: &'static str, help: &'static str, widget: Widget) -> Option<Row> {
    Some(Row { part: Part::Model, label, help, shown: is_model, widget })
}

fn is_model(settings: &Settings) -> bool {
    settings.estimator.scene.stage().is_some()
}

/// How a lone mesh is shown.
pub(super) static MODEL: &[Setting] = &[
    Setting {
        flag: "model-up",
        letter: None,
        value_name: "",
        help: "The axis of the file that points up",
        default: "y",
        role: Role::Model,
        key: None,
        access: Access::Choice(by_name!(UpAxis::NAMES, estimator.stage.up), || {
            let labels =
                ["y points up", "z points up", "x points up", "-y points up", "-z points up", "-x points up"];
            let of = |((name, _), label): (&(&'static str, _), _)| Choice { name, label, help: "" };
            UpAxis::NAMES.iter().zip(labels).map(of).collect()
        }),
        row: row(
            "Axis that points up",
            "The axis of the file that points up: y in most files, z in those of CAD programs. A model that lies on its back has another.",
            Widget::List,
        ),
    },
    Setting {
        flag: "model-turn",
        letter: None,
        value_name: "DEGREES",
        help: "How far the model is turned about the vertical, in degrees",
        default: "0",
        role: Role::Model,
        key: None,
        access: Access::Single(field!(estimator.stage.turn_degrees), TURNS, Unit::Degrees),
        row: row(
            "Turn",
            "Turns the model about the vertical.",
            Widget::Slider(Slider { range: |_| [-180.0, 180.0], decimals: Some(0), ..EVEN }),
        ),
    },
    Setting {
        flag: "model-material",
        letter: None,
        value_name: "",
        help: "What the model is made of",
        default: "own",
        role: Role::Model,
        key: None,
        access: Access::Choice(by_name!(ModelMaterial::NAMES, estimator.stage.material), || {
            let labels = [
                ("Its own colours", "The colours of its MTL files. Without such colours, it is clay."),
                ("Clay", "Matte, with a faint gloss."),
                ("Matte", "It reflects light evenly, like chalk."),
                ("Glossy", "With a bright highlight, like varnish."),
                ("Mirror", "A mirror of this colour, like polished metal."),
                ("Glowing", "It emits light of this colour, and reflects none."),
            ];
            let of = |((name, _), (label, help)): (&(&'static str, _), _)| Choice { name, label, help };
            ModelMaterial::NAMES.iter().zip(labels).map(of).collect()
        }),
        row: row("Material", "What the model is made of.", Widget::List),
    },
    Setting {
        flag: "model-color",
        letter: None,
        value_name: "COLOR",
        help: "The colour of the model: #RRGGBB in sRGB, or R,G,B in linear light. A model that keeps its own colours \
               ignores it",
        default: "0.75,0.36,0.2",
        role: Role::Model,
        key: None,
        access: Access::Color(field!(estimator.stage.color), COLORS),
        row: Some(Row {
            part: Part::Model,
            label: "Colour",
            help: "The colour of the material.",
            shown: |settings| settings.estimator.scene.uses_color(),
            widget: Widget::Color,
        }),
    },
    Setting {
        flag: "ground",
        letter: None,
        value_name: "true|false",
        help: "Whether the model stands on a checkered ground",
        default: "true",
        role: Role::Model,
        key: None,
        access: Access::Switch(field!(estimator.stage.ground)),
        row: row(
            "Ground",
            "On: the model stands on a checkered ground. Off: nothing is below it but the colour of the horizon.",
            Widget::Box,
        ),
    },
    Setting {
        flag: "sky",
        letter: None,
        value_name: "COLOR",
        help: "The colour of the sky above the model: #RRGGBB in sRGB, or R,G,B in linear light",
        default: "0.24,0.44,0.78",
        role: Role::Model,
        key: None,
        access: Access::Color(field!(estimator.stage.sky), COLORS),
        row: row(
            "Sky",
            "The colour straight up. Towards the horizon it changes to the colour there.",
            Widget::Color,
        ),
    },
    Setting {
        flag: "horizon",
        letter: None,
        value_name: "COLOR",
        help: "The colour of the sky at the horizon and below it: #RRGGBB in sRGB, or R,G,B in linear light",
        default: "0.92,0.9,0.87",
        role: Role::Model,
        key: None,
        access: Access::Color(field!(estimator.stage.horizon), COLORS),
        row: row(
            "Horizon",
            "The colour at the horizon, and below it where there is no ground.",
            Widget::Color,
        ),
    },
    Setting {
        flag: "light-direction",
        letter: None,
        value_name: "X,Y,Z",
        help: "The direction from the model towards the light that casts shadows",
        default: "-0.5,1,0.65",
        role: Role::Model,
        key: None,
        access: Access::Vector(field!(estimator.stage.light_direction), PLACES),
        row: None,
    },
    Setting {
        flag: "light-from",
        letter: None,
        value_name: "DEGREES",
        help: "The side from which the light comes, in degrees about the vertical: 0 is along the axis z, and 90 along x",
        default: "",
        role: Role::Alias(&["light-direction"]),
        key: None,
        access: Access::Double(
            Field {
                get: |settings| angles(&settings.estimator.stage)[0],
                set: |settings, azimuth| aim(&mut settings.estimator.stage, |[_, height]| [azimuth, height]),
            },
            AZIMUTHS,
            Unit::Degrees,
        ),
        row: row(
            "Light from",
            "The side from which the light comes, in degrees about the vertical: 0 is along the axis z, and 90 along x.",
            Widget::Slider(Slider { range: |_| [-180.0, 180.0], decimals: Some(0), ..EVEN }),
        ),
    },
    Setting {
        flag: "light-height",
        letter: None,
        value_name: "DEGREES",
        help: "The height of the light above the horizon, in degrees",
        default: "",
        role: Role::Alias(&["light-direction"]),
        key: None,
        access: Access::Double(
            Field {
                get: |settings| angles(&settings.estimator.stage)[1],
                set: |settings, height| aim(&mut settings.estimator.stage, |[azimuth, _]| [azimuth, height]),
            },
            HEIGHTS,
            Unit::Degrees,
        ),
        row: row(
            "Height of the light",
            "The height of the light above the horizon, in degrees: 90 is straight above.",
            Widget::Slider(Slider { range: |_| [0.0, 89.0], decimals: Some(0), ..EVEN }),
        ),
    },
    Setting {
        flag: "light-strength",
        letter: None,
        value_name: "NUMBER",
        help: "The strength of the light that casts shadows, relative to the default",
        default: "1",
        role: Role::Model,
        key: None,
        access: Access::Single(field!(estimator.stage.light_strength), LIGHT_STRENGTHS, Unit::Plain),
        row: row(
            "Strength of the light",
            "The strength of the light that casts shadows, relative to the default. The light from the sky and a weak light from the right stay.",
            Widget::Slider(Slider { range: |_| [0.05, 20.0], ..LOGARITHMIC }),
        ),
    },
];

/// The side and the height of the light, in degrees.
fn angles(stage: &Stage) -> [f64; 2] {
    let DVec3 { x, y, z } = stage.light_direction;
    [x.atan2(z).to_degrees(), y.atan2(x.hypot(z)).to_degrees()]
}

/// Moves the light to another side or height.
fn aim(stage: &mut Stage, to: impl FnOnce([f64; 2]) -> [f64; 2]) {
    let [azimuth, height] = to(angles(stage)).map(f64::to_radians);
    let direction = DVec3::new(height.cos() * azimuth.sin(), height.sin(), height.cos() * azimuth.cos());
    // A few digits are enough for a direction, and are easier to read in a command.
    stage.light_direction = (1e5 * direction).round() / 1e5;
}
