//! Errors in the text of a scene file, each with its place.

use std::ops::Range;
use toml::Spanned;

/// An error in the text, with its place.
pub(in crate::scene) struct ParseError {
    pub(in crate::scene) span: Range<usize>,
    pub(in crate::scene) message: String,
}

impl ParseError {
    /// An error in this value.
    pub(in crate::scene) fn at<T>(value: &Spanned<T>, message: &str) -> Self {
        Self { span: value.span(), message: message.to_owned() }
    }
}

/// The entry of this name in a list. `kind` says what the entries are, for the error.
pub(super) fn named<T: Copy>(
    things: &[(&'static str, T)],
    name: &Spanned<String>,
    kind: &str,
) -> Result<T, ParseError> {
    let found = things.iter().find(|(known, _)| known == name.get_ref()).map(|(_, thing)| *thing);
    found.ok_or_else(|| {
        let known: Vec<&str> = things.iter().map(|(known, _)| *known).collect();
        ParseError::at(name, &format!("no {kind} '{}'; there are: {}", name.get_ref(), known.join(", ")))
    })
}
