//! Materials: Suffern, chapters 14, 15 and 24. A kind is a file here, with its plain values and its table of the scene
//! file; `material_kinds` lists them.

mod emissive;
mod matte;
mod mirror;
mod phong;

use glam::{DVec3, Vec3};

/// Calls a macro with the list of all kinds: a kind, its table, and the name of that in scene files. What stands before
/// them comes first in the list.
macro_rules! material_kinds {
    ($callback:ident $(, $before:tt)*) => {
        $callback! {
            $($before,)*
            [
                (Matte, MatteTable, matte),
                (Phong, PhongTable, phong),
                (Mirror, MirrorTable, mirror),
                (Emissive, EmissiveTable, emissive),
            ]
        }
    };
}
pub(super) use material_kinds;

/// What every kind of material says of itself.
trait Kind {
    /// As bright as it looks anywhere, but for what is mirrored in it: as seen where all lights meet it head-on, and
    /// where its highlight is. `lights` is their radiance together.
    fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3;

    /// The share of the light that it mirrors.
    fn reflectance(&self) -> Vec3 {
        Vec3::ZERO
    }
}

macro_rules! define_material {
    ([$(($kind:ident, $table:ident, $name:ident),)+]) => {
        $(pub use $name::$kind;
        pub(super) use $name::$table;)+

        /// The names of the kinds in scene files.
        pub(super) const MATERIAL_NAMES: &[&str] = &[$(stringify!($name)),+];

        /// A material of any kind. All coefficients are linear.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Material {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind),)+
        }

        impl Material {
            /// As bright as it looks anywhere, but for what is mirrored in it: as seen where all lights meet it head-on,
            /// and where its highlight is. `lights` is their radiance together.
            pub fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3 {
                match self { $(Self::$kind(of) => of.brightest(lights, ambient),)+ }
            }

            /// The share of the light that it mirrors.
            pub fn reflectance(&self) -> Vec3 {
                match self { $(Self::$kind(of) => of.reflectance(),)+ }
            }
        }

        $(impl From<$kind> for Material {
            fn from(of: $kind) -> Self {
                Self::$kind(of)
            }
        }

        impl From<$table> for Material {
            fn from(table: $table) -> Self {
                $kind::from(table).into()
            }
        })+
    };
}
material_kinds!(define_material);
