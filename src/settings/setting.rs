//! What a setting is: how it is called, what it may be, and where its value stands.

use super::Settings;
use crate::error::{Error, Result};
use crate::scene::{ApertureImage, in_range, in_range_or_zero};
use glam::DVec3;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// One setting. Command line, scene files, pictures, the panel and the documentation know of it by this alone.
pub struct Setting {
    /// Its option's name, without dashes.
    pub flag: &'static str,
    /// Its option's letter, if it has one.
    pub letter: Option<char>,
    /// What the help calls the option's value. Empty where the names of the choices stand there.
    pub value_name: &'static str,
    /// What it does.
    pub help: &'static str,
    /// What it is unless it is given, in words; empty where that goes without saying.
    pub default: &'static str,
    /// What a change of it changes.
    pub role: Role,
    /// Its key in a scene file. Where it has none, it says how a scene is sampled: then scene files do not carry
    /// it, and it stays when another scene is opened.
    pub key: Option<Key>,
    /// Where its value stands, and what it may be.
    pub access: Access,
    /// Its row of the viewer's panel, if it has one.
    pub row: Option<Row>,
}

/// What a change of a setting changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The integral that a pixel estimates: the film starts anew.
    Estimator,
    /// How the film is shown.
    View,
    /// How many samples the film gets.
    Samples,
    /// The settings with these flags: it is another way to give them and has no value of its own. One that stands
    /// for a single setting cannot be given beside it.
    Alias(&'static [&'static str]),
}

/// A key of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// Its table; empty for the top of the file.
    pub table: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Other keys by which a file can give it. They go where it is written.
    pub otherwise: &'static [&'static str],
    /// The flags of settings on which it depends where a file does not have the key itself.
    pub rests_on: &'static [&'static str],
}

/// Where a value stands.
pub struct Field<T> {
    /// Gives it.
    pub get: fn(&Settings) -> T,
    /// Changes it.
    pub set: fn(&mut Settings, T),
}

/// Where the value of a setting stands, by its kind, and the range that it has to lie in: lowest and highest.
pub enum Access {
    /// A number.
    Single(Field<f32>, [f32; 2]),
    /// A number with twice the digits.
    Double(Field<f64>, [f64; 2]),
    /// A time in seconds, which can also be given as a fraction.
    Seconds(Field<f32>, [f32; 2]),
    /// A whole number.
    Whole(Field<u32>, [u32; 2]),
    /// A whole number, or 0, which means what the text says.
    WholeOrZero(Field<u32>, [u32; 2], &'static str),
    /// Yes or no.
    Switch(Field<bool>),
    /// A place or direction.
    Vector(Field<DVec3>, [f64; 2]),
    /// A width and a height, in pixels.
    Size(Field<[u32; 2]>, [u32; 2]),
    /// One of several, by its name.
    Choice(Field<&'static str>, fn() -> Vec<Choice>),
    /// An image in a file, or none.
    Image(Field<Option<ApertureImage>>),
}

/// One of several things that a setting can be.
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    /// What it is called on the command line and in scene files.
    pub name: &'static str,
    /// What it is called in the panel.
    pub label: &'static str,
    /// What it does.
    pub help: &'static str,
}

/// A row of the viewer's panel.
pub struct Row {
    /// The part of the panel where it stands. The rows of a part stand in the order of the list.
    pub part: Part,
    /// What it is called.
    pub label: &'static str,
    /// What its tooltip says.
    pub help: &'static str,
    /// Whether it does anything now; else it is not shown.
    pub shown: fn(&Settings) -> bool,
    /// How its value is changed.
    pub widget: Widget,
}

/// A part of the viewer's panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are called as the parts of the panel are")]
pub enum Part {
    Top,
    Points,
    Model,
    Lens,
    Aperture,
    Viewpoint,
    Light,
    Sampling,
    View,
}

/// How a row changes a value.
pub enum Widget {
    /// A slider.
    Slider(Slider),
    /// A box with a tick for yes.
    Box,
    /// A box with a tick for one number, and without one for another.
    BoxOf {
        /// With a tick.
        ticked: f32,
        /// Without.
        plain: f32,
    },
    /// A list that folds out.
    List,
    /// Three numbers that are dragged.
    Drag,
}

/// How a slider goes over its values.
pub struct Slider {
    /// From where to where, for a scene that has these settings of its own.
    pub range: fn(&Settings) -> [f32; 2],
    /// How a value is shown, in the language of C's `printf`.
    pub format: fn(f32) -> Cow<'static, str>,
    /// Whether equal ways are equal ratios, not equal differences.
    pub logarithmic: bool,
    /// Whether a value becomes what is shown of it, with no more digits.
    pub rounds: bool,
}

/// What a setting is, or is to be.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Of [`Access::Single`] and [`Access::Seconds`].
    Single(f32),
    /// Of [`Access::Double`].
    Double(f64),
    /// Of [`Access::Whole`] and [`Access::WholeOrZero`].
    Whole(u32),
    /// Of [`Access::Switch`].
    Switch(bool),
    /// Of [`Access::Vector`].
    Vector(DVec3),
    /// Of [`Access::Size`].
    Size([u32; 2]),
    /// Of [`Access::Choice`].
    Name(&'static str),
    /// Of [`Access::Image`]: its file.
    File(Option<PathBuf>),
}

/// Where a user gives a setting, and so what an error calls it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Called {
    /// On the command line.
    Flag,
    /// In a scene file.
    Key,
    /// In the panel.
    Label,
}

/// What is given in place of a name where none is wanted.
pub(super) const NONE: &str = "none";

impl Setting {
    /// What the user calls it.
    pub fn name(&self, called: Called) -> String {
        match (called, &self.key, &self.row) {
            (Called::Key, Some(key), _) => key.name.into(),
            (Called::Label, _, Some(row)) => row.label.into(),
            _ => format!("--{}", self.flag),
        }
    }

    /// Its value.
    pub fn get(&self, settings: &Settings) -> Value {
        match &self.access {
            Access::Single(field, _) | Access::Seconds(field, _) => Value::Single((field.get)(settings)),
            Access::Double(field, _) => Value::Double((field.get)(settings)),
            Access::Whole(field, _) | Access::WholeOrZero(field, ..) => Value::Whole((field.get)(settings)),
            Access::Switch(field) => Value::Switch((field.get)(settings)),
            Access::Vector(field, _) => Value::Vector((field.get)(settings)),
            Access::Size(field, _) => Value::Size((field.get)(settings)),
            Access::Choice(field, _) => Value::Name((field.get)(settings)),
            Access::Image(field) => Value::File((field.get)(settings).map(|image| image.file.clone())),
        }
    }

    /// Gives it a value of its kind.
    ///
    /// # Errors
    /// Of an image.
    pub fn set(&self, settings: &mut Settings, value: &Value) -> Result<()> {
        match (&self.access, value) {
            (Access::Single(field, _) | Access::Seconds(field, _), Value::Single(value)) => {
                (field.set)(settings, *value);
            }
            (Access::Double(field, _), Value::Double(value)) => (field.set)(settings, *value),
            (Access::Whole(field, _) | Access::WholeOrZero(field, ..), Value::Whole(value)) => {
                (field.set)(settings, *value);
            }
            (Access::Switch(field), Value::Switch(value)) => (field.set)(settings, *value),
            (Access::Vector(field, _), Value::Vector(value)) => (field.set)(settings, *value),
            (Access::Size(field, _), Value::Size(value)) => (field.set)(settings, *value),
            (Access::Choice(field, _), Value::Name(value)) => (field.set)(settings, value),
            (Access::Image(field), Value::File(file)) => {
                let image = file.as_deref().map(ApertureImage::read).transpose()?;
                (field.set)(settings, image);
            }
            (_, other) => unreachable!("{} is never {other:?}", self.flag),
        }
        Ok(())
    }

    /// Holds a value against the setting's range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], with what the user calls it, the value and the range.
    pub fn check(&self, value: &Value, called: Called) -> Result<()> {
        let checked = match (&self.access, value) {
            (Access::Single(_, range) | Access::Seconds(_, range), Value::Single(value)) => {
                in_range(*value, *range)
            }
            (Access::Double(_, range), Value::Double(value)) => in_range(*value, *range),
            (Access::Whole(_, range), Value::Whole(value)) => in_range(*value, *range),
            (Access::WholeOrZero(_, range, zero), Value::Whole(value)) => {
                in_range_or_zero(*value, *range, zero)
            }
            (Access::Vector(_, range), Value::Vector(value)) => {
                value.to_array().into_iter().try_for_each(|part| in_range(part, *range))
            }
            (Access::Size(_, range), Value::Size([width, height])) => {
                let of = |what: &'static str| move |reason| format!("has a {what} that {reason}");
                in_range(*width, *range)
                    .map_err(of("width"))
                    .and_then(|()| in_range(*height, *range).map_err(of("height")))
            }
            _ => Ok(()),
        };
        checked.map_err(|reason| Error::OutOfRange(format!("{} {reason}", self.name(called))))
    }

    /// A value of its kind from a text of the command line.
    ///
    /// # Errors
    /// What would be right.
    pub fn parse(&self, text: &str) -> Result<Value, String> {
        let (value, right) = match &self.access {
            Access::Single(..) => {
                (text.parse().ok().map(Value::Single), "a number is written like 0.5, -2 or 1e-3")
            }
            Access::Double(..) => {
                (text.parse().ok().map(Value::Double), "a number is written like 0.5, -2 or 1e-3")
            }
            Access::Seconds(..) => {
                (seconds(text).map(Value::Single), "a shutter time is in seconds, such as 0.01 or 1/100")
            }
            Access::Whole(..) | Access::WholeOrZero(..) => {
                (text.parse().ok().map(Value::Whole), "it is a whole number, 0 or more")
            }
            Access::Switch(_) => (text.parse().ok().map(Value::Switch), "it is true or false"),
            Access::Vector(..) => {
                (vector(text).map(Value::Vector), "a place or direction is X,Y,Z, such as 0,1.5,-10")
            }
            Access::Size(..) => {
                (size(text).map(Value::Size), "a size is WIDTHxHEIGHT in pixels, such as 1280x720")
            }
            Access::Choice(_, choices) => (
                choices()
                    .into_iter()
                    .find(|choice| choice.name == text)
                    .map(|choice| Value::Name(choice.name)),
                "there is none of this name",
            ),
            Access::Image(_) => (Some(file(Path::new(text))), ""),
        };
        value.ok_or_else(|| right.into())
    }

    /// Whether it says how a scene is sampled, which is no part of a scene.
    pub fn is_of_sampling(&self) -> bool {
        self.key.is_none()
    }

    /// Whether it is another way to give other settings.
    pub fn is_alias(&self) -> bool {
        matches!(self.role, Role::Alias(_))
    }
}

/// What a file's name on the command line stands for.
pub(super) fn file(path: &Path) -> Value {
    Value::File((path.as_os_str() != NONE).then(|| path.to_path_buf()))
}

fn vector(text: &str) -> Option<DVec3> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    numbers.ok().and_then(|numbers| <[f64; 3]>::try_from(numbers).ok()).map(DVec3::from_array)
}

fn seconds(text: &str) -> Option<f32> {
    match text.split_once('/') {
        Some((over, under)) => over.parse().ok().zip(under.parse().ok()).map(|(a, b): (f32, f32)| a / b),
        None => text.parse().ok(),
    }
}

/// A width and a height.
pub fn size(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once(['x', 'X'])?;
    Some([width.parse().ok()?, height.parse().ok()?])
}
