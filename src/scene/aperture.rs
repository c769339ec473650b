//! The shape of the opening that light comes in through.

use crate::error::{Error, Result};
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

/// How many blades an iris can have.
pub const BLADES: std::ops::RangeInclusive<u32> = 3..=16;
/// Images are reduced to as many cells across at most.
const MOST_CELLS: u32 = 256;

/// The shape of an opening of a given diameter. Light comes in evenly all over it.
#[derive(Debug, Clone, PartialEq)]
pub struct Aperture {
    /// Blades of the iris, whose corners lie on the rim of the opening; 0 is a disc.
    pub blades: u32,
    /// How far the iris is turned, anticlockwise as seen from behind the camera. At 0 a blade's edge
    /// is at its right.
    pub rotation_degrees: f32,
    /// How far the blades' edges are bent out: 0 is a polygon, 1 a disc. In between the square of the
    /// distance from the centre is.
    pub roundness: f32,
    /// How often its width goes into its height; the longer of the two is the diameter.
    pub anamorphic: f32,
    /// Optical vignetting, of a disc: how far the lens's front rim is off its centre, seen from a corner of
    /// the picture, in diameters. What passes both is the overlap of two discs.
    pub cats_eye: f32,
    /// An image, in whose bright parts light comes in, instead of all that.
    pub image: Option<ApertureImage>,
}

impl Default for Aperture {
    fn default() -> Self {
        Self { blades: 0, rotation_degrees: 0.0, roundness: 0.0, anamorphic: 1.0, cats_eye: 0.0, image: None }
    }
}

impl Aperture {
    /// Why it is none, if so.
    pub fn fault(&self) -> Option<String> {
        let range = |name: &str, value: f32, low: f32, high: f32| {
            (!(low..=high).contains(&value))
                .then(|| format!("{name} is {value}, but must be from {low} to {high}"))
        };
        if self.blades != 0 && !BLADES.contains(&self.blades) {
            let (low, high) = (BLADES.start(), BLADES.end());
            return Some(format!(
                "blades is {}, but must be from {low} to {high}, or 0 for a disc",
                self.blades
            ));
        }
        let shapes = [self.blades != 0, self.cats_eye != 0.0, self.image.is_some()];
        if shapes.into_iter().filter(|chosen| *chosen).count() > 1 {
            return Some("blades, cats-eye and aperture-image are shapes of their own; choose one".into());
        }
        range("blade-rotation", self.rotation_degrees, -360.0, 360.0)
            .or_else(|| range("roundness", self.roundness, 0.0, 1.0))
            .or_else(|| range("anamorphic", self.anamorphic, 0.1, 10.0))
            .or_else(|| range("cats-eye", self.cats_eye, 0.0, 1.0))
    }

    /// Half the width and half the height of an opening of diameter 2.
    pub fn stretch(&self) -> [f64; 2] {
        let ratio = f64::from(self.anamorphic);
        [ratio.recip().min(1.0), ratio.min(1.0)]
    }

    /// The share that is open of a disc of the same diameter, seen from the middle of the picture. The corners of
    /// blades lie on the disc's rim, so three let in 41% of its light, five 76%, six 83% and eight 90%.
    pub fn open_share(&self) -> f64 {
        let [half_width, half_height] = self.stretch();
        let of_disc = match &self.image {
            Some(image) => {
                let longer = f64::from(image.size[0].max(image.size[1]));
                let light: f64 = image.cells.iter().copied().map(f64::from).sum();
                light * (2.0 / longer).powi(2) / PI
            }
            None if self.blades > 0 => {
                let (half, round) = (self.half_blade(), f64::from(self.roundness));
                // Twice the area of half a blade's part: of a triangle, and of a sector of the disc.
                ((1.0 - round) * half.sin() * half.cos() + round * half) / half
            }
            None => 1.0,
        };
        half_width * half_height * of_disc
    }

    /// Half the angle that a blade takes.
    pub fn half_blade(&self) -> f64 {
        PI / f64::from(self.blades)
    }
}

/// Where light comes in, as an image: shared, and equal where it is the same loading.
#[derive(Clone)]
pub struct ApertureImage(Arc<Mask>);

/// Cells, row by row from the upper left as seen from behind the camera, and how much light each lets in.
/// The longer side is the opening's diameter.
pub struct Mask {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Not negative, and not all zero.
    pub cells: Vec<f32>,
    /// The file it is from.
    pub file: String,
}

impl std::fmt::Debug for ApertureImage {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} ({:?} cells)", self.file, self.size)
    }
}

impl PartialEq for ApertureImage {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl std::ops::Deref for ApertureImage {
    type Target = Mask;

    fn deref(&self) -> &Mask {
        &self.0
    }
}

impl ApertureImage {
    /// Reads a PNG: its brightness, times its opacity, is how much light comes in there.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::ApertureImage`] for what is no PNG or lets no light in.
    pub fn read(path: &Path) -> Result<Self> {
        let file = path.display().to_string();
        let fault = |message: String| Error::ApertureImage { file: file.clone(), message };
        let bytes = std::fs::read(path).map_err(|source| Error::Read { path: path.to_path_buf(), source })?;
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader =
            decoder.read_info().map_err(|error| fault(format!("it is not a PNG file: {error}")))?;
        let size = reader.output_buffer_size().ok_or_else(|| fault("it is too large".into()))?;
        let mut pixels = vec![0; size];
        let info = reader.next_frame(&mut pixels).map_err(|error| fault(error.to_string()))?;
        let channels = info.color_type.samples();
        let light = pixels[..info.buffer_size()].chunks_exact(channels).map(|pixel| {
            let level = |channel: usize| f32::from(pixel[channel]) / 255.0;
            match channels {
                1 => level(0),
                2 => level(0) * level(1),
                3 => (level(0) + level(1) + level(2)) / 3.0,
                _ => (level(0) + level(1) + level(2)) / 3.0 * level(3),
            }
        });
        let mask = reduce([info.width, info.height], &light.collect::<Vec<_>>(), file.clone());
        if mask.cells.iter().all(|cell| *cell <= 0.0) {
            return Err(fault("it is black all over, so no light would come in".into()));
        }
        Ok(Self(Arc::new(mask)))
    }
}

/// Means over as many pixels as make at most [`MOST_CELLS`] cells across.
fn reduce([width, height]: [u32; 2], light: &[f32], file: String) -> Mask {
    let step = width.max(height).div_ceil(MOST_CELLS);
    let size = [width.div_ceil(step), height.div_ceil(step)];
    let mut cells = vec![0.0; size[0] as usize * size[1] as usize];
    for (i, light) in (0..).zip(light) {
        let (column, row) = (i % width / step, i / width / step);
        cells[(row * size[0] + column) as usize] += light / (step * step) as f32;
    }
    Mask { size, cells, file }
}
