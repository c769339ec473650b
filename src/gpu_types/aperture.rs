//! The opening as the shaders want it.

use crate::interface::{self, constant};
use crate::scene::{self, ApertureImage, CameraModel};
use crate::settings::Estimator;
use bytemuck::{Pod, Zeroable};

/// `Aperture` of aperture.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct Aperture {
    pub stretch: [f32; 2],
    pub blade_count: f32,
    pub half_blade: f32,
    pub tangent: f32,
    pub straight: f32,
    pub inverse_straight: f32,
    pub inverse_bent: f32,
    pub straight_square: f32,
    pub roundness: f32,
    pub cats_eye: f32,
    pub most_cats_eye: f32,
    pub cells: [u32; 2],
    pub shutter: f32,
    pub pad0: u32,
}

/// `ApertureBuffer` of aperture.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct ApertureBuffer {
    pub shape: Aperture,
    pub edges: [[f32; 2]; interface::MOST_BLADES as usize],
}

/// `APERTURE` of aperture.glsl.
pub fn aperture_constant(estimator: &Estimator) -> (u32, u32) {
    use interface::aperture::{BLADES, CATS_EYE, DISC, ELLIPSE, IMAGE};
    let aperture = &estimator.aperture;
    let code = match estimator.model {
        CameraModel::Pinhole => DISC,
        _ if aperture.image.is_some() => IMAGE,
        _ if aperture.blades > 0 => BLADES,
        // A hole has no front rim.
        CameraModel::ThinLens if aperture.cats_eye > 0.0 => CATS_EYE,
        _ if aperture.anamorphic != 1.0 => ELLIPSE,
        _ => DISC,
    };
    (constant::APERTURE, code)
}

impl ApertureBuffer {
    /// The opening of a picture.
    pub fn new(estimator: &Estimator) -> Self {
        let aperture = &estimator.aperture;
        let [width, height] = estimator.size.map(f64::from);
        let corner = 0.5 * width.hypot(height) / estimator.camera.view_distance_pixels(estimator.size[1]);
        let mut stretch = aperture.stretch();
        let cells = aperture.image.as_ref().map_or([1, 1], |image| image.size);
        if aperture.image.is_some() {
            let longer = f64::from(cells[0].max(cells[1]));
            stretch = [0, 1].map(|axis| stretch[axis] * f64::from(cells[axis]) / longer);
        }
        let mut shape = Aperture {
            stretch: stretch.map(|half| half as f32),
            cats_eye: (2.0 * f64::from(aperture.cats_eye) / corner) as f32,
            most_cats_eye: 2.0 * aperture.cats_eye,
            cells,
            shutter: estimator.shutter,
            ..Zeroable::zeroed()
        };
        let mut edges = [[0.0; 2]; interface::MOST_BLADES as usize];
        if aperture.blades > 0 {
            let (half, roundness) = (aperture.half_blade(), f64::from(aperture.roundness));
            // Areas between a middle and a corner, of the polygon's part and the disc's.
            let polygon = (1.0 - roundness) * half.sin() * half.cos();
            let straight = polygon / (polygon + roundness * half);
            let inverse = |share: f64| if share > 0.0 { share.recip() as f32 } else { 0.0 };
            shape.blade_count = aperture.blades as f32;
            shape.half_blade = half as f32;
            shape.tangent = half.tan() as f32;
            shape.straight = straight as f32;
            shape.inverse_straight = inverse(straight);
            shape.inverse_bent = inverse(1.0 - straight);
            shape.straight_square = ((1.0 - roundness) * half.cos().powi(2)) as f32;
            shape.roundness = aperture.roundness;
            for (blade, edge) in (0..aperture.blades).zip(&mut edges) {
                let angle = f64::from(aperture.rotation_degrees).to_radians() + 2.0 * half * f64::from(blade);
                *edge = [angle.cos() as f32, angle.sin() as f32];
            }
        }
        Self { shape, edges }
    }
}

/// `aperture_sums` of aperture.glsl: four a texel.
pub fn aperture_sums(image: &ApertureImage) -> Vec<[f32; 4]> {
    let [columns, _] = image.size;
    let rows: Vec<&[f32]> = image.cells.chunks_exact(columns as usize).collect();
    let light_of_rows = rows.iter().map(|row| row.iter().copied().map(f64::from).sum::<f64>());
    let mut sums = running(light_of_rows);
    for row in rows {
        sums.extend(running(row.iter().copied().map(f64::from)));
    }
    sums.resize(sums.len().next_multiple_of(4), 1.0);
    sums.chunks_exact(4).map(|four| [four[0], four[1], four[2], four[3]]).collect()
}

/// From 0 to 1.
fn running(light: impl Iterator<Item = f64>) -> Vec<f32> {
    let mut sum = 0.0;
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(light.map(|light| {
            sum += light;
            sum
        }))
        .collect();
    let all = if sum > 0.0 { sum } else { 1.0 };
    sums.iter().map(|sum| (sum / all) as f32).collect()
}

const _: () = assert!(*scene::BLADES.end() <= interface::MOST_BLADES);
