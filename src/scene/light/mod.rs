//! Lights. A kind is a file here, with its plain values and its table of the scene file; `light_kinds` lists those that a
//! scene can have many of. Beside them it has one background. Radiance is linear r, g, b.

mod background;
mod directional;
mod point;

pub use background::Background;
pub(super) use background::{BackgroundTable, background};

use super::toml::error::ParseError;
use glam::Vec3;

/// Calls a macro with the list of all kinds: a kind, its values, its table, and the name of that in scene files. What
/// stands before them comes first in the list.
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

/// A light without extent: Suffern, chapter 14. It does not weaken with distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// The place of a point light, or the direction of a directional one.
    pub kind: LightKind,
    /// The radiance that arrives at every point, however far away.
    pub radiance: Vec3,
    /// Whether shapes cast shadows in its light.
    pub shadows: bool,
}

/// The table of a kind of light.
pub(super) trait LightTable {
    /// The light.
    ///
    /// # Errors
    /// Where there is no such light.
    fn light(&self) -> Result<Light, ParseError>;
}

macro_rules! define_light {
    ([$(($kind:ident, $values:ident, $table:ident, $name:ident),)+]) => {
        $(pub use $name::$values;
        pub(super) use $name::$table;)+

        /// The names of the kinds in scene files.
        pub(super) const LIGHT_NAMES: &[&str] = &[$(stringify!($name)),+];

        /// Where light comes from.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum LightKind {
            $(#[doc = concat!("See [`", stringify!($values), "`].")] $kind($values),)+
        }
    };
}
light_kinds!(define_light);
