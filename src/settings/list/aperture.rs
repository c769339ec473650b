//! The shape of the aperture.

use super::{EVEN, LOGARITHMIC, camera, field, row};
use crate::scene::{ANAMORPHICS, BLADES, CATS_EYES, CameraModel, PROFILES, ROTATIONS, ROUNDNESSES};
use crate::settings::{Access, Part, Role, Row, Setting, Settings, Slider, Unit, Widget};

fn has_iris(settings: &Settings) -> bool {
    let aperture = &settings.estimator.aperture;
    aperture.image.is_none() && aperture.blades > 0
}

fn has_rim(settings: &Settings) -> bool {
    let aperture = &settings.estimator.aperture;
    aperture.image.is_none() && aperture.blades == 0 && aperture.cats_eye > 0.0
}

fn has_profile(settings: &Settings) -> bool {
    settings.estimator.model == CameraModel::ThinLens && settings.estimator.aperture.image.is_none()
}

/// The shape of the aperture.
pub(super) static APERTURE: &[Setting] = &[
    Setting {
        flag: "blades",
        letter: None,
        value_name: "N",
        help: "The number of blades of the iris, 3 to 16, or 0 for a disc. The corners of the blades lie on the rim of \
               the lens: 5 blades let in 76% of a disc's light, 8 let in 90%",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("blades"),
        access: Access::WholeOrZero(field!(estimator.aperture.blades), BLADES, "a disc"),
        row: Some(Row {
            part: Part::Aperture,
            label: "Blades",
            help: "The number of blades of the iris. Their corners lie on the rim of the lens: six blades let in 83% of the light of a disc.",
            shown: has_iris,
            widget: Widget::Slider(Slider { range: |_| BLADES.map(|count| count as f32), ..EVEN }),
        }),
    },
    Setting {
        flag: "blade-rotation",
        letter: None,
        value_name: "DEG",
        help: "The angle by which the iris is turned anticlockwise, in degrees, as seen from behind the camera. At 0, \
               the middle of a blade's edge is at the right",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("blade_rotation_degrees"),
        access: Access::Single(field!(estimator.aperture.rotation_degrees), ROTATIONS, Unit::Degrees),
        row: Some(Row {
            part: Part::Aperture,
            label: "Blade rotation",
            help: "The angle by which the iris is turned anticlockwise, in degrees, as seen from behind the camera. At 0, the middle of an edge is at the right.",
            shown: has_iris,
            widget: Widget::Slider(Slider { range: |_| [-90.0, 90.0], decimals: Some(0), ..EVEN }),
        }),
    },
    Setting {
        flag: "roundness",
        letter: None,
        value_name: "R",
        help: "The curvature of the blades' edges: 0 gives a polygon, 1 a disc",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("roundness"),
        access: Access::Single(field!(estimator.aperture.roundness), ROUNDNESSES, Unit::Plain),
        row: Some(Row {
            part: Part::Aperture,
            label: "Roundness",
            help: "The curvature of the blades' edges: 0 gives a polygon, 1 a disc.",
            shown: has_iris,
            widget: Widget::Slider(Slider { decimals: Some(2), ..EVEN }),
        }),
    },
    Setting {
        flag: "cats-eye",
        letter: None,
        value_name: "C",
        help: "Optical vignetting: the distance of the front rim from the centre of the lens, as seen from a corner of \
               the picture, in diameters, up to 1. Highlights near the corners take the shape of cat's eyes, and the \
               corners darken",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("cats_eye"),
        access: Access::Single(field!(estimator.aperture.cats_eye), CATS_EYES, Unit::Plain),
        row: Some(Row {
            part: Part::Aperture,
            label: "Distance of the front rim",
            help: "How far the front rim of the lens seems to have moved aside, as seen from a corner of the picture, in diameters of the lens. The farther, the narrower are the cat's eyes.",
            shown: has_rim,
            widget: Widget::Slider(Slider { range: |_| [0.01, 1.0], decimals: Some(2), ..EVEN }),
        }),
    },
    Setting {
        flag: "anamorphic",
        letter: None,
        value_name: "A",
        help: "The height of the aperture divided by its width, 0.1 to 10. The longer of the two is the lens diameter",
        default: "the scene's, or 1",
        role: Role::Estimator,
        key: camera("anamorphic"),
        access: Access::Single(field!(estimator.aperture.anamorphic), ANAMORPHICS, Unit::Plain),
        row: row(
            Part::Aperture,
            "Anamorphic",
            "The height of the aperture divided by its width. Lenses for wide screens squeeze the picture, and blur into tall ovals.",
            Widget::Slider(Slider { range: |_| [0.5, 2.0], decimals: Some(2), ..LOGARITHMIC }),
        ),
    },
    Setting {
        flag: "bokeh-profile",
        letter: None,
        value_name: "P",
        help: "How the light is spread over the aperture, from -1 to 1: below 0 blurred lights have bright rims, like soap \
               bubbles, above 0 they fade outwards. The picture has as much light in all. It has no effect on an \
               aperture image, and on a hole",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("bokeh_profile"),
        access: Access::Single(field!(estimator.aperture.profile), PROFILES, Unit::Plain),
        row: Some(Row {
            part: Part::Aperture,
            label: "Bokeh profile",
            help: "How the light is spread over the aperture. Below 0, blurred lights have bright rims, like soap bubbles; above 0 they fade outwards, and blur looks soft.",
            shown: has_profile,
            widget: Widget::Slider(Slider { range: |_| [-1.0, 1.0], decimals: Some(2), ..EVEN }),
        }),
    },
    Setting {
        flag: "aperture-image",
        letter: None,
        value_name: "FILE.png",
        help: "A PNG file with the shape of the aperture: light comes in where it is bright. none removes the image of the scene",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("aperture_image"),
        access: Access::Image(field!(estimator.aperture.image)),
        row: None,
    },
];
