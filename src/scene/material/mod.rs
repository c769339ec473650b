//! Materials: Suffern, chapters 14, 15 and 24. Each kind has a file here, with its values and its table of the scene file.
//! `material_kinds` lists the kinds.

mod emissive;
mod glass;
mod matte;
mod metal;
mod mirror;
mod phong;
mod plastic;
mod standard;

use super::{Integrator, Texture};
use glam::{DVec3, Vec3};

/// Calls a macro with the list of all kinds. An entry has the name of the kind, its table, and the name of the table in
/// scene files. The arguments of this macro come first in the list.
macro_rules! material_kinds {
    ($callback:ident $(, $before:tt)*) => {
        $callback! {
            $($before,)*
            [
                (Matte, MatteTable, matte),
                (Phong, PhongTable, phong),
                (Mirror, MirrorTable, mirror),
                (Emissive, EmissiveTable, emissive),
                (Metal, MetalTable, metal),
                (Glass, GlassTable, glass),
                (Plastic, PlasticTable, plastic),
                (Standard, StandardTable, standard),
            ]
        }
    };
}
pub(super) use material_kinds;

/// What every kind of material implements.
trait Kind {
    /// The largest radiance of the material, without mirror images: where all lights shine on it perpendicularly, and
    /// in its highlight. `lights` is the sum of their radiances.
    fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3;

    /// The fraction of light that is reflected as in a mirror.
    fn reflectance(&self) -> Vec3 {
        Vec3::ZERO
    }

    /// Why an integrator cannot render this material, and what to use instead. `None` if it can.
    fn refusal(&self, _integrator: Integrator) -> Option<&'static str> {
        None
    }
}

/// Why `whitted` cannot render a material.
const NEEDS_PATH: &str = "it needs the integrator path";
/// Why `path` cannot render a material that adds light.
const ADDS_LIGHT: &str =
    "it reflects more light than arrives; use a color and a coefficient whose product is at most 1";

/// The answer of [`Kind::refusal`] for a material of the integrator `path` that reflects up to its colour.
fn refusal_of_color(color: &Texture, integrator: Integrator) -> Option<&'static str> {
    let adds_light = (color.brightest().max_element() > 1.0).then_some(ADDS_LIGHT);
    (integrator == Integrator::Whitted).then_some(NEEDS_PATH).or(adds_light)
}

/// Why `path` cannot render Suffern's highlights.
const HAS_HIGHLIGHT: &str = "the highlights of ks and exponent belong to the integrator whitted; use matte or mirror \
                             without them";

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
            /// The largest radiance of the material, without mirror images: where all lights shine on it
            /// perpendicularly, and in its highlight. `lights` is the sum of their radiances.
            pub fn brightest(&self, lights: DVec3, ambient: DVec3) -> DVec3 {
                match self { $(Self::$kind(of) => of.brightest(lights, ambient),)+ }
            }

            /// The fraction of light that is reflected as in a mirror.
            pub fn reflectance(&self) -> Vec3 {
                match self { $(Self::$kind(of) => of.reflectance(),)+ }
            }

            /// Why an integrator cannot render this material, and what to use instead. `None` if it can.
            pub(super) fn refusal(&self, integrator: Integrator) -> Option<&'static str> {
                match self { $(Self::$kind(of) => of.refusal(integrator),)+ }
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
