//! Shapes, in world coordinates and scene units. Each kind has a file here, with its values, its table of the scene
//! file, and what the tree and the camera need to know about it. `shape_kinds` lists the kinds.

mod r#box;
mod cylinder;
mod disc;
mod plane;
mod rectangle;
mod sphere;
mod triangle;

use super::toml::error::ParseError;
use glam::{DMat3, DVec3, Vec3};
use toml::Spanned;

/// Calls a macro with the list of all kinds. An entry has the name of the kind, its table, and the name of the table in
/// scene files.
macro_rules! shape_kinds {
    ($callback:ident) => {
        $callback! {
            [
                (Sphere, SphereTable, sphere),
                (Box, BoxTable, r#box),
                (Triangle, TriangleTable, triangle),
                (Cylinder, CylinderTable, cylinder),
                (Rectangle, RectangleTable, rectangle),
                (Disc, DiscTable, disc),
                (Plane, PlaneTable, plane),
            ]
        }
    };
}
pub(super) use shape_kinds;

/// A shape with its material and its velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaded {
    /// The shape.
    pub shape: Shape,
    /// Index into [`super::Scene::materials`].
    pub material: u32,
    /// The velocity in scene units per second. In the middle of the exposure, the shape is where the scene file says.
    /// Its checker moves with it. A shape without bounds does not move.
    pub velocity: Vec3,
}

/// What every kind of shape implements.
pub(super) trait Kind: Copy {
    /// The same shape in coordinates with another origin.
    fn seen_from(self, origin: DVec3) -> Self;

    /// The bounding box: the corners with the smallest and the largest coordinates. `None` for an infinite shape.
    fn bounds(&self) -> Option<[DVec3; 2]>;

    /// The largest distance of a point of the shape from the origin.
    fn reach(&self) -> f64;

    /// The area of the surface. `None` if it is infinite.
    fn area(&self) -> Option<f64>;

    /// Points whose convex hull contains the shape. A shape that can choose uses the corners of a box along `axes`.
    fn corners(&self, axes: DMat3) -> Corners;

    /// Three vectors in f32 that identify the points of the shape: shapes of one kind with equal vectors are identical.
    fn place(&self) -> [Vec3; 3];
}

/// The table of a kind of shape.
pub(super) trait ShapeTable {
    /// The shape.
    ///
    /// # Errors
    /// A [`ParseError`] if the table describes no shape.
    fn shape(&self) -> Result<Shape, ParseError>;

    /// The name of its material.
    fn material(&self) -> &Spanned<String>;

    /// The velocity in scene units per second.
    fn velocity(&self) -> Vec3;
}

/// Up to eight points.
pub struct Corners {
    points: [DVec3; 8],
    count: usize,
}

impl Corners {
    pub(super) fn new<const N: usize>(points: [DVec3; N]) -> Self {
        let mut all = [DVec3::ZERO; 8];
        all[..N].copy_from_slice(&points);
        Self { points: all, count: N }
    }

    /// The corners of a parallelepiped around `center`, whose edges are twice the columns of `half`.
    pub(super) fn of_box(center: DVec3, half: DMat3) -> Self {
        let side = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let points = std::array::from_fn(|corner| {
            center + half * DVec3::new(side(corner, 0), side(corner, 1), side(corner, 2))
        });
        Self { points, count: 8 }
    }

    /// The points.
    pub fn iter(&self) -> impl Iterator<Item = DVec3> {
        self.points[..self.count].iter().copied()
    }
}

macro_rules! define_shape {
    ([$(($kind:ident, $table:ident, $name:ident),)+]) => {
        $(pub use $name::$kind;
        pub(super) use $name::$table;)+

        /// The names of the kinds in scene files, as identifiers of Rust.
        pub(super) const SHAPE_NAMES: &[&str] = &[$(stringify!($name)),+];

        /// A shape of any kind.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Shape {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind),)+
        }

        impl Shape {
            /// The same shape in coordinates with another origin.
            pub fn seen_from(self, origin: DVec3) -> Self {
                match self { $(Self::$kind(shape) => Self::$kind(shape.seen_from(origin)),)+ }
            }

            /// The bounding box: the corners with the smallest and the largest coordinates. `None` for an infinite
            /// shape.
            pub fn bounds(&self) -> Option<[DVec3; 2]> {
                match self { $(Self::$kind(shape) => shape.bounds(),)+ }
            }

            /// The largest distance of a point of the shape from the origin.
            pub fn reach(&self) -> f64 {
                match self { $(Self::$kind(shape) => shape.reach(),)+ }
            }

            /// The area of the surface. `None` if it is infinite.
            pub fn area(&self) -> Option<f64> {
                match self { $(Self::$kind(shape) => shape.area(),)+ }
            }

            /// Points whose convex hull contains the shape. A shape that can choose uses the corners of a box along
            /// `axes`.
            pub fn corners(&self, axes: DMat3) -> Corners {
                match self { $(Self::$kind(shape) => shape.corners(axes),)+ }
            }

            /// Three vectors in f32 that identify the points of the shape: shapes of one kind with equal vectors are
            /// identical.
            pub(super) fn place(&self) -> [Vec3; 3] {
                match self { $(Self::$kind(shape) => shape.place(),)+ }
            }
        }

        $(impl From<$kind> for Shape {
            fn from(shape: $kind) -> Self {
                Self::$kind(shape)
            }
        }

        impl<'a> TryFrom<&'a Shape> for &'a $kind {
            type Error = ();

            fn try_from(shape: &'a Shape) -> Result<Self, ()> {
                match shape {
                    Shape::$kind(shape) => Ok(shape),
                    _ => Err(()),
                }
            }
        })+
    };
}
shape_kinds!(define_shape);

impl Shape {
    /// Whether the shape is finite. Only finite shapes can move and be in the tree.
    pub fn is_bounded(&self) -> bool {
        self.bounds().is_some()
    }
}

impl Shaded {
    /// A shape that does not move.
    pub fn still(shape: impl Into<Shape>, material: u32) -> Self {
        Self { shape: shape.into(), material, velocity: Vec3::ZERO }
    }
}
