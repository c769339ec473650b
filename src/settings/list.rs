//! Every setting, once. The command line's options, what pictures carry and the ranges follow from this list.

use super::setting::{Access, Field, Key, Role, Setting};
use super::{
    EXPOSURES, F_NUMBERS, ISOS, JITTERS, MAX_SAMPLES, SHUTTERS, Sampler, TOLERANCES, name_of, named,
};
use crate::scene::{
    BLADES, CameraModel, MAX_BOUNCES, MAX_EXTENT, MAX_LENGTH, METRES_PER_UNIT, MIN_LENGTH, Overlay, PRESETS,
    Preset, VFOV_DEGREES,
};

/// A value that stands in a field of [`Settings`].
macro_rules! field {
    ($($path:ident).+) => {
        Field { get: |settings| settings.$($path).+.clone(), set: |settings, value| settings.$($path).+ = value }
    };
}

/// A value that has a name among [`Sampler::NAMES`] and their like, and stands in a field.
macro_rules! choice {
    ($names:expr, $($path:ident).+) => {
        Access::Choice {
            names: || $names.map(|(name, _)| name).to_vec(),
            field: Field {
                get: |settings| name_of(&$names, &settings.$($path).+),
                set: |settings, name| {
                    if let Some(value) = named(&$names, name) {
                        settings.$($path).+ = value;
                    }
                },
            },
        }
    };
}

const fn camera(name: &'static str) -> Option<Key> {
    Some(Key { table: "camera", name })
}

const fn view(name: &'static str) -> Option<Key> {
    Some(Key { table: "view", name })
}

const fn top(name: &'static str) -> Option<Key> {
    Some(Key { table: "", name })
}

const PLACES: [f64; 2] = [-(MAX_LENGTH as f64), MAX_LENGTH as f64];
/// What the overlay is called where there is none.
const NO_OVERLAY: &str = "none";

/// The settings, in the order in which they are applied: those that change others come before them, so that a known
/// lens can be given and changed at once.
pub static SETTINGS: &[Setting] = &[
    Setting {
        flag: "size",
        letter: Some('s'),
        value_name: "WxH",
        help: "Picture size in pixels; the view keeps its height and gains or loses at the sides",
        default: "the scene's, in the viewer the window's",
        role: Role::Estimator,
        key: top("size"),
        access: Access::Size(field!(estimator.size), [1, MAX_EXTENT]),
    },
    Setting {
        flag: "samples",
        letter: Some('n'),
        value_name: "N",
        help: "Antialiasing points per pixel: more for less noise",
        default: "64, in the viewer 256",
        role: Role::Samples,
        key: None,
        access: Access::Whole(field!(samples), [1, MAX_SAMPLES]),
    },
    Setting {
        flag: "eye",
        letter: None,
        value_name: "X,Y,Z",
        help: "Where the lens centre is",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("eye"),
        access: Access::Vector(field!(estimator.camera.eye), PLACES),
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
    },
    Setting {
        flag: "metres-per-unit",
        letter: None,
        value_name: "M",
        help: "Length of a scene unit in metres: it ties the scene to millimetres of film and lens",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("metres_per_unit"),
        access: Access::Double(
            field!(estimator.camera.metres_per_unit),
            [*METRES_PER_UNIT.start(), *METRES_PER_UNIT.end()],
        ),
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
        access: Access::Choice {
            names: || PRESETS.map(|preset| preset.name).to_vec(),
            field: Field {
                get: |_| "",
                set: |settings, name| {
                    if let Some(preset) = Preset::named(name) {
                        settings.estimator.take_preset(preset);
                    }
                },
            },
        },
    },
    Setting {
        flag: "vfov",
        letter: None,
        value_name: "DEG",
        help: "Field of view from the lower to the upper edge, in degrees",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("vfov_degrees"),
        access: Access::Double(
            Field {
                get: |settings| settings.estimator.camera.vfov_degrees(),
                set: |settings, degrees| settings.estimator.camera.vfov_radians = degrees.to_radians(),
            },
            [*VFOV_DEGREES.start(), *VFOV_DEGREES.end()],
        ),
    },
    Setting {
        flag: "camera",
        letter: None,
        value_name: "",
        help: "What forms the picture: a thin lens, an ideal pinhole that leaves everything sharp, or a real hole in \
               a box, without a lens",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("model"),
        access: choice!(CameraModel::NAMES, estimator.model),
    },
    Setting {
        flag: "lens-diameter",
        letter: None,
        value_name: "L",
        help: "Diameter of the lens, in scene units: wider blurs more, 0 is a pinhole",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("lens_diameter"),
        access: Access::Single(field!(estimator.lens.diameter), [0.0, MAX_LENGTH]),
    },
    Setting {
        flag: "f-number",
        letter: None,
        value_name: "N",
        help: "The same by its f-number, which is the film's distance behind the lens over the diameter; the film \
               stands 12 mm / tan(vfov / 2) behind it",
        default: "",
        role: Role::Alias(&["lens-diameter"]),
        key: camera("f_number"),
        access: Access::Double(
            Field {
                get: |settings| settings.estimator.f_number(),
                set: |settings, f_number| settings.estimator.set_f_number(f_number),
            },
            F_NUMBERS,
        ),
    },
    Setting {
        flag: "focal-distance",
        letter: None,
        value_name: "L",
        help: "Distance of the plane in focus, in scene units along the axis",
        default: "the scene's",
        role: Role::Estimator,
        key: camera("focal_distance"),
        access: Access::Single(field!(estimator.lens.focal_distance), [MIN_LENGTH, MAX_LENGTH]),
    },
    Setting {
        flag: "hole-diameter",
        letter: None,
        value_name: "L",
        help: "Diameter of the hole, with --camera hole, in scene units",
        default: "the scene's, or 0.3 mm",
        role: Role::Estimator,
        key: camera("hole_diameter"),
        access: Access::Single(field!(estimator.hole.diameter), [0.0, MAX_LENGTH]),
    },
    Setting {
        flag: "upright",
        letter: None,
        value_name: "true|false",
        help: "Turn the picture of a hole upright: on the film it is upside down",
        default: "the scene's, or false",
        role: Role::Estimator,
        key: camera("upright"),
        access: Access::Switch(field!(estimator.hole.upright)),
    },
    Setting {
        flag: "blades",
        letter: None,
        value_name: "N",
        help: "The opening's shape: an iris of so many blades, 3 to 16; 0 is a disc. The blades' corners lie on the \
               rim of the lens's diameter: 5 let in 76% of a disc's light, 8 90%",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("blades"),
        access: Access::WholeOrZero(
            field!(estimator.aperture.blades),
            [*BLADES.start(), *BLADES.end()],
            "a disc",
        ),
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
        access: Access::Single(field!(estimator.aperture.rotation_degrees), [-360.0, 360.0]),
    },
    Setting {
        flag: "roundness",
        letter: None,
        value_name: "R",
        help: "How far the blades' edges are bent: 0 a polygon, 1 a disc",
        default: "the scene's, or 0",
        role: Role::Estimator,
        key: camera("roundness"),
        access: Access::Single(field!(estimator.aperture.roundness), [0.0, 1.0]),
    },
    Setting {
        flag: "anamorphic",
        letter: None,
        value_name: "A",
        help: "The opening's height over its width, 0.1 to 10; the longer is the diameter",
        default: "the scene's, or 1",
        role: Role::Estimator,
        key: camera("anamorphic"),
        access: Access::Single(field!(estimator.aperture.anamorphic), [0.1, 10.0]),
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
        access: Access::Single(field!(estimator.aperture.cats_eye), [0.0, 1.0]),
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
    },
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
    },
    Setting {
        flag: "overlay",
        letter: None,
        value_name: "",
        help: "Show, in a PNG or the window, instead of the picture: circle-of-confusion (blue in front of the focal \
               plane, orange behind), depth, samples (count) or error of each pixel; or the picture with what is sharp \
               marked (focus-peaking), or what the focal plane cuts (focal-plane)",
        default: "the scene's, or none",
        role: Role::View,
        key: view("overlay"),
        access: Access::Choice {
            names: || Overlay::NAMES.map(|(name, _)| name).into_iter().chain([NO_OVERLAY]).collect(),
            field: Field {
                get: |settings| {
                    settings.view.overlay.map_or(NO_OVERLAY, |shown| name_of(&Overlay::NAMES, &shown))
                },
                set: |settings, name| settings.show(named(&Overlay::NAMES, name)),
            },
        },
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
    },
    Setting {
        flag: "jitter",
        letter: None,
        value_name: "PX",
        help: "Width of the square that a pixel's samples fall in: 1 is its own area, 0 one centre ray per pixel, \
               more, up to 15, reaches into the neighbours",
        default: "1",
        role: Role::Estimator,
        key: None,
        access: Access::Single(field!(estimator.jitter), JITTERS),
    },
    Setting {
        flag: "max-bounces",
        letter: None,
        value_name: "N",
        help: "How many mirror reflections to follow, up to 64",
        default: "the scene's",
        role: Role::Estimator,
        key: top("max_bounces"),
        access: Access::Whole(field!(estimator.max_bounces), [0, MAX_BOUNCES]),
    },
    Setting {
        flag: "sampler",
        letter: None,
        value_name: "",
        help: "How the points are chosen: sobol keeps a pixel's points apart, blue-noise also sets neighbouring \
               pixels off against each other, random does neither",
        default: "blue-noise",
        role: Role::Estimator,
        key: None,
        access: choice!(Sampler::NAMES, estimator.sampler),
    },
    Setting {
        flag: "noise-threshold",
        letter: None,
        value_name: "E",
        help: "Stops each pixel whose error is below this share of its brightness, 0.02 say, so that the work goes \
               where the noise is; more than 0.2 counts as 0.2. Pixels that a lamp or mirror image may reach go on \
               until they can lose 2% of their brightness at most by not having met it. --samples is then the most \
               that a pixel gets",
        default: "0, none stops",
        role: Role::Estimator,
        key: None,
        access: Access::Single(field!(estimator.noise_threshold), [0.0, 1.0]),
    },
    Setting {
        flag: "seed",
        letter: None,
        value_name: "N",
        help: "Chooses other random points",
        default: "0",
        role: Role::Estimator,
        key: None,
        access: Access::Whole(field!(estimator.seed), [0, u32::MAX]),
    },
];

/// The setting that has this flag, for those of the program's parts that need a certain one.
pub fn setting(flag: &str) -> &'static Setting {
    SETTINGS.iter().find(|setting| setting.flag == flag).expect("the list has what the program asks for")
}
