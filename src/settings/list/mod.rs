//! The list of all settings. It defines the options of the command line, what pictures and scene files store, the
//! ranges, and the rows of the viewer's panel.

mod aperture;
mod camera;
mod lens;
mod light;
mod model;
mod picture;

use super::{Key, Part, Row, Setting, Slider, Widget};

/// Settings that belong together.
pub struct Group {
    /// The subject of the settings.
    pub title: &'static str,
    /// The settings, in the order of the list.
    pub settings: &'static [Setting],
}

/// The settings, in the order in which they are applied. A setting that changes others comes before them, so that one
/// command can choose a known lens and change it.
pub static GROUPS: [Group; 8] = [
    Group { title: "Picture", settings: picture::PICTURE },
    Group { title: "Model", settings: model::MODEL },
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

/// The settings that have a value of their own.
pub fn own() -> impl Iterator<Item = &'static Setting> {
    all().filter(|setting| !setting.is_alias())
}

/// The setting with this flag, for parts of the program that need a certain setting.
pub fn setting(flag: &str) -> &'static Setting {
    all().find(|setting| setting.flag == flag).expect("the list has what the program asks for")
}

/// The access to a field of [`super::Settings`].
macro_rules! field {
    ($($path:ident).+) => {
        crate::settings::Field {
            get: |settings| settings.$($path).+.clone(),
            set: |settings, value| settings.$($path).+ = value,
        }
    };
}

/// The access to a field whose values have names, in a list such as [`super::Sampler::NAMES`].
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

/// A linear slider.
const EVEN: Slider = Slider { range: |_| [0.0, 1.0], logarithmic: false, decimals: None };

/// A logarithmic slider, for several orders of magnitude.
const LOGARITHMIC: Slider = Slider { range: |_| [0.01, 100.0], logarithmic: true, decimals: None };
