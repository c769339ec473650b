//! A sky that an image shows all around.

use crate::scene::{Image, luminance};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// A sky that is an image of all directions, in the equirectangular projection: the columns have equal longitudes, and the rows
/// equal latitudes, from straight up to straight down.
#[derive(Debug, Clone, PartialEq)]
pub struct Panorama {
    /// The image.
    pub image: Image,
    /// What its colours are multiplied by to be radiances.
    pub radiance: f32,
    /// By how much the sky is turned about the vertical, anticlockwise as seen from above. At 0, the middle of the image lies
    /// in the direction -z.
    pub turn_degrees: f32,
    /// The mean of the radiance over all directions.
    pub mean: DVec3,
    /// How probably a direction is chosen from each texel, to sample the light of the sky.
    pub chances: Arc<Chances>,
}

/// A distribution of directions that is about proportional to the light that comes from them. A texel is chosen by its row,
/// and then its column.
#[derive(Debug, PartialEq)]
pub struct Chances {
    /// The probability of each row or one above it.
    pub rows: Vec<f32>,
    /// Of each texel, the probability of its column or one to its left within the row.
    pub columns: Vec<f32>,
}

impl Panorama {
    /// A sky that shows this image.
    pub fn new(image: Image, radiance: f32, turn_degrees: f32) -> Self {
        let chances = Arc::new(Chances::new(&image));
        let [width, height] = image.size;
        let of_row = |y: u32| {
            let sum: DVec3 = (0..width).map(|x| image.color([x, y])).sum();
            0.5 * share_of_sphere(y, height) / f64::from(width) * sum
        };
        let mean = f64::from(radiance) * (0..height).map(of_row).sum::<DVec3>();
        Self { image, radiance, turn_degrees, mean, chances }
    }
}

/// The height of a row on the unit sphere, which is proportional to its solid angle.
fn share_of_sphere(row: u32, rows: u32) -> f64 {
    let latitude = |edge: u32| (PI * f64::from(edge) / f64::from(rows)).cos();
    latitude(row) - latitude(row + 1)
}

impl Chances {
    /// In proportion to the mean luminance of each texel, which is blended with its neighbours as a ray sees it, times its solid
    /// angle.
    fn new(image: &Image) -> Self {
        let [width, height] = image.size;
        let luminance = |x: u32, y: u32| luminance(image.color([x, y]));
        // The mean of linear interpolation over a texel weighs it by 3/4, and its neighbours by 1/8, along each axis.
        let blended = |before: f64, here: f64, after: f64| 0.125 * before + 0.75 * here + 0.125 * after;
        let (mut rows, mut columns) = (Vec::new(), Vec::with_capacity(width as usize * height as usize));
        let mut total = 0.0;
        for y in 0..height {
            let (above, below) = (y.saturating_sub(1), (y + 1).min(height - 1));
            let vertical: Vec<f64> = (0..width)
                .map(|x| blended(luminance(x, above), luminance(x, y), luminance(x, below)))
                .collect();
            let around = |x: u32| vertical[(x % width) as usize];
            let mut sum = 0.0;
            let sums: Vec<f64> = (0..width)
                .map(|x| {
                    sum += blended(around(x + width - 1), around(x), around(x + 1));
                    sum
                })
                .collect();
            columns.extend(sums.iter().map(|before| if sum > 0.0 { (before / sum) as f32 } else { 1.0 }));
            total += sum * share_of_sphere(y, height);
            rows.push(total);
        }
        let rows =
            rows.iter().map(|before| if total > 0.0 { (before / total) as f32 } else { 1.0 }).collect();
        Self { rows, columns }
    }
}
