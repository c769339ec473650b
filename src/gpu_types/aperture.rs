//! Apertures in the form that the shaders read.

use crate::interface::{MAX_BLADES, aperture, constant};
use crate::scene::{ApertureImage, ApertureKind, BLADES, Blades, CatsEye};
use crate::settings::Estimator;
use bytemuck::{Pod, Zeroable};

/// `Aperture` of aperture/record.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct Aperture {
    pub stretch: [f32; 2],
    pub blade_count: f32,
    pub half_blade_angle: f32,
    pub tan_half_blade: f32,
    pub straight_share: f32,
    pub inverse_straight_share: f32,
    pub inverse_round_share: f32,
    pub squared_apothem: f32,
    pub roundness: f32,
    pub cats_eye_shift: f32,
    pub max_cats_eye_shift: f32,
    pub cells: [u32; 2],
    pub shutter: f32,
    pub profile: f32,
    pub axis: [f32; 2],
}

/// `ApertureBuffer` of aperture/record.glsl.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, PartialEq)]
pub struct ApertureBuffer {
    pub shape: Aperture,
    pub edges: [[f32; 2]; MAX_BLADES as usize],
}

/// `APERTURE` of aperture/record.glsl.
pub fn aperture_constant(estimator: &Estimator) -> (u32, u32) {
    let code = match estimator.aperture.kind(estimator.model) {
        ApertureKind::Disc(_) => aperture::DISC,
        ApertureKind::Ellipse(_) => aperture::ELLIPSE,
        ApertureKind::Blades(_) => aperture::BLADES,
        ApertureKind::CatsEye(_) => aperture::CATS_EYE,
        ApertureKind::Image(_) => aperture::IMAGE,
    };
    (constant::APERTURE, code)
}

impl ApertureBuffer {
    /// The aperture of a picture.
    pub fn new(estimator: &Estimator) -> Self {
        let mut stretch = estimator.aperture.stretch();
        let mut shape = Aperture {
            cells: [1, 1],
            shutter: estimator.shutter,
            profile: estimator.aperture.profile_in_use(estimator.model),
            ..Zeroable::zeroed()
        };
        let mut edges = [[0.0; 2]; MAX_BLADES as usize];
        match estimator.aperture.kind(estimator.model) {
            ApertureKind::Disc(_) | ApertureKind::Ellipse(_) => {}
            ApertureKind::Blades(blades) => add_blades(&mut shape, &mut edges, blades),
            ApertureKind::CatsEye(CatsEye { in_corner }) => {
                let [width, height] = estimator.size.map(f64::from);
                let corner = 0.5 * width.hypot(height)
                    / estimator.focused_camera().view_distance_pixels(estimator.size[1]);
                shape.cats_eye_shift = (2.0 * f64::from(in_corner) / corner) as f32;
                shape.max_cats_eye_shift = 2.0 * in_corner;
                let axis = estimator.focal_plane().axis() - estimator.focused_camera().shift();
                shape.axis = axis.as_vec2().to_array();
            }
            ApertureKind::Image(image) => {
                let [columns, rows] = image.size;
                let longer = f64::from(columns.max(rows));
                stretch = [0, 1].map(|axis| stretch[axis] * f64::from(image.size[axis]) / longer);
                shape.cells = image.size;
            }
        }
        shape.stretch = stretch.map(|half| half as f32);
        Self { shape, edges }
    }
}

fn add_blades(shape: &mut Aperture, edges: &mut [[f32; 2]], blades: Blades) {
    let (half, roundness) = (blades.half_angle(), f64::from(blades.roundness));
    // The areas between the middle of an edge and a corner: the polygon's part and the disc's part.
    let polygon = (1.0 - roundness) * half.sin() * half.cos();
    let straight = polygon / (polygon + roundness * half);
    let inverse = |share: f64| if share > 0.0 { share.recip() as f32 } else { 0.0 };
    shape.blade_count = blades.count as f32;
    shape.half_blade_angle = half as f32;
    shape.tan_half_blade = half.tan() as f32;
    shape.straight_share = straight as f32;
    shape.inverse_straight_share = inverse(straight);
    shape.inverse_round_share = inverse(1.0 - straight);
    shape.squared_apothem = ((1.0 - roundness) * half.cos().powi(2)) as f32;
    shape.roundness = blades.roundness;
    for (blade, edge) in (0..blades.count).zip(edges) {
        let angle = f64::from(blades.rotation_degrees).to_radians() + 2.0 * half * f64::from(blade);
        *edge = [angle.cos() as f32, angle.sin() as f32];
    }
}

/// `aperture_sums` of aperture/image.glsl, four sums in a texel.
pub fn aperture_sums(image: &ApertureImage) -> Vec<[f32; 4]> {
    let [columns, _] = image.size;
    let rows: Vec<&[f32]> = image.cells.chunks_exact(columns as usize).collect();
    let light_of_rows = rows.iter().map(|row| row.iter().copied().map(f64::from).sum::<f64>());
    let mut sums = running_sums(light_of_rows);
    for row in rows {
        sums.extend(running_sums(row.iter().copied().map(f64::from)));
    }
    sums.resize(sums.len().next_multiple_of(4), 1.0);
    sums.chunks_exact(4).map(|four| [four[0], four[1], four[2], four[3]]).collect()
}

/// The running sums of the light, divided by the total, so that they go from 0 to 1.
fn running_sums(light: impl Iterator<Item = f64>) -> Vec<f32> {
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

const _: () = assert!(BLADES[1] <= MAX_BLADES);
