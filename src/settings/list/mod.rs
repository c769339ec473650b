//! Every setting, once. The command line's options, what pictures and scene files carry, the ranges and the rows of the
//! viewer's panel follow from this list.

mod aperture;
mod camera;
mod lens;
mod light;
mod picture;

use super::{Key, Part, Row, Setting, Slider, Widget};

/// Settings that belong together.
pub struct Group {
    /// What they are about.
    pub title: &'static str,
    /// They, in the order of the list.
    pub settings: &'static [Setting],
}

/// The settings, in the order in which they are applied: those that change others come before them, so that a known
/// lens can be given and changed at once.
pub static GROUPS: [Group; 7] = [
    Group { title: "Picture", settings: picture::PICTURE },
    Group { title: "Camera", settings: camera::CAMERA },
    Group { title: "Lens", settings: lens::LENS },
    Group { title: "Aperture", settings: aperture::APERTURE },
    Group { title: "Light", settings: light::LIGHT },
    Group { title: "View", settings: light::VIEW },
    Group { title: "Sampling", settings: picture::SAMPLING },
];

/// All settings, in the order of the list.
pub fn all() -> impl Iterator<Item = &'static Setting> {
    GROUPS.iter().flat_map(|group| group.settings)
}

/// Those that have a value of their own.
pub fn own() -> impl Iterator<Item = &'static Setting> {
    all().filter(|setting| !setting.is_alias())
}

/// The setting that has this flag, for those parts of the program that need a certain one.
pub fn setting(flag: &str) -> &'static Setting {
    all().find(|setting| setting.flag == flag).expect("the list has what the program asks for")
}

/// A value that stands in a field of [`super::Settings`].
macro_rules! field {
    ($($path:ident).+) => {
        crate::settings::Field {
            get: |settings| settings.$($path).+.clone(),
            set: |settings, value| settings.$($path).+ = value,
        }
    };
}

/// The access to a field whose values have names, among [`super::Sampler::NAMES`] and their like.
macro_rules! by_name {
    ($names:expr, $($path:ident).+) => {
        crate::settings::Field {
            get: |settings| name_of(&$names, &settings.$($path).+),
            set: |settings, name| {
                if let Some(value) = named(&$names, name) {
                    settings.$($path).+ = value;
                }
            },
        }
    };
}

use {by_name, field};

const fn key(table: &'static str, name: &'static str) -> Option<Key> {
    Some(Key { table, name, otherwise: &[], rests_on: &[] })
}

const fn camera(name: &'static str) -> Option<Key> {
    key("camera", name)
}

const fn view(name: &'static str) -> Option<Key> {
    key("view", name)
}

const fn top(name: &'static str) -> Option<Key> {
    key("", name)
}

/// A row that is always shown.
const fn row(part: Part, label: &'static str, help: &'static str, widget: Widget) -> Option<Row> {
    Some(Row { part, label, help, shown: |_| true, widget })
}

/// A slider whose equal ways are equal differences.
const EVEN: Slider =
    Slider { range: |_| [0.0, 1.0], format: |_| "%.2f".into(), logarithmic: false, rounds: true };

/// A slider over several orders of magnitude.
const LOGARITHMIC: Slider =
    Slider { range: |_| [0.01, 100.0], format: |_| "%.4g".into(), logarithmic: true, rounds: false };
