//! Lights. Each kind has a file here, with its values and its table of the scene file. `light_kinds` lists the kinds of
//! which a scene can have many. In addition, a scene has one background. Radiance is linear r, g, b.

mod background;
mod directional;
mod panorama;
mod point;

pub use background::{Background, Gradient};
pub(super) use background::{BackgroundTable, background};
pub use panorama::{Chances, Panorama};

use super::toml::error::ParseError;
use glam::Vec3;

/// Calls a macro with the list of all kinds. An entry has the name of the kind, its values, its table, and the name of
/// the table in scene files. The arguments of this macro come first in the list.
macro_rules! light_kinds {
    ($callback:ident $(, $before:tt)*) => {
        $callback! {
            $($before,)*
            [
                (Point, PointLight, PointTable, point),
                (Directional, DirectionalLight, DirectionalTable, directional),
            ]
        }
    };
}
pub(super) use light_kinds;

/// A light without extent: Suffern, chapter 14. Its light does not weaken with distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// The position of a point light, or the direction of a directional one.
    pub kind: LightKind,
    /// The radiance that arrives at every point, however far away.
    pub radiance: Vec3,
    /// Whether shapes cast shadows in this light.
    pub shadows: bool,
}

/// The table of a kind of light.
pub(super) trait LightTable {
    /// The light.
    ///
    /// # Errors
    /// A [`ParseError`] if the table describes no light.
    fn light(&self) -> Result<Light, ParseError>;
}

macro_rules! define_light {
    ([$(($kind:ident, $values:ident, $table:ident, $name:ident),)+]) => {
        $(pub use $name::$values;
        pub(super) use $name::$table;)+

        /// The names of the kinds in scene files.
        pub(super) const LIGHT_NAMES: &[&str] = &[$(stringify!($name)),+];

        /// The position or the direction of a light.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum LightKind {
            $(#[doc = concat!("See [`", stringify!($values), "`].")] $kind($values),)+
        }
    };
}
light_kinds!(define_light);
