//! The description of a setting: its names, its values, and its place in [`Settings`].

use super::Settings;
use crate::error::{Error, Result};
use crate::scene::{
    ApertureImage, Sensor, Tolerance, Typed, Unit, in_range, in_range_or_zero, linear_of_srgb, rounded,
};
use glam::DVec3;
use std::path::{Path, PathBuf};

/// A setting. The command line, scene files, saved pictures, the panel and the documentation use only this description.
pub struct Setting {
    /// The name of its option, without dashes.
    pub flag: &'static str,
    /// The letter of its option, if it has one.
    pub letter: Option<char>,
    /// The name of the value in the help. Empty if the help lists the choices instead.
    pub value_name: &'static str,
    /// What it does.
    pub help: &'static str,
    /// Its default value, in words. Empty if there is nothing to say.
    pub default: &'static str,
    /// What a change of the setting affects.
    pub role: Role,
    /// Its key in a scene file. A setting without a key says how a scene is sampled: scene files do not store it, and
    /// it stays as it is when another scene is opened. Or it says how a lone mesh is shown: then the scene file has the
    /// tables of the scene that is made around it.
    pub key: Option<Key>,
    /// How to read and write its value, and the range of the value.
    pub access: Access,
    /// Its row in the viewer's panel, if it has one.
    pub row: Option<Row>,
}

/// What a change of a setting affects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The integral that a pixel estimates. The film starts anew.
    Estimator,
    /// How a lone mesh is shown, and so the scene. The film starts anew.
    Model,
    /// How the film is shown.
    View,
    /// The number of samples in the film.
    Samples,
    /// The settings with these flags. An alias is another way to give them and has no value of its own. An alias for a
    /// single setting cannot be given together with that setting.
    Alias(&'static [&'static str]),
}

/// A key of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// The table of the key. Empty for the top of the file.
    pub table: &'static str,
    /// The name of the key.
    pub name: &'static str,
    /// Other keys that a file can use for the same setting. They are removed when this key is written.
    pub otherwise: &'static [&'static str],
    /// The flags of the settings that the value depends on if a file does not have this key.
    pub rests_on: &'static [&'static str],
}

/// How to read and write a value in [`Settings`].
pub struct Field<T> {
    /// Reads the value.
    pub get: fn(&Settings) -> T,
    /// Writes the value.
    pub set: fn(&mut Settings, T),
}

/// How to read and write the value of a setting, by its type, and the range of the value: the lowest and the highest.
pub enum Access {
    /// A number, and what it measures.
    Single(Field<f32>, [f32; 2], Unit),
    /// A number in double precision, and what it measures.
    Double(Field<f64>, [f64; 2], Unit),
    /// A whole number.
    Whole(Field<u32>, [u32; 2]),
    /// A whole number, or 0. The text says what 0 means.
    WholeOrZero(Field<u32>, [u32; 2], &'static str),
    /// Yes or no.
    Switch(Field<bool>),
    /// A position or a direction.
    Vector(Field<DVec3>, [f64; 2]),
    /// A colour: linear red, green and blue.
    Color(Field<DVec3>, [f64; 2]),
    /// A width and a height in pixels.
    Size(Field<[u32; 2]>, [u32; 2]),
    /// One of several choices, by its name.
    Choice(Field<&'static str>, fn() -> Vec<Choice>),
    /// An image file, or none.
    Image(Field<Option<ApertureImage>>),
    /// A length on the film or in the picture, which is as much blur as counts as sharp.
    Tolerance(Field<Tolerance>),
    /// The size of the film, by the name of a format or by its sides in millimetres.
    Sensor(Field<Sensor>),
}

/// One of the choices of a setting.
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    /// The name on the command line and in scene files.
    pub name: &'static str,
    /// The name in the panel.
    pub label: &'static str,
    /// What it does.
    pub help: &'static str,
}

/// A row of the viewer's panel.
pub struct Row {
    /// The part of the panel that has the row. The rows of a part are in the order of the list.
    pub part: Part,
    /// The name of the row.
    pub label: &'static str,
    /// The text of the tooltip.
    pub help: &'static str,
    /// Whether the row is shown: whether the setting has an effect with these settings.
    pub shown: fn(&Settings) -> bool,
    /// The control that changes the value.
    pub widget: Widget,
}

/// A part of the viewer's panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the parts of the panel")]
pub enum Part {
    Top,
    Points,
    Sharp,
    Camera,
    Lens,
    Aperture,
    Model,
    Movements,
    Viewpoint,
    Light,
    Sampling,
    View,
}

/// The control of a row.
pub enum Widget {
    /// A slider.
    Slider(Slider),
    /// A field for a colour.
    Color,
    /// A check box.
    Box,
    /// A check box that switches between two numbers.
    BoxOf {
        /// The number when the box is checked.
        ticked: f32,
        /// The number when it is not.
        plain: f32,
    },
    /// A drop-down list.
    List,
    /// Three numbers that can be dragged.
    Drag,
    /// A slider and a list of units.
    Length,
}

/// The range and the scale of a slider.
pub struct Slider {
    /// Both ends of the slider, given the settings that the scene was opened with.
    pub range: fn(&Settings) -> [f32; 2],
    /// Whether the scale is logarithmic.
    pub logarithmic: bool,
    /// The number of decimals to which the slider rounds, if it does.
    pub decimals: Option<i32>,
}

/// A value of a setting.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// For [`Access::Single`].
    Single(f32),
    /// For [`Access::Double`].
    Double(f64),
    /// For [`Access::Whole`] and [`Access::WholeOrZero`].
    Whole(u32),
    /// For [`Access::Switch`].
    Switch(bool),
    /// For [`Access::Vector`] and [`Access::Color`].
    Vector(DVec3),
    /// For [`Access::Size`].
    Size([u32; 2]),
    /// For [`Access::Choice`].
    Name(&'static str),
    /// For [`Access::Image`]: the file.
    File(Option<PathBuf>),
    /// For [`Access::Tolerance`].
    Tolerance(Tolerance),
    /// For [`Access::Sensor`].
    Sensor(Sensor),
    /// A length in metres, for a setting in scene units. No setting has it as its value: it becomes a length in scene
    /// units when it is set.
    Metres(f64),
}

/// Where the user gives a setting. This decides what an error calls it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Called {
    /// On the command line.
    Flag,
    /// In a scene file.
    Key,
    /// In the panel.
    Label,
}

/// The name that stands for no image and for no overlay.
pub(super) const NONE: &str = "none";

impl Setting {
    /// What the user calls the setting.
    pub fn name(&self, called: Called) -> String {
        match (called, &self.key, &self.row) {
            (Called::Key, Some(key), _) => key.name.into(),
            (Called::Label, _, Some(row)) => row.label.into(),
            _ => format!("--{}", self.flag),
        }
    }

    /// The value of the setting.
    pub fn get(&self, settings: &Settings) -> Value {
        match &self.access {
            Access::Single(field, ..) => Value::Single((field.get)(settings)),
            Access::Double(field, ..) => Value::Double((field.get)(settings)),
            Access::Whole(field, _) | Access::WholeOrZero(field, ..) => Value::Whole((field.get)(settings)),
            Access::Switch(field) => Value::Switch((field.get)(settings)),
            Access::Vector(field, _) | Access::Color(field, _) => Value::Vector((field.get)(settings)),
            Access::Size(field, _) => Value::Size((field.get)(settings)),
            Access::Choice(field, _) => Value::Name((field.get)(settings)),
            Access::Image(field) => Value::File((field.get)(settings).map(|image| image.file.clone())),
            Access::Tolerance(field) => Value::Tolerance((field.get)(settings)),
            Access::Sensor(field) => Value::Sensor((field.get)(settings)),
        }
    }

    /// Sets the value, which must have the type of the setting.
    ///
    /// # Errors
    /// The errors of reading an image.
    pub fn set(&self, settings: &mut Settings, value: &Value) -> Result<()> {
        match (&self.access, value) {
            (Access::Single(field, ..), Value::Single(value)) => (field.set)(settings, *value),
            (Access::Single(field, _, Unit::Length), Value::Metres(metres)) => {
                let units = metres / settings.estimator.camera.metres_per_unit;
                (field.set)(settings, units as f32);
            }
            (Access::Double(field, ..), Value::Double(value)) => (field.set)(settings, *value),
            (Access::Whole(field, _) | Access::WholeOrZero(field, ..), Value::Whole(value)) => {
                (field.set)(settings, *value);
            }
            (Access::Switch(field), Value::Switch(value)) => (field.set)(settings, *value),
            (Access::Vector(field, _) | Access::Color(field, _), Value::Vector(value)) => {
                (field.set)(settings, *value);
            }
            (Access::Size(field, _), Value::Size(value)) => (field.set)(settings, *value),
            (Access::Choice(field, _), Value::Name(value)) => (field.set)(settings, value),
            (Access::Image(field), Value::File(file)) => {
                let image = file.as_deref().map(ApertureImage::read).transpose()?;
                (field.set)(settings, image);
            }
            (Access::Tolerance(field), Value::Tolerance(value)) => (field.set)(settings, *value),
            (Access::Sensor(field), Value::Sensor(value)) => (field.set)(settings, *value),
            (_, other) => unreachable!("{} is never {other:?}", self.flag),
        }
        Ok(())
    }

    /// Checks that a value is in the range of the setting.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the name of the setting, the value and the range.
    pub fn check(&self, value: &Value, called: Called) -> Result<()> {
        let checked = match (&self.access, value) {
            (Access::Single(_, range, _), Value::Single(value)) => in_range(*value, *range),
            (Access::Double(_, range, _), Value::Double(value)) => in_range(*value, *range),
            (Access::Whole(_, range), Value::Whole(value)) => in_range(*value, *range),
            (Access::WholeOrZero(_, range, zero), Value::Whole(value)) => {
                in_range_or_zero(*value, *range, zero)
            }
            (Access::Vector(_, range) | Access::Color(_, range), Value::Vector(value)) => {
                value.to_array().into_iter().try_for_each(|part| in_range(part, *range))
            }
            (Access::Size(_, range), Value::Size([width, height])) => {
                let of = |what: &'static str| move |reason| format!("has a {what} that {reason}");
                in_range(*width, *range)
                    .map_err(of("width"))
                    .and_then(|()| in_range(*height, *range).map_err(of("height")))
            }
            (Access::Tolerance(_), Value::Tolerance(value)) => value.check(),
            (Access::Sensor(_), Value::Sensor(value)) => value.check(),
            _ => Ok(()),
        };
        checked.map_err(|reason| Error::OutOfRange(format!("{} {reason}", self.name(called))))
    }

    /// The value as a number. `None` if it is none.
    pub fn number(&self, settings: &Settings) -> Option<f64> {
        match self.get(settings) {
            Value::Single(number) => Some(number.into()),
            Value::Double(number) => Some(number),
            Value::Whole(number) => Some(number.into()),
            _ => None,
        }
    }

    /// Sets a value that is a number.
    pub fn set_number(&self, settings: &mut Settings, number: f64) {
        match &self.access {
            Access::Single(field, ..) => (field.set)(settings, number as f32),
            Access::Double(field, ..) => (field.set)(settings, number),
            Access::Whole(field, _) | Access::WholeOrZero(field, ..) => {
                (field.set)(settings, number.round() as u32);
            }
            _ => {}
        }
    }

    /// The value as the panel shows it beside its name, with its unit. Empty if it is no number.
    pub fn shown(&self, settings: &Settings) -> String {
        if let Value::Tolerance(tolerance) = self.get(settings) {
            return match tolerance {
                Tolerance::Film(mm) => format!("{} mm", rounded(mm.into(), 3)),
                Tolerance::Pixels(pixels) => format!("{} px", rounded(pixels.into(), 3)),
            };
        }
        if let (Access::Color(..), Value::Vector(color)) = (&self.access, self.get(settings)) {
            return hex(color);
        }
        let Some(number) = self.number(settings) else { return String::new() };
        match &self.access {
            Access::Single(_, _, unit) | Access::Double(_, _, unit) => {
                unit.shown(number, settings.estimator.camera.metres_per_unit)
            }
            _ => number.to_string(),
        }
    }

    /// Parses a value as it is typed, on the command line or in the panel.
    ///
    /// # Errors
    /// A sentence about how a value is written.
    pub fn parse(&self, text: &str) -> Result<Value, String> {
        let (value, right) = match &self.access {
            Access::Single(_, _, unit) => {
                // A plain number is rounded once, so that a saved picture gets back exactly what it had.
                if let Ok(number) = text.parse() {
                    return Ok(Value::Single(number));
                }
                return unit.read(text).map(|typed| match typed {
                    Typed::Number(number) => Value::Single(number as f32),
                    Typed::Metres(metres) => Value::Metres(metres),
                });
            }
            Access::Double(_, _, unit) => {
                return unit.read(text).map(|typed| match typed {
                    Typed::Number(number) | Typed::Metres(number) => Value::Double(number),
                });
            }
            Access::Whole(..) | Access::WholeOrZero(..) => {
                (text.trim().parse().ok().map(Value::Whole), "it is a whole number, 0 or more")
            }
            Access::Switch(_) => (text.parse().ok().map(Value::Switch), "it is true or false"),
            Access::Vector(..) => {
                (vector(text).map(Value::Vector), "a place or direction is X,Y,Z, such as 0,1.5,-10")
            }
            Access::Color(..) => (
                color(text).map(Value::Vector),
                "a colour is #RRGGBB, or R,G,B in linear light from 0 to 1, such as #c08040 or 0.53,0.22,0.05",
            ),
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
            Access::Tolerance(_) => return Ok(Value::Tolerance(text.parse()?)),
            Access::Sensor(_) => return Ok(Value::Sensor(text.parse()?)),
        };
        value.ok_or_else(|| right.into())
    }

    /// Whether the setting says how a scene is sampled, and so is not a part of the scene.
    pub fn is_of_sampling(&self) -> bool {
        self.key.is_none() && !self.is_of_model()
    }

    /// Whether the setting says how a lone mesh is shown. The scene is made anew when it changes.
    pub fn is_of_model(&self) -> bool {
        // An alias of such a setting has its row among theirs.
        self.role == Role::Model || self.row.as_ref().is_some_and(|row| row.part == Part::Model)
    }

    /// Whether the setting is another way to give other settings.
    pub fn is_alias(&self) -> bool {
        matches!(self.role, Role::Alias(_))
    }
}

/// The file that a name on the command line stands for.
pub(super) fn file(path: &Path) -> Value {
    Value::File((path.as_os_str() != NONE).then(|| path.to_path_buf()))
}

fn vector(text: &str) -> Option<DVec3> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok()).map(DVec3::from_array)
}

/// A colour in linear light, from its sRGB code or its channels.
fn color(text: &str) -> Option<DVec3> {
    let Some(digits) = text.trim().strip_prefix('#') else { return vector(text) };
    let code = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6)?;
    let channel = |shift: u32| to_linear(f64::from(code >> shift & 0xff) / 255.0);
    Some(DVec3::new(channel(16), channel(8), channel(0)))
}

/// The sRGB code of a colour in linear light.
fn hex(color: DVec3) -> String {
    let [red, green, blue] = color.to_array().map(|channel| (255.0 * to_srgb(channel)).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A channel of sRGB in linear light, with as few digits as tell apart any two of its 256 levels.
pub fn to_linear(level: f64) -> f64 {
    let linear = linear_of_srgb(level);
    (1e5 * linear).round() / 1e5
}

/// A channel of linear light in sRGB, clipped to [0, 1]: IEC 61966-2-1.
pub fn to_srgb(linear: f64) -> f64 {
    let level = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    level.clamp(0.0, 1.0)
}

/// A width and a height.
pub fn size(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once(['x', 'X'])?;
    Some([width.parse().ok()?, height.parse().ok()?])
}
