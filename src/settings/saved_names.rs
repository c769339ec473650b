//! File names in JSON, for `#[serde(with = ...)]`. A name that is text is a string. Systems also allow names that are
//! not text. Such a name is an object with its bytes, `{"Unix": [99, 97, 102, 233]}`, so that no name is lost.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::ffi::{OsStr, OsString};

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Name {
    Text(String),
    Raw(OsString),
}

/// Writes a list of names.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<T: AsRef<OsStr>, S: Serializer>(names: &[T], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(names.iter().map(|name| match name.as_ref().to_str() {
        Some(text) => Name::Text(text.into()),
        None => Name::Raw(name.as_ref().into()),
    }))
}

/// Reads a list of names.
///
/// # Errors
/// Those of the deserializer.
pub fn deserialize<'de, T: From<OsString>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<T>, D::Error> {
    let names = Vec::<Name>::deserialize(deserializer)?;
    let name = |name| match name {
        Name::Text(text) => OsString::from(text),
        Name::Raw(raw) => raw,
    };
    Ok(names.into_iter().map(|saved| T::from(name(saved))).collect())
}
