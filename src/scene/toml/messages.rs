//! Error messages about the text of a scene file, in the terms of the format. The crates that parse TOML and fill
//! structs speak only of maps, sequences and fields.

use super::error::ParseError;
use super::quantity::unit_of;
use crate::scene::light::LIGHT_NAMES;
use crate::scene::material::MATERIAL_NAMES;
use crate::scene::shape::SHAPE_NAMES;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// How a table of the scene is written.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// `[camera]`, once.
    One,
    /// `[[sphere]]`, once for each sphere.
    Many,
    /// `[matte.NAME]`.
    Named,
    /// `size = ...`, which is not a table.
    Value,
}

/// The names at the top level of a file, without those of lights, materials and shapes.
const TOP: [(&str, Form); 8] = [
    ("size", Form::Value),
    ("integrator", Form::Value),
    ("max_bounces", Form::Value),
    ("camera", Form::One),
    ("view", Form::One),
    ("background", Form::One),
    ("ambient", Form::One),
    ("mesh", Form::Many),
];

/// The names at the top level of a file.
fn top() -> impl Iterator<Item = (&'static str, Form)> {
    let kinds = [(LIGHT_NAMES, Form::Many), (MATERIAL_NAMES, Form::Named), (SHAPE_NAMES, Form::Many)];
    let named = |(names, form): (&'static [&'static str], Form)| names.iter().map(move |name| (*name, form));
    let kinds = kinds.into_iter().flat_map(named);
    TOP.into_iter().chain(kinds.map(|(name, form)| (name.trim_start_matches("r#"), form)))
}

/// Reads a text into the structs of the format.
pub(super) fn read<'de, T: Deserialize<'de>>(text: &'de str) -> Result<T, ParseError> {
    let (document, errors) = DeTable::parse_recoverable(text);
    let wrong_table = wrong_table(document.get_ref());
    if let Some(error) = errors.first() {
        // A second table with the same name may mean that both should be written as [[name]], which is the better
        // message.
        let repeated = error.message().starts_with("duplicate key");
        return Err(wrong_table.filter(|_| repeated).unwrap_or_else(|| not_toml(text, error)));
    }
    if let Some(error) = wrong_table {
        return Err(error);
    }
    let tables = T::deserialize(toml::de::Deserializer::from(document));
    tables.map_err(|error| not_a_scene(text, &error))
}

fn form_of(name: &str) -> Option<Form> {
    top().find(|(known, _)| *known == name).map(|(_, form)| form)
}

/// The header of a table, with its brackets.
fn header(name: &str) -> String {
    match form_of(name) {
        Some(Form::Many) => format!("[[{name}]]"),
        Some(Form::Named) => format!("[{name}.NAME]"),
        Some(Form::Value) => format!("{name} = ..."),
        Some(Form::One) | None => format!("[{name}]"),
    }
}

/// An error for the first table that has an unknown name or the wrong brackets.
fn wrong_table(document: &DeTable<'_>) -> Option<ParseError> {
    let errors = document.iter().filter_map(|(key, value)| {
        let name = key.get_ref().as_ref();
        let (span, message) = match form_of(name) {
            None => (key.span(), unknown_table(name, value.get_ref())),
            Some(form) => {
                table_error(name, form, value).map(|(span, message)| (span.unwrap_or(key.span()), message))?
            }
        };
        Some(ParseError { span, message })
    });
    errors.min_by_key(|error| error.span.start)
}

/// What is wrong with a table. The place is `None` if it is the name of the table.
fn table_error(
    name: &str,
    form: Form,
    value: &Spanned<DeValue<'_>>,
) -> Option<(Option<std::ops::Range<usize>>, String)> {
    let right = header(name);
    let is_table = value.get_ref().is_table();
    let whole = |message: String| Some((None, message));
    match (form, value.get_ref()) {
        (Form::Value, _) => None,
        (Form::One, _) if is_table => None,
        (Form::One, DeValue::Array(_)) => {
            whole(format!("write {right}, with one pair of brackets, for there is one {name}"))
        }
        (Form::Many, DeValue::Array(list)) => {
            let other = list.iter().find(|element| !element.get_ref().is_table())?;
            Some((Some(other.span()), format!("each {name} is a table; write {right} above its keys")))
        }
        (Form::Many, DeValue::Table(_)) => {
            whole(format!("write {right}, with two pairs of brackets, for there can be many of them"))
        }
        (Form::Named, DeValue::Table(named)) => {
            let is_list = |value: &DeValue<'_>| {
                value
                    .as_array()
                    .is_some_and(|list| list.first().is_some_and(|first| first.get_ref().is_table()))
            };
            if named.values().any(|value| !value.get_ref().is_table() && !is_list(value.get_ref())) {
                return whole(format!("write {right}, for a material needs a name that shapes call it by"));
            }
            named.iter().find_map(|(key, material)| match material.get_ref() {
                DeValue::Table(keys) => checker_error(keys),
                _ => Some((
                    Some(key.span()),
                    format!(
                        "write [{name}.{}], with one pair of brackets, for a name stands for one material",
                        key.get_ref()
                    ),
                )),
            })
        }
        (Form::Named, DeValue::Array(_)) => {
            whole(format!("write {right}, with one pair of brackets, in which the material's name stands"))
        }
        _ => whole(format!("{name} is a table; write {right} above its keys")),
    }
}

/// An error for a colour that is a list of lists. serde would read such a list as the table of a checker.
fn checker_error(keys: &DeTable<'_>) -> Option<(Option<std::ops::Range<usize>>, String)> {
    let color = keys.iter().find(|(key, _)| key.get_ref() == "color").map(|(_, value)| value)?;
    let list = color.get_ref().as_array()?;
    list.iter()
        .any(|part| part.get_ref().is_array())
        .then(|| (Some(color.span()), format!("color must be {COLOR_OR_CHECKER}")))
}

fn unknown_table(name: &str, value: &DeValue<'_>) -> String {
    // For example [scene.sphere].
    let inner = match value {
        DeValue::Table(table) => Some(table),
        DeValue::Array(list) => list.first().and_then(|first| first.get_ref().as_table()),
        _ => None,
    };
    let inner = inner.and_then(|table| table.iter().find(|(key, _)| form_of(key.get_ref()).is_some()));
    if let Some((key, _)) = inner {
        return format!("there is no {name} to put tables into; write {}", header(key.get_ref()));
    }
    let near = |known: &str| strsim::jaro_winkler(&known.to_lowercase(), &name.to_lowercase()) > 0.8;
    if let Some((near, _)) = top().find(|(known, _)| near(known)) {
        return format!("there is no '{name}'; did you mean {}?", header(near));
    }
    let known: Vec<String> = top().map(|(known, _)| header(known)).collect();
    format!("there is no '{name}'; there are: {}", known.join(", "))
}

const THREE_NUMBERS: &str = "three numbers, [x, y, z]";
const COLOR: &str = "a colour, three numbers [r, g, b]";
const COLOR_OR_CHECKER: &str = "[r, g, b], or { even = [r, g, b], odd = [r, g, b], size = EDGE }";

const METAL_COLOR: &str =
    "a name such as \"gold\", [r, g, b], or { even = [r, g, b], odd = [r, g, b], size = EDGE }";

/// The kind of value that a key takes.
fn value_of(table: Option<&str>, key: &str) -> String {
    let known = match (table, key) {
        (None, "size") => "[width, height], two whole numbers of pixels",
        (Some("matte" | "phong" | "plastic" | "standard"), "color") => COLOR_OR_CHECKER,
        (Some("metal"), "color") => METAL_COLOR,
        (_, "color" | "horizon" | "zenith" | "even" | "odd") => COLOR,
        (
            _,
            "eye" | "look_at" | "up" | "center" | "velocity" | "lower" | "upper" | "start" | "end" | "point"
            | "normal" | "position" | "direction" | "rotate_degrees" | "corner",
        ) => THREE_NUMBERS,
        (_, "vertices") => "three corners, [[x, y, z], [x, y, z], [x, y, z]]",
        (_, "edges") => "two edges, [[x, y, z], [x, y, z]]",
        (
            _,
            "integrator" | "material" | "file" | "image" | "preset" | "sensor" | "model" | "overlay"
            | "aperture_image",
        ) => "a name in quotes, such as \"name\"",
        (_, "tolerance") => "a text like \"0.03 mm\", or a number of pixels",
        (_, "shadows" | "upright" | "focus_breathing" | "exposure_lock") => "true or false, without quotes",
        (_, "blades" | "max_bounces" | "abbe_number") => "a whole number, 0 or more",
        _ => match unit_of(key).filter(|_| table.is_some_and(takes_text)) {
            Some(unit) => return format!("a number, or a text in quotes: {}", unit.right()),
            None => "a number",
        },
    };
    known.into()
}

/// Whether the numbers of a table can also be texts with a unit.
fn takes_text(table: &str) -> bool {
    ["camera", "view"].contains(&table)
}

/// A description of a value.
fn kind_of(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("the text \"{text}\""),
        DeValue::Integer(number) => format!("the number {}", number.as_str()),
        DeValue::Float(number) => format!("the number {}", number.as_str()),
        DeValue::Boolean(value) => value.to_string(),
        DeValue::Datetime(_) => "a date or a time".into(),
        DeValue::Array(list) => match list.len() {
            0 => "an empty list".into(),
            1 => "a list of one".into(),
            length => format!("a list of {length}"),
        },
        DeValue::Table(_) => "a table".into(),
    }
}

/// A place in the text: the tables and keys that lead to it, and its value.
struct Place<'a> {
    keys: Vec<&'a str>,
    value: Option<&'a DeValue<'a>>,
}

/// The innermost key or value at a position in the text.
fn place<'a>(table: &'a DeTable<'a>, at: usize) -> Option<Place<'a>> {
    table.iter().find_map(|(key, value)| {
        let here = || Place { keys: Vec::new(), value: Some(value.get_ref()) };
        let inner = place_in(value, at).or_else(|| key.span().contains(&at).then(here))?;
        Some(Place { keys: [vec![key.get_ref().as_ref()], inner.keys].concat(), ..inner })
    })
}

fn place_in<'a>(value: &'a Spanned<DeValue<'a>>, at: usize) -> Option<Place<'a>> {
    let inner = match value.get_ref() {
        DeValue::Table(table) => place(table, at),
        DeValue::Array(list) => list.iter().find_map(|element| place_in(element, at)),
        _ => None,
    };
    let here = || Place { keys: Vec::new(), value: Some(value.get_ref()) };
    inner.or_else(|| value.span().contains(&at).then(here))
}

/// An error for a text that is TOML, but does not fit the structs of the format.
fn not_a_scene(text: &str, error: &toml::de::Error) -> ParseError {
    let span = error.span().unwrap_or(0..0);
    let (document, _) = DeTable::parse_recoverable(text);
    let Place { keys, value } =
        place(document.get_ref(), span.start).unwrap_or(Place { keys: Vec::new(), value: None });
    let message = error.message();
    let mut quoted = message.split('`').skip(1).step_by(2);
    let message = if message.starts_with("missing field") {
        let key = quoted.next().unwrap_or_default();
        match keys.first() {
            Some(table) => format!("{} needs {key}, {}", titled(&keys), value_of(Some(table), key)),
            None => format!("the scene needs {}", header(key)),
        }
    } else if message.starts_with("unknown field") {
        let key = quoted.next().unwrap_or_default();
        let known: Vec<&str> = quoted.collect();
        let near = known.iter().find(|known| strsim::jaro_winkler(known, key) > 0.8);
        let hint = near
            .map_or_else(|| format!("it has: {}", known.join(", ")), |near| format!("did you mean {near}?"));
        // The last of the keys is the unknown key itself.
        format!("{} has no key {key}; {hint}", titled(&keys[..keys.len().saturating_sub(1)]))
    } else if message.starts_with("invalid") || message.contains("overflow") {
        let key = keys.last().copied().unwrap_or_default();
        let table = keys.first().copied().filter(|_| keys.len() > 1);
        let found = value.map_or_else(String::new, |value| format!("; here is {}", kind_of(value)));
        format!("{key} must be {}{found}", value_of(table, key))
    } else {
        // The message is about a number that is out of its range.
        let key = keys.last().filter(|_| message.starts_with("is "));
        let words = message.replace('\n', "; ");
        key.map_or(words.clone(), |key| format!("{key} {words}"))
    };
    ParseError { span, message }
}

/// The name of a table for messages: its header.
fn titled(keys: &[&str]) -> String {
    match keys {
        [] => "the scene".into(),
        [table] => header(table),
        [kind, name, inner @ ..] if form_of(kind) == Some(Form::Named) => match inner.last() {
            None => format!("[{kind}.{name}]"),
            Some(key) => (*key).into(),
        },
        [.., key] => (*key).into(),
    }
}

/// An error for a text that is not TOML.
fn not_toml(text: &str, error: &toml::de::Error) -> ParseError {
    let message = error.message();
    if message.contains("recurs") {
        // The error has no place, so the message points to the line that nests deepest.
        let depth = |line: &str| line.matches(['.', '[', '{']).count();
        let deepest = text.split_inclusive('\n').scan(0, |end, line| {
            *end += line.len();
            Some((depth(line), *end - line.len()))
        });
        // The first of the deepest lines is chosen.
        let at =
            deepest.reduce(|best, line| if line.0 > best.0 { line } else { best }).map_or(0, |line| line.1);
        let message = "tables or lists are nested too deep here; a scene nests three deep at most".into();
        return ParseError { span: at..at, message };
    }
    let span = error.span().unwrap_or(0..0);
    let (end, word) = word_at(text, span.start);
    let numeric = |first: char| first.is_ascii_digit() || "+-.".contains(first);
    let is_number = word.starts_with(numeric);
    // TOML allows a space between a date and a time, so its parser does not report a missing comma between two numbers.
    let next = text[end..].trim_start_matches([' ', '\t']);
    let two_numbers = is_number && next.len() < text.len() - end && next.starts_with(numeric);
    let message = match message {
        _ if message.starts_with("duplicate key") => {
            format!("'{word}' is here for the second time; leave one of them out")
        }
        _ if message.starts_with("missing comma") || two_numbers => {
            "here a comma is missing between two parts of a list, or the bracket at its end".into()
        }
        _ if message.starts_with("key with no value") || message.starts_with("missing assignment") => {
            "a line is a table's header, or a key, = and its value, or a comment after #".into()
        }
        _ if message.starts_with("string values must be quoted") && word.is_empty() => {
            "here a value is missing".into()
        }
        _ if is_number => {
            let quoted = format!("; a number with a unit or a fraction stands in quotes: \"{word}\"");
            let quoted = Some(quoted).filter(|_| table_at(text, span.start).is_some_and(takes_text));
            let quoted = quoted.unwrap_or_default();
            format!("'{word}' is not a number; one is written like 0.5, -2 or 1e-3{quoted}")
        }
        _ if message.starts_with("string values must be quoted") => {
            format!("a name stands in quotes: \"{word}\"")
        }
        _ if message.starts_with("invalid unquoted key") => {
            "a name with other signs than a-z, 0-9, - and _ stands in quotes, as in [matte.\"dark red\"]"
                .into()
        }
        _ if message.starts_with("invalid boolean") => "write true or false, in small letters".into(),
        other => format!("this is not TOML: {}", other.replace('\n', "; ")),
    };
    ParseError { span, message }
}

/// The name of the table that a position is in, if the table's header stands on a line of its own.
fn table_at(text: &str, at: usize) -> Option<&str> {
    let mut upwards = text.get(..at)?.lines().rev();
    upwards.find_map(|line| line.trim().strip_prefix('[')?.strip_suffix(']'))
}

/// The end of the word at a position, and the word. Words are separated by blanks, commas, brackets and quotes.
fn word_at(text: &str, at: usize) -> (usize, &str) {
    let ends = |letter: char| letter.is_whitespace() || "[]{}=,#\"'".contains(letter);
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let start = text[..at].rfind(ends).map_or(0, |end| end + 1);
    let end = text[at..].find(ends).map_or(text.len(), |end| at + end);
    (end, text.get(start..end).unwrap_or_default())
}
