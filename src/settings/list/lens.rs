//! The lens, or the hole of a camera without a lens.

use super::{EVEN, LOGARITHMIC, by_name, camera, field, row};
use crate::scene::{
    ABBE_NUMBERS, CameraModel, DIAMETERS, F_NUMBERS, FOCAL_DISTANCES, MAX_LENGTH, MIN_LENGTH, ROTATIONS,
    SHIFTS_MM, TILTS,
};
use crate::settings::{
    Access, Choice, Field, Key, Part, Role, Row, Setting, Settings, Slider, Unit, Widget, name_of, named,
};

/// The camera models, as shown to the user.
const CAMERAS: [Choice; 3] = [
    Choice {
        name: "thin-lens",
        label: "Thin lens",
        help: "Sharp in one plane, and blurred in front of it and behind it. A wider lens blurs more. This is an ideal lens: real ones also have coloured reflections, which their coatings do not suppress entirely.",
    },
    Choice { name: "pinhole", label: "Ideal pinhole", help: "A hole of no size: everything is sharp." },
    Choice {
        name: "hole",
        label: "Hole, no lens",
        help: "A box with a hole. The picture is upside down, because light crosses over in the hole. A small hole gives a sharp picture, a large one a fuzzier and brighter one.",
    },
];

fn has_lens(settings: &Settings) -> bool {
    settings.estimator.model == CameraModel::ThinLens
}

fn has_hole(settings: &Settings) -> bool {
    settings.estimator.model == CameraModel::Hole
}

fn lens_diameters(initial: &Settings) -> [f32; 2] {
    let lens = &initial.estimator.lens;
    let widest = if lens.diameter > 0.0 { 8.0 * lens.diameter } else { 0.1 * lens.focal_distance };
    [0.0, widest.min(MAX_LENGTH)]
}

fn focal_distances(initial: &Settings) -> [f32; 2] {
    let distance = initial.estimator.lens.focal_distance;
    [(distance / 20.0).max(MIN_LENGTH), (distance * 20.0).min(MAX_LENGTH)]
}

fn shifts(initial: &Settings) -> [f32; 2] {
    let half = 0.5 * initial.estimator.camera.sensor.height_mm as f32;
    [-half, half]
}

fn hole_diameters(initial: &Settings) -> [f32; 2] {
    [0.0, (20.0 * initial.estimator.camera.default_hole_diameter()).min(MAX_LENGTH)]
}

/// The lens, or the hole of a camera without a lens.
pub(super) static LENS: &[Setting] = &[
    Setting {
        flag: "camera",
        letter: None,
        value_name: "",
        help: "The camera model: a thin lens, an ideal pinhole with which everything is sharp, or a real hole in a box \
               without a lens",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("model"),
        access: Access::Choice(by_name!(CameraModel::NAMES, estimator.model), || CAMERAS.to_vec()),
        row: row(Part::Camera, "Camera", "A lens, an ideal pinhole, or a hole without a lens.", Widget::List),
    },
    Setting {
        flag: "focus-breathing",
        letter: None,
        value_name: "true|false",
        help: "Whether the lens moves away from the film to focus nearer, as a lens does that is screwed out. This narrows \
               the field of view, and blurs more. Otherwise the film stays in its place",
        default: "the scene's, or false",
        role: Role::Estimator,
        key: camera("focus_breathing"),
        access: Access::Switch(field!(estimator.camera.focus_breathing)),
        row: Some(Row {
            part: Part::Lens,
            label: "Focus breathing",
            help: "On: the lens moves away from the film to focus nearer, as a lens does that is screwed out. Near things then fill more of the picture, and blur is larger. Off: the film stays in its place.",
            shown: has_lens,
            widget: Widget::Box,
        }),
    },
    Setting {
        flag: "lens-diameter",
        letter: None,
        value_name: "L",
        help: "The diameter of the lens, in scene units or like 17mm. A wider lens blurs more, and 0 is a pinhole",
        default: "the scene's",
        role: Role::Estimator,
        key: Some(Key {
            table: "camera",
            name: "lens_diameter",
            otherwise: &[],
            rests_on: &["vfov", "metres-per-unit", "sensor"],
        }),
        access: Access::Single(field!(estimator.lens.diameter), DIAMETERS, Unit::Length),
        row: Some(Row {
            part: Part::Top,
            label: "Lens diameter",
            help: "The diameter of the lens, or of the pupil of an eye, in units of the scene and in real ones. A wide lens blurs more and needs more points per pixel. 0 is a pinhole: everything is sharp.",
            shown: has_lens,
            widget: Widget::Slider(Slider { range: lens_diameters, ..EVEN }),
        }),
    },
    Setting {
        flag: "f-number",
        letter: None,
        value_name: "N",
        help: "The f-number, such as 2.8 or f/2.8, which gives the lens diameter in another way: the focal length divided by the diameter. The \
               focal length is the height of the sensor, 24 mm on full frame, divided by 2 tan(vfov / 2)",
        default: "",
        role: Role::Alias(&["lens-diameter"]),
        key: camera("f_number"),
        access: Access::Double(
            Field {
                get: |settings| settings.estimator.f_number(),
                set: |settings, f_number| settings.estimator.set_f_number(f_number),
            },
            F_NUMBERS,
            Unit::FNumber,
        ),
        row: Some(Row {
            part: Part::Lens,
            label: "f-number",
            help: "The lens diameter as photographers give it: the focal length divided by the diameter. Each full stop has a button, and halves the light.",
            shown: has_lens,
            widget: Widget::Slider(Slider { range: |_| [0.5, 128.0], ..LOGARITHMIC }),
        }),
    },
    Setting {
        flag: "focal-distance",
        letter: None,
        value_name: "L",
        help: "The distance of the focal plane along the optical axis, in scene units or like 1.2m",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("focal_distance"),
        access: Access::Single(field!(estimator.lens.focal_distance), FOCAL_DISTANCES, Unit::Length),
        row: Some(Row {
            part: Part::Top,
            label: "Focal plane distance",
            help: "The distance of the plane in which everything is sharp. Right-click something in the picture to put it there.",
            shown: has_lens,
            widget: Widget::Slider(Slider { range: focal_distances, ..LOGARITHMIC }),
        }),
    },
    Setting {
        flag: "lens-shift",
        letter: None,
        value_name: "MM",
        help: "How far the lens is shifted to the right beside the film, in mm, such as 5 or -5mm. The picture shows more of \
               what is at the right, and straight lines stay as they are. It shifts a hole too",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("lens_shift"),
        access: Access::Single(
            Field {
                get: |settings| settings.estimator.camera.lens_shift_mm[0],
                set: |settings, mm| settings.estimator.camera.lens_shift_mm[0] = mm,
            },
            SHIFTS_MM,
            Unit::Millimetres,
        ),
        row: row(
            Part::Movements,
            "Shift",
            "How far the lens is shifted to the right beside the film. The picture shows more of what is at the right, and keeps its perspective.",
            Widget::Slider(Slider { range: shifts, decimals: Some(1), ..EVEN }),
        ),
    },
    Setting {
        flag: "lens-rise",
        letter: None,
        value_name: "MM",
        help: "How far the lens is shifted up beside the film, in mm. The picture shows more of what is above: a level camera \
               takes in a tall house whose walls stay parallel. It shifts a hole too",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("lens_rise"),
        access: Access::Single(
            Field {
                get: |settings| settings.estimator.camera.lens_shift_mm[1],
                set: |settings, mm| settings.estimator.camera.lens_shift_mm[1] = mm,
            },
            SHIFTS_MM,
            Unit::Millimetres,
        ),
        row: row(
            Part::Movements,
            "Rise",
            "How far the lens is shifted up beside the film. A level camera then takes in a tall house, and its walls stay parallel.",
            Widget::Slider(Slider { range: shifts, decimals: Some(1), ..EVEN }),
        ),
    },
    Setting {
        flag: "lens-tilt",
        letter: None,
        value_name: "DEG",
        help: "The angle by which the lens is tilted, in degrees, from -45 to 45. The focal plane tilts with it: a lens that \
               is tilted down can have the whole ground in focus. A pinhole and a hole have no lens to tilt",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("lens_tilt_degrees"),
        access: Access::Single(field!(estimator.lens.tilt_degrees), TILTS, Unit::Degrees),
        row: Some(Row {
            part: Part::Movements,
            label: "Tilt",
            help: "The angle by which the lens is tilted. The plane in which everything is sharp tilts with it, around a line below the lens: the smaller the tilt, the deeper the line.",
            shown: has_lens,
            widget: Widget::Slider(Slider { range: |_| [-15.0, 15.0], decimals: Some(1), ..EVEN }),
        }),
    },
    Setting {
        flag: "tilt-direction",
        letter: None,
        value_name: "DEG",
        help: "The direction to which the lens is tilted, in degrees anticlockwise, as seen from behind the camera. At 0 it \
               is tilted down, and at 90 to the right, which photographers call swing",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("tilt_direction_degrees"),
        access: Access::Single(field!(estimator.lens.tilt_direction_degrees), ROTATIONS, Unit::Degrees),
        row: Some(Row {
            part: Part::Movements,
            label: "Tilt direction",
            help: "The direction to which the lens is tilted, anticlockwise as seen from behind the camera: 0 is down, 90 to the right, which photographers call swing.",
            shown: |settings| has_lens(settings) && settings.estimator.lens.tilt_degrees != 0.0,
            widget: Widget::Slider(Slider { range: |_| [-180.0, 180.0], decimals: Some(0), ..EVEN }),
        }),
    },
    Setting {
        flag: "abbe-number",
        letter: None,
        value_name: "V",
        help: "The Abbe number of the lens, 1 to 100, or 0 for a lens without colour errors. The smaller it is, the farther \
               apart are the focal planes of red, green and blue light: 60 is crown glass, 30 is flint glass. It takes \
               three times as many rays",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("abbe_number"),
        access: Access::WholeOrZero(
            field!(estimator.lens.abbe_number),
            ABBE_NUMBERS,
            "a lens without colour errors",
        ),
        row: Some(Row {
            part: Part::Movements,
            label: "Abbe number",
            help: "The smaller the Abbe number of the glass, the farther apart are the focal planes of red, green and blue light. Crown glass has 60, flint glass 30. 0 is a lens without colour errors.",
            shown: has_lens,
            widget: Widget::Slider(Slider { range: |_| [0.0, ABBE_NUMBERS[1] as f32], ..EVEN }),
        }),
    },
    Setting {
        flag: "hole-diameter",
        letter: None,
        value_name: "L",
        help: "The diameter of the hole with --camera hole, in scene units or like 0.3mm",
        default: "the scene's, or 0.3 mm",
        role: Role::Estimator,
        key: Some(Key {
            table: "camera",
            name: "hole_diameter",
            otherwise: &[],
            rests_on: &["vfov", "metres-per-unit"],
        }),
        access: Access::Single(field!(estimator.hole.diameter), DIAMETERS, Unit::Length),
        row: Some(Row {
            part: Part::Top,
            label: "Hole diameter",
            help: "The diameter of the hole, in scene units. On the film, a far point becomes a spot of the same diameter.",
            shown: has_hole,
            widget: Widget::Slider(Slider { range: hole_diameters, ..EVEN }),
        }),
    },
    Setting {
        flag: "upright",
        letter: None,
        value_name: "true|false",
        help: "Whether the picture of a hole is turned upright. On the film it is upside down",
        default: "the scene's, or false",
        role: Role::Estimator,
        key: camera("upright"),
        access: Access::Switch(field!(estimator.hole.upright)),
        row: Some(Row {
            part: Part::Top,
            label: "Upright",
            help: "On the film the picture is upside down. This turns it upright, as you turn a slide.",
            shown: has_hole,
            widget: Widget::Box,
        }),
    },
];
