//! How large the picture is, and how it is sampled.

use super::{EVEN, LOGARITHMIC, by_name, field, row, top};
use crate::scene::{MAX_BOUNCES, MAX_EXTENT};
use crate::settings::{
    Access, Choice, DEFAULT_JITTER, JITTERS, MAX_SAMPLES, Part, Role, Sampler, Setting, Slider, Widget,
    name_of, named,
};

/// The slider of the points goes this far, or as far as was asked for.
const MOST_POINTS: u32 = 4096;

/// Its size, and how many samples it gets.
pub(super) static PICTURE: &[Setting] = &[
    Setting {
        flag: "size",
        letter: Some('s'),
        value_name: "WxH",
        help: "Picture size in pixels; the view keeps its height and gains or loses at the sides",
        default: "the scene's, in the viewer the window's",
        role: Role::Estimator,
        key: top("size"),
        access: Access::Size(field!(estimator.size), [1, MAX_EXTENT]),
        row: None,
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
        row: row(
            Part::Points,
            "Anti-aliasing points per pixel",
            "How many rays are averaged in each pixel: more give less noise. Raising it goes on from what is there.",
            Widget::Slider(Slider {
                range: |initial| [1.0, MOST_POINTS.max(initial.samples) as f32],
                format: |_| "%d".into(),
                ..LOGARITHMIC
            }),
        ),
    },
];

/// How the samples are chosen.
pub(super) static SAMPLING: &[Setting] = &[
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
        row: row(
            Part::Sampling,
            "One centre ray per pixel",
            "All rays of a pixel aim at one point in focus: edges in the focal plane turn jagged, blur stays.",
            Widget::BoxOf { ticked: 0.0, plain: DEFAULT_JITTER },
        ),
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
        row: None,
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
        access: Access::Choice(by_name!(Sampler::NAMES, estimator.sampler), || {
            Sampler::NAMES.map(|(name, _)| Choice { name, label: name, help: "" }).to_vec()
        }),
        row: None,
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
        row: row(
            Part::Sampling,
            "Noise threshold",
            "A pixel stops once its error is below this share of its brightness, and the work goes where the noise is. 0: none stops.",
            Widget::Slider(Slider {
                range: |_| [0.0, 0.2],
                format: |share| if share > 0.0 { "%.3f".into() } else { "off".into() },
                ..EVEN
            }),
        ),
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
        row: None,
    },
];
