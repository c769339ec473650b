//! What is wrong with a scene file, with its place in the text.

use std::ops::Range;
use toml::Spanned;

/// What is wrong, and where in the text.
pub(in crate::scene) struct Fault {
    pub(in crate::scene) span: Range<usize>,
    pub(in crate::scene) message: String,
}

/// Something is wrong with this value.
pub(in crate::scene) fn fault<T>(at: &Spanned<T>, message: &str) -> Fault {
    Fault { span: at.span(), message: message.to_owned() }
}

/// The thing of this name, of a list of things. `kind` says what they are.
pub(super) fn named<T: Copy>(
    things: &[(&'static str, T)],
    name: &Spanned<String>,
    kind: &str,
) -> Result<T, Fault> {
    let found = things.iter().find(|(known, _)| known == name.get_ref()).map(|(_, thing)| *thing);
    found.ok_or_else(|| {
        let known: Vec<&str> = things.iter().map(|(known, _)| *known).collect();
        fault(name, &format!("no {kind} '{}'; there are: {}", name.get_ref(), known.join(", ")))
    })
}
