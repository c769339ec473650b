//! The aperture: the opening that light enters through. Each kind has a file here, with its values and its area
//! relative to that of a disc. `aperture_kinds` lists the kinds.

mod blades;
mod cats_eye;
mod disc;
mod ellipse;
mod image;

pub use image::Mask;

use super::CameraModel;
use std::f64::consts::TAU;
use std::fmt::Display;

/// Calls a macro with the list of all kinds. An entry has the name of the kind, its type and its file.
macro_rules! aperture_kinds {
    ($callback:ident) => {
        $callback! {
            (Disc, ApertureDisc, disc),
            (Ellipse, Ellipse, ellipse),
            (Blades, Blades, blades),
            (CatsEye, CatsEye, cats_eye),
            (Image, ApertureImage, image),
        }
    };
}

/// What every kind of aperture implements.
trait Kind {
    /// The area of the aperture as seen from the middle of the picture, divided by that of a disc of the same diameter.
    fn relative_area(&self) -> f64;

    /// The parts through which light comes in, as seen from a film point, which is given relative to the picture's
    /// centre, y up, in units of the distance to a corner.
    fn openings(&self, film: [f64; 2]) -> Vec<Opening>;
}

/// A part of an aperture.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// The corners of a convex polygon, anticlockwise, in units of the aperture's radius. As seen from behind the
    /// camera, x is to the right and y up.
    pub corners: Vec<[f64; 2]>,
    /// The share of the light that it lets in.
    pub light: f32,
}

/// A round opening is a polygon with this many corners.
const CORNERS: u32 = 96;

impl Opening {
    /// An opening with this distance of the rim from a point, in each direction. The first corner is in the direction
    /// `start`, and another one opposite to it.
    fn around(middle: [f64; 2], start: f64, rim: impl Fn(f64) -> f64) -> Vec<Self> {
        let corner = |number: u32| {
            let angle = start + TAU * f64::from(number) / f64::from(CORNERS);
            let radius = rim(angle);
            [middle[0] + radius * angle.cos(), middle[1] + radius * angle.sin()]
        };
        vec![Self { corners: (0..CORNERS).map(corner).collect(), light: 1.0 }]
    }
}

macro_rules! define_aperture {
    ($(($kind:ident, $values:ident, $name:ident),)+) => {
        $(pub use $name::$values;)+

        /// An aperture of any kind, without the stretch that applies to all kinds.
        #[derive(Debug, Clone, PartialEq)]
        pub enum ApertureKind {
            $(#[doc = concat!("See [`", stringify!($values), "`].")] $kind($values),)+
        }

        impl Kind for ApertureKind {
            fn relative_area(&self) -> f64 {
                match self { $(Self::$kind(of) => of.relative_area(),)+ }
            }

            fn openings(&self, film: [f64; 2]) -> Vec<Opening> {
                match self { $(Self::$kind(of) => of.openings(film),)+ }
            }
        }
    };
}
aperture_kinds!(define_aperture);

/// The number of blades of an iris.
pub const BLADES: [u32; 2] = [3, 16];
/// The curvature of the blades' edges.
pub const ROUNDNESSES: [f32; 2] = [0.0, 1.0];
/// The height of an aperture divided by its width.
pub const ANAMORPHICS: [f32; 2] = [0.1, 10.0];
/// The displacement of the front rim of the lens, in diameters.
pub const CATS_EYES: [f32; 2] = [0.0, 1.0];
/// How light is spread over an aperture.
pub const PROFILES: [f32; 2] = [-1.0, 1.0];

/// The shape of an aperture of a given diameter, as the user describes it. [`Aperture::kind`] says which kind that is.
#[derive(Debug, Clone, PartialEq)]
pub struct Aperture {
    /// The number of blades of the iris, whose corners lie on the rim of the aperture. 0 is a disc.
    pub blades: u32,
    /// The angle by which the iris is turned, anticlockwise as seen from behind the camera. At 0, the middle of a
    /// blade's edge is at the right.
    pub rotation_degrees: f32,
    /// The curvature of the blades' edges: 0 is a polygon, 1 a disc. In between, the
    /// square of an edge's distance from the centre is interpolated linearly.
    pub roundness: f32,
    /// Height divided by width. The longer of the two is the diameter.
    pub anamorphic: f32,
    /// Optical vignetting of a disc: the displacement of the front rim of the lens, as seen from a corner of the
    /// picture, in diameters. The light that passes both is that of the overlap of two discs.
    pub cats_eye: f32,
    /// An image that gives the shape instead: light comes in where the image is bright.
    pub image: Option<ApertureImage>,
    /// How the light is spread over the aperture. At the distance `r` from the centre, as a share of that of the rim, there
    /// is `1 + p (1 - 2 r^2)` of the light that there would be if it came in evenly: as much in all.
    pub profile: f32,
}

impl Default for Aperture {
    fn default() -> Self {
        Self {
            blades: 0,
            rotation_degrees: 0.0,
            roundness: 0.0,
            anamorphic: 1.0,
            cats_eye: 0.0,
            image: None,
            profile: 0.0,
        }
    }
}

impl Aperture {
    /// Checks that at most one shape is chosen. `names` gives what the user calls blades, cat's eye and image.
    ///
    /// # Errors
    /// The reason why these values describe no aperture.
    pub fn validate<N: Display>(&self, names: impl FnOnce() -> [N; 3]) -> Result<(), String> {
        let shapes = [self.blades != 0, self.cats_eye != 0.0, self.image.is_some()];
        if shapes.into_iter().filter(|chosen| *chosen).count() > 1 {
            let [blades, cats_eye, image] = names();
            return Err(format!("{blades}, {cats_eye} and {image} are shapes of their own; choose one"));
        }
        Ok(())
    }

    /// Half the width and half the height of an aperture of diameter 2.
    pub fn stretch(&self) -> [f64; 2] {
        let ratio = f64::from(self.anamorphic);
        [ratio.recip().min(1.0), ratio.min(1.0)]
    }

    /// The kind of aperture that a camera of this model has.
    pub fn kind(&self, model: CameraModel) -> ApertureKind {
        match &self.image {
            _ if model == CameraModel::Pinhole => ApertureKind::Disc(ApertureDisc),
            Some(image) => ApertureKind::Image(image.clone()),
            None if self.blades > 0 => ApertureKind::Blades(Blades {
                count: self.blades,
                rotation_degrees: self.rotation_degrees,
                roundness: self.roundness,
            }),
            // A hole without a lens has no front rim.
            None if self.cats_eye > 0.0 && model == CameraModel::ThinLens => {
                ApertureKind::CatsEye(CatsEye { in_corner: self.cats_eye })
            }
            None if self.anamorphic != 1.0 => ApertureKind::Ellipse(Ellipse),
            None => ApertureKind::Disc(ApertureDisc),
        }
    }

    /// The profile, or 0 where there is none: without a lens, and where an image says where light comes in.
    pub fn profile_in_use(&self, model: CameraModel) -> f32 {
        if model == CameraModel::ThinLens && self.image.is_none() { self.profile } else { 0.0 }
    }

    /// The largest share of its light that a sample has. A rim cuts off a part of the profile, so samples have weights; the
    /// samples of other apertures are spread as the light is.
    pub fn largest_share(&self, model: CameraModel) -> f64 {
        match self.kind(model) {
            ApertureKind::CatsEye(_) => 1.0 + f64::from(self.profile.abs()),
            _ => 1.0,
        }
    }

    /// The area of the aperture as seen from the middle of the picture, divided by that of a disc of the same diameter.
    /// The corners of blades lie on the rim, so three blades let in 41% of the light of a disc, five 76%, six 83%,
    /// eight 90%.
    pub fn relative_area(&self) -> f64 {
        let [half_width, half_height] = self.stretch();
        half_width * half_height * self.kind(CameraModel::ThinLens).relative_area()
    }

    /// The parts through which light comes in, as seen from a film point, which is given relative to the picture's
    /// centre, y up, in units of the distance to a corner.
    pub fn openings(&self, model: CameraModel, film: [f64; 2]) -> Vec<Opening> {
        let stretch = self.stretch();
        let mut openings = self.kind(model).openings(film);
        for corner in openings.iter_mut().flat_map(|opening| &mut opening.corners) {
            *corner = [0, 1].map(|axis| stretch[axis] * corner[axis]);
        }
        openings
    }
}
