//! The shape of the opening.

use super::{EVEN, LOGARITHMIC, camera, field, row};
use crate::scene::{ANAMORPHICS, BLADES, CATS_EYES, ROTATIONS, ROUNDNESSES};
use crate::settings::{Access, Part, Role, Row, Setting, Settings, Slider, Widget};

fn has_iris(settings: &Settings) -> bool {
    let aperture = &settings.estimator.aperture;
    aperture.image.is_none() && aperture.blades > 0
}

fn has_rim(settings: &Settings) -> bool {
    let aperture = &settings.estimator.aperture;
    aperture.image.is_none() && aperture.blades == 0 && aperture.cats_eye > 0.0
}

/// The shape of the opening.
pub(super) static APERTURE: &[Setting] = &[
    Setting {
        flag: "blades",
        letter: None,
        value_name: "N",
        help: "The opening's shape: an iris of so many blades, 3 to 16; 0 is a disc. The blades' corners lie on the \
               rim of the lens's diameter: 5 let in 76% of a disc's light, 8 90%",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("blades"),
        access: Access::WholeOrZero(field!(estimator.aperture.blades), BLADES, "a disc"),
        row: Some(Row {
            part: Part::Aperture,
            label: "Blades",
            help: "How many blades the iris has. Their corners lie on the rim of the lens diameter: six let in 83% of the light of a disc.",
            shown: has_iris,
            widget: Widget::Slider(Slider {
                range: |_| BLADES.map(|count| count as f32),
                format: |_| "%d".into(),
                ..EVEN
            }),
        }),
    },
    Setting {
        flag: "blade-rotation",
        letter: None,
        value_name: "DEG",
        help: "Turns the iris anticlockwise, in degrees, seen from behind the camera; at 0 the middle of a blade's \
               edge is at the right",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("blade_rotation_degrees"),
        access: Access::Single(field!(estimator.aperture.rotation_degrees), ROTATIONS),
        row: Some(Row {
            part: Part::Aperture,
            label: "Blade rotation",
            help: "How far the iris is turned anticlockwise, in degrees, seen from behind the camera. At 0 the middle of an edge is at the right.",
            shown: has_iris,
            widget: Widget::Slider(Slider {
                range: |_| [-90.0, 90.0],
                format: |_| "%.0f deg".into(),
                ..EVEN
            }),
        }),
    },
    Setting {
        flag: "roundness",
        letter: None,
        value_name: "R",
        help: "How far the blades' edges are bent: 0 a polygon, 1 a disc",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("roundness"),
        access: Access::Single(field!(estimator.aperture.roundness), ROUNDNESSES),
        row: Some(Row {
            part: Part::Aperture,
            label: "Roundness",
            help: "How far the blades' edges are bent: 0 is a polygon, 1 a disc.",
            shown: has_iris,
            widget: Widget::Slider(EVEN),
        }),
    },
    Setting {
        flag: "cats-eye",
        letter: None,
        value_name: "C",
        help: "Optical vignetting: how far the lens's front rim is off its centre, seen from the picture's corner, in \
               diameters, up to 1; highlights turn into cat's eyes there, and the corners darken",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("cats_eye"),
        access: Access::Single(field!(estimator.aperture.cats_eye), CATS_EYES),
        row: Some(Row {
            part: Part::Aperture,
            label: "Rim",
            help: "How far the front rim is off the lens's centre, seen from the picture's corner, in diameters.",
            shown: has_rim,
            widget: Widget::Slider(Slider { range: |_| [0.01, 1.0], ..EVEN }),
        }),
    },
    Setting {
        flag: "anamorphic",
        letter: None,
        value_name: "A",
        help: "The opening's height over its width, 0.1 to 10; the longer is the diameter",
        default: "the scene's, or 1",
        role: Role::Estimator,
        key: camera("anamorphic"),
        access: Access::Single(field!(estimator.aperture.anamorphic), ANAMORPHICS),
        row: row(
            Part::Aperture,
            "Anamorphic",
            "How often the opening's width goes into its height. Lenses for wide screens squeeze the picture, and leave tall ovals.",
            Widget::Slider(Slider {
                range: |_| [0.5, 2.0],
                format: |_| "%.2f".into(),
                ..Slider { rounds: true, ..LOGARITHMIC }
            }),
        ),
    },
    Setting {
        flag: "aperture-image",
        letter: None,
        value_name: "FILE.png",
        help: "The shape of a PNG: light comes in where it is bright; none takes the scene's away",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("aperture_image"),
        access: Access::Image(field!(estimator.aperture.image)),
        row: None,
    },
];
