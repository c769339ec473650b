//! The opening that light comes in through. A kind is a file here, with its values and how much light it lets in;
//! `aperture_kinds` lists them.

mod blades;
mod cats_eye;
mod disc;
mod ellipse;
mod image;

pub use image::Mask;

use super::CameraModel;

/// Calls a macro with the list of all kinds: a kind, what it holds, and its file.
macro_rules! aperture_kinds {
    ($callback:ident) => {
        $callback! {
            (Disc, Disc, disc),
            (Ellipse, Ellipse, ellipse),
            (Blades, Blades, blades),
            (CatsEye, CatsEye, cats_eye),
            (Image, ApertureImage, image),
        }
    };
}

/// What every kind of aperture says of itself.
trait Kind {
    /// The share that is open of a disc of the same diameter, seen from the middle of the picture.
    fn open_share(&self) -> f64;
}

macro_rules! define_aperture {
    ($(($kind:ident, $values:ident, $name:ident),)+) => {
        $(pub use $name::$values;)+

        /// An aperture of one kind, without the stretch that all have.
        #[derive(Debug, Clone, PartialEq)]
        pub enum ApertureKind {
            $(#[doc = concat!("See [`", stringify!($values), "`].")] $kind($values),)+
        }

        impl Kind for ApertureKind {
            fn open_share(&self) -> f64 {
                match self { $(Self::$kind(of) => of.open_share(),)+ }
            }
        }
    };
}
aperture_kinds!(define_aperture);

/// What is said of an opening of a given diameter: see [`Aperture::kind`] for what that makes. Light comes in evenly
/// all over it.
#[derive(Debug, Clone, PartialEq)]
pub struct Aperture {
    /// Blades of the iris, whose corners lie on the rim of the opening; 0 is a disc.
    pub blades: u32,
    /// How far the iris is turned, anticlockwise as seen from behind the camera. At 0 a blade's edge
    /// is at its right.
    pub rotation_degrees: f32,
    /// How far the blades' edges are bent out: 0 is a polygon, 1 a disc. In between, the
    /// square of an edge's distance from the centre is interpolated linearly.
    pub roundness: f32,
    /// Height divided by width. The longer of the two is the diameter of the lens.
    pub anamorphic: f32,
    /// Optical vignetting, of a disc: how far the lens's front rim is off its centre, seen from a corner of
    /// the picture, in diameters. What passes both is the overlap of two discs.
    pub cats_eye: f32,
    /// An image that gives the shape instead: light comes in where the image is bright.
    pub image: Option<ApertureImage>,
}

impl Default for Aperture {
    fn default() -> Self {
        Self { blades: 0, rotation_degrees: 0.0, roundness: 0.0, anamorphic: 1.0, cats_eye: 0.0, image: None }
    }
}

impl Aperture {
    /// Checks that at most one shape is chosen. The names are what the user calls blades, cat's eye and image.
    ///
    /// # Errors
    /// The reason why these values describe no aperture.
    pub fn validate(&self, [blades, cats_eye, image]: [&str; 3]) -> Result<(), String> {
        let shapes = [self.blades != 0, self.cats_eye != 0.0, self.image.is_some()];
        if shapes.into_iter().filter(|chosen| *chosen).count() > 1 {
            return Err(format!("{blades}, {cats_eye} and {image} are shapes of their own; choose one"));
        }
        Ok(())
    }

    /// Half the width and half the height of an opening of diameter 2.
    pub fn stretch(&self) -> [f64; 2] {
        let ratio = f64::from(self.anamorphic);
        [ratio.recip().min(1.0), ratio.min(1.0)]
    }

    /// What it is before a camera of this model.
    pub fn kind(&self, model: CameraModel) -> ApertureKind {
        match &self.image {
            _ if model == CameraModel::Pinhole => ApertureKind::Disc(Disc),
            Some(image) => ApertureKind::Image(image.clone()),
            None if self.blades > 0 => ApertureKind::Blades(Blades {
                count: self.blades,
                rotation_degrees: self.rotation_degrees,
                roundness: self.roundness,
            }),
            // A hole has no front rim.
            None if self.cats_eye > 0.0 && model == CameraModel::ThinLens => {
                ApertureKind::CatsEye(CatsEye { in_corner: self.cats_eye })
            }
            None if self.anamorphic != 1.0 => ApertureKind::Ellipse(Ellipse),
            None => ApertureKind::Disc(Disc),
        }
    }

    /// The share that is open of a disc of the same diameter, seen from the middle of the picture. The corners of
    /// blades lie on the disc's rim, so three let in 41% of its light, five 76%, six 83% and eight 90%.
    pub fn open_share(&self) -> f64 {
        let [half_width, half_height] = self.stretch();
        half_width * half_height * self.kind(CameraModel::ThinLens).open_share()
    }
}
