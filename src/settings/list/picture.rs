//! The size of the picture, and how it is sampled.

use super::{EVEN, LOGARITHMIC, by_name, field, row, top};
use crate::scene::{Integrator, MAX_BOUNCES, MAX_EXTENT};
use crate::settings::{
    Access, Choice, DEFAULT_JITTER, JITTERS, MAX_SAMPLES, Part, Role, Sampler, Setting, Slider, Unit, Widget,
    name_of, named,
};

/// The largest number that a half float holds.
const MAX_CLAMP: f32 = 65504.0;

/// The slider for points per pixel ends here, or at the number that the viewer was started with.
const MAX_SLIDER_SAMPLES: u32 = 4096;

/// The size of the picture, and the number of samples.
pub(super) static PICTURE: &[Setting] = &[
    Setting {
        flag: "size",
        letter: Some('s'),
        value_name: "WxH",
        help: "The size of the picture in pixels. The view keeps its height, and gains or loses at the sides",
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
        help: "Antialiasing points per pixel: more points give less noise",
        default: "64, in the viewer 256",
        role: Role::Samples,
        key: None,
        access: Access::Whole(field!(samples), [1, MAX_SAMPLES]),
        row: row(
            Part::Points,
            "Points per pixel",
            "The number of rays that are averaged in each pixel, each through another point of the pixel and of the lens: more points give less noise and smoother edges (anti-aliasing). If you raise it, the picture continues with the rays that it has.",
            Widget::Slider(Slider {
                range: |initial| [1.0, MAX_SLIDER_SAMPLES.max(initial.samples) as f32],
                ..LOGARITHMIC
            }),
        ),
    },
];

/// How the picture is sampled.
pub(super) static SAMPLING: &[Setting] = &[
    Setting {
        flag: "jitter",
        letter: None,
        value_name: "PX",
        help: "The width of the square around a pixel's centre that its samples fall in, in pixels. 1 is the area of \
               the pixel, 0 gives one centre ray per pixel, and values up to 15 reach into the neighbours",
        default: "1",
        role: Role::Estimator,
        key: None,
        access: Access::Single(field!(estimator.jitter), JITTERS, Unit::Pixels),
        row: row(
            Part::Sampling,
            "No anti-aliasing",
            "All rays of a pixel go through the same point of the focal plane, that of the ray through the pixel's centre. Edges in that plane become jagged, and blur stays as it is.",
            Widget::BoxOf { ticked: 0.0, plain: DEFAULT_JITTER },
        ),
    },
    Setting {
        flag: "integrator",
        letter: None,
        value_name: "",
        help: "What finds the light along a ray. whitted is that of Suffern's book: lights without extent, hard shadows, \
               ambient light and mirrors. path follows light from lamps and the sky, by any number of reflections",
        default: "the scene's",
        role: Role::Estimator,
        key: top("integrator"),
        access: Access::Choice(by_name!(Integrator::NAMES, estimator.integrator), || {
            Integrator::NAMES.map(|(name, _)| Choice { name, label: name, help: "" }).to_vec()
        }),
        row: row(
            Part::Sampling,
            "Light",
            "What finds the light along a ray: whitted as in Suffern's book, with hard shadows and mirrors; path with any number of reflections. Most scenes are made for one of them.",
            Widget::List,
        ),
    },
    Setting {
        flag: "max-bounces",
        letter: None,
        value_name: "N",
        help: "How often light is scattered on its way to the lens, up to 64. whitted counts mirrors only",
        default: "the scene's",
        role: Role::Estimator,
        key: top("max_bounces"),
        access: Access::Whole(field!(estimator.max_bounces), [0, MAX_BOUNCES]),
        row: row(
            Part::Sampling,
            "Bounces",
            "How often light is scattered on its way to the lens: more bounces brighten corners, glass and mirrors in mirrors, and take longer. With whitted, only mirrors count.",
            Widget::Slider(Slider { range: |_| [0.0, MAX_BOUNCES as f32], ..EVEN }),
        ),
    },
    Setting {
        flag: "diffuse-bounces",
        letter: None,
        value_name: "N",
        help: "How often path lets light be scattered by surfaces that spread it: all but smooth mirrors, metals and glass. \
               1 is direct light alone",
        default: "64",
        role: Role::Estimator,
        key: None,
        access: Access::Whole(field!(estimator.diffuse_bounces), [0, MAX_BOUNCES]),
        row: None,
    },
    Setting {
        flag: "clamp",
        letter: None,
        value_name: "L",
        help: "The most luminance that path finds after the first surface, in each sample; 0 for no limit. It takes bright \
               dots (fireflies) out of pictures of few samples. The picture is then biased: it lacks the light that is cut off",
        default: "0",
        role: Role::Estimator,
        key: None,
        access: Access::Single(field!(estimator.clamp), [0.0, MAX_CLAMP], Unit::Plain),
        row: row(
            Part::Sampling,
            "Clamp",
            "With path, the most luminance that a ray can find after its first surface; 0 for no limit. It takes bright dots out of the picture, and with them light: the picture is biased.",
            Widget::Slider(Slider { range: |_| [0.0, 20.0], decimals: Some(1), ..EVEN }),
        ),
    },
    Setting {
        flag: "sampler",
        letter: None,
        value_name: "",
        help: "How the points are chosen. sobol spreads the points of a pixel evenly, blue-noise also makes the errors \
               of neighbouring pixels cancel out, and random does neither",
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
        help: "A pixel stops once its error is below this fraction of its brightness, for example 0.02, so that the work \
               goes where the noise is. More than 0.2 counts as 0.2. A pixel that a lamp or a mirror image may reach \
               continues until it can lose at most 2% of its brightness by having missed it. --samples is then the \
               largest number of samples for a pixel",
        default: "0, none stops",
        role: Role::Estimator,
        key: None,
        access: Access::Single(field!(estimator.noise_threshold), [0.0, 1.0], Unit::Fraction),
        row: row(
            Part::Sampling,
            "Noise threshold",
            "A pixel stops once its error is below this fraction of its brightness, so that the work goes where the noise is. At 0, no pixel stops.",
            Widget::Slider(Slider { range: |_| [0.0, 0.2], decimals: Some(3), ..EVEN }),
        ),
    },
    Setting {
        flag: "seed",
        letter: None,
        value_name: "N",
        help: "A number that chooses other random points",
        default: "0",
        role: Role::Estimator,
        key: None,
        access: Access::Whole(field!(estimator.seed), [0, u32::MAX]),
        row: None,
    },
];
