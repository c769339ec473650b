//! An image that gives the shape of the aperture. It is read from a PNG row by row, so that a large file needs little
//! memory.

use super::{Kind, Opening};
use crate::error::{Error, Result};
use crate::input_file;
use crate::scene::MAX_EXTENT;
use std::f64::consts::PI;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Images are reduced to at most this many cells on the longer side.
const MAX_CELLS: u32 = 256;
/// An image is drawn with at most this many squares on the longer side.
const MAX_OPENINGS: u32 = 48;
/// The advice for a damaged file.
const ANEW: &str = "save the image anew as a PNG";
/// The value of a white, opaque pixel: the sum of three colours of 255, times an opacity of 255.
const WHITE: u64 = 3 * 255 * 255;

/// A shared image of the aperture. Two are equal if they come from the same loading.
#[derive(Clone)]
pub struct ApertureImage(Arc<Mask>);

/// The amount of light that each cell lets in, row by row from the upper left as seen from behind the camera. The
/// longer side is the diameter of the aperture.
pub struct Mask {
    /// The number of columns and rows.
    pub size: [u32; 2],
    /// The light of each cell: not negative, and not zero in all cells.
    pub cells: Vec<f32>,
    /// The file that it was read from.
    pub file: PathBuf,
}

impl std::fmt::Debug for ApertureImage {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} ({:?} cells)", self.file.display(), self.size)
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

impl Kind for ApertureImage {
    fn relative_area(&self) -> f64 {
        let longer = f64::from(self.size[0].max(self.size[1]));
        let light: f64 = self.cells.iter().copied().map(f64::from).sum();
        light * (2.0 / longer).powi(2) / PI
    }

    fn openings(&self, _film: [f64; 2]) -> Vec<Opening> {
        let [columns, rows] = self.size;
        let longer = f64::from(columns.max(rows));
        let step = columns.max(rows).div_ceil(MAX_OPENINGS);
        let mut openings = Vec::new();
        for (top, left) in (0..rows)
            .step_by(step as usize)
            .flat_map(|y| (0..columns).step_by(step as usize).map(move |x| (y, x)))
        {
            let (bottom, right) = ((top + step).min(rows), (left + step).min(columns));
            let cells = (top..bottom).flat_map(|y| {
                let row = &self.cells[(y * columns) as usize..];
                row[left as usize..right as usize].iter()
            });
            let light = cells.sum::<f32>() / ((bottom - top) * (right - left)) as f32;
            let x = [left, right].map(|x| (2.0 * f64::from(x) - f64::from(columns)) / longer);
            let y = [bottom, top].map(|y| (f64::from(rows) - 2.0 * f64::from(y)) / longer);
            let corners = vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
            if light > 0.0 {
                openings.push(Opening { corners, light });
            }
        }
        openings
    }
}

impl ApertureImage {
    /// Reads a PNG. The light that a pixel lets in is its brightness times its opacity.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Image`] for a file that is not a PNG, is too large, or lets in no light.
    pub fn read(path: &Path) -> Result<Self> {
        let error = |message: String| Error::Image { file: path.display().to_string(), message };
        let (file, beginning) = input_file::open_with_beginning(path)?;
        let kind = input_file::kind(&beginning);
        if kind != Some(input_file::PNG) {
            let is = kind.map_or_else(String::new, |kind| format!(": it is {kind}"));
            return Err(error(format!("it is not a PNG file{is}; {ANEW}")));
        }
        let cells = input_file::guarded(|| decode(file));
        let (size, cells) = cells.unwrap_or_else(|| Err(format!("it is damaged; {ANEW}"))).map_err(error)?;
        if cells.iter().all(|cell| *cell <= 0.0) {
            return Err(error("it is black all over, so no light would come in".into()));
        }
        Ok(Self(Arc::new(Mask { size, cells, file: path.to_path_buf() })))
    }
}

/// The number of columns and rows, and the cells. Each is the mean of a square of pixels, so large that there are at
/// most [`MAX_CELLS`] cells on the longer side.
fn decode(file: File) -> std::result::Result<([u32; 2], Vec<f32>), String> {
    let damaged = |error: png::DecodingError| format!("it is damaged ({error}); {ANEW}");
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let header = decoder.read_header_info().map_err(damaged)?;
    let ([width, height], interlaced) = ([header.width, header.height], header.interlaced);
    if width.max(height) > MAX_EXTENT {
        return Err(format!(
            "it has {width} x {height} pixels, and may have {MAX_EXTENT} at most either way; make it \
             smaller, for its light is averaged over {MAX_CELLS} x {MAX_CELLS} cells"
        ));
    }
    let mut reader = decoder.read_info().map_err(damaged)?;
    let channels = reader.output_color_type().0.samples();
    let step = width.max(height).div_ceil(MAX_CELLS);
    let size = [width.div_ceil(step), height.div_ceil(step)];
    // The sums are whole numbers, so they do not depend on the order: an interlaced image gives the same cells.
    let mut sums = vec![0_u64; size[0] as usize * size[1] as usize];
    for Row { y, first, stride } in rows([width, height], interlaced) {
        let row = reader.next_row().map_err(damaged)?.ok_or_else(|| format!("it is damaged; {ANEW}"))?;
        let cells = &mut sums[(y / step * size[0]) as usize..];
        for (x, pixel) in (first..).step_by(stride).zip(row.data().chunks_exact(channels)) {
            let level = |channel: usize| u64::from(pixel[channel]);
            cells[(x / step) as usize] += match channels {
                1 => 3 * level(0) * 255,
                2 => 3 * level(0) * level(1),
                3 => (level(0) + level(1) + level(2)) * 255,
                _ => (level(0) + level(1) + level(2)) * level(3),
            };
        }
    }
    let whole = (WHITE * u64::from(step) * u64::from(step)) as f64;
    Ok((size, sums.into_iter().map(|sum| (sum as f64 / whole) as f32).collect()))
}

/// A row in the file: the pixels of row `y` from the first column on, at equal steps.
struct Row {
    y: u32,
    first: u32,
    stride: usize,
}

/// The rows of an image, in the order of the file.
fn rows([width, height]: [u32; 2], interlaced: bool) -> Vec<Row> {
    /// For each pass, the first column and row and the steps to the next ones (PNG specification, 8.2).
    const ADAM7: [[u32; 4]; 7] =
        [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
    let passes = if interlaced { &ADAM7[..] } else { &[[0, 0, 1, 1]] };
    let of_pass = |[first, top, stride, down]: &[u32; 4]| {
        let (first, stride) = (*first, *stride as usize);
        let height = if first < width { height } else { 0 };
        (*top..height).step_by(*down as usize).map(move |y| Row { y, first, stride })
    };
    passes.iter().flat_map(of_pass).collect()
}
