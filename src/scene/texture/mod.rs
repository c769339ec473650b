//! Textures: colours that differ from place to place. A kind is a file here, with its values and how a scene file says
//! them; `texture_kinds` lists them.

mod checker;
mod constant;

use glam::Vec3;
use serde::Deserialize;

/// Calls a macro with the list of all kinds: a kind, how a scene file says it, and its file.
macro_rules! texture_kinds {
    ($callback:ident) => {
        $callback! {
            (Constant, ConstantTable, constant),
            (Checker, CheckerTable, checker),
        }
    };
}

/// What every kind of texture says of itself.
trait Kind {
    /// As bright as it is anywhere, in each channel.
    fn brightest(&self) -> Vec3;
}

macro_rules! define_texture {
    ($(($kind:ident, $table:ident, $name:ident),)+) => {
        $(pub use $name::$kind;)+

        /// A colour that may differ from place to place, linear r, g, b.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Texture {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind),)+
        }

        impl Texture {
            /// As bright as it is anywhere, in each channel.
            pub fn brightest(&self) -> Vec3 {
                match self { $(Self::$kind(of) => of.brightest(),)+ }
            }
        }

        $(impl From<$kind> for Texture {
            fn from(of: $kind) -> Self {
                Self::$kind(of)
            }
        })+

        /// The value of the key `color` of materials.
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a color is [r, g, b] or { even = [r, g, b], odd = [r, g, b], size = EDGE }")]
        pub(in crate::scene) enum TextureTable {
            $($kind($name::$table),)+
        }

        impl From<TextureTable> for Texture {
            fn from(table: TextureTable) -> Self {
                match table { $(TextureTable::$kind(table) => $kind::from(table).into(),)+ }
            }
        }
    };
}
texture_kinds!(define_texture);

impl Texture {
    /// The same colour everywhere.
    pub const fn constant(color: Vec3) -> Self {
        Self::Constant(Constant { color })
    }
}
