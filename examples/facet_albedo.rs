//! Makes `shaders/facet_albedo.bin`, the table of what rough surfaces reflect:
//! `cargo run --release --example facet_albedo`. It takes some seconds.
//!
//! A node of the table says which share of the light from one direction leaves a surface of many small facets (see
//! `shaders/material/microfacet.glsl`) after a single reflection: if each facet reflects all of the light, and if it
//! reflects the share `(1 - cos)^5`, where `cos` is that of the angle between light and facet. The share for any
//! reflectance of C. Schlick's form is a sum of these two.
//!
//! The nodes are evenly spaced in the square root of the cosine of the direction, and in the roughness. The shaders
//! interpolate between them. At the end the error of the interpolation is printed.
//!
//! A second table has the share of light that leaves the facets of glass after a single reflection or refraction. Its third
//! axis is that of the refractive index.

use fastrand::Rng;
use std::f64::consts::PI;

/// Nodes for the roughness, one for each row.
const ROWS: usize = 32;
/// Nodes for the cosine. More of them are needed, because smooth surfaces change fast near the horizon.
const COLUMNS: usize = 64;
/// Points of the midpoint rule, along each axis.
const POINTS: usize = 256;
/// Nodes along each axis of the table of glass.
const OF_GLASS: usize = 17;
/// The indices of glass, beyond the surface relative to this side, are those up to this one, and their inverses.
const MOST_INDEX: f64 = 4.0;

/// The share for facets that reflect everything, and for facets that reflect `(1 - cos)^5`.
type Shares = [f64; 2];

fn main() {
    let place = |node: usize, nodes: usize| node as f64 / (nodes - 1) as f64;
    let row = |row: usize| -> Vec<Shares> {
        let roughness = place(row, ROWS);
        (0..COLUMNS).map(|column| shares(place(column, COLUMNS).powi(2), roughness)).collect()
    };
    let rows: Vec<Vec<Shares>> = (0..ROWS).map(row).collect();
    let means: Vec<Shares> = rows.iter().map(|row| mean(row)).collect();

    // A texel has the corners of a cell between four nodes. The last texel of each row has the means over all directions.
    let mut bytes = Vec::new();
    for row in 0..ROWS - 1 {
        for column in 0..COLUMNS - 1 {
            for (row, column) in [(row, column), (row, column + 1), (row + 1, column), (row + 1, column + 1)]
            {
                bytes.extend(rows[row][column].map(rounded).concat());
            }
        }
        for row in [row, row, row + 1, row + 1] {
            bytes.extend(means[row].map(rounded).concat());
        }
    }
    let glass = glass_table();
    bytes.extend(glass_cells(&glass));
    std::fs::write("shaders/facet_albedo.bin", &bytes).expect("the table is written");

    let mut rng = Rng::with_seed(1);
    let (mut worst, mut sum) = ([0.0_f64; 2], [0.0; 2]);
    const PLACES: usize = 500;
    for _ in 0..PLACES {
        let (cosine, roughness) = (0.01 + 0.99 * rng.f64(), 0.03 + 0.97 * rng.f64());
        let exact = shares(cosine, roughness);
        let found = interpolated(&rows, cosine, roughness);
        for of in 0..2 {
            let error = (found[of] - exact[of]).abs();
            worst[of] = worst[of].max(error);
            sum[of] += error;
        }
    }
    let means = sum.map(|sum| sum / PLACES as f64);
    println!("{} bytes; off by {worst:.5?} at most, by {means:.5?} in the mean", bytes.len());
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for _ in 0..PLACES {
        let [first, second, third] = [rng.f64(), rng.f64(), rng.f64()];
        let (cosine, roughness) = (0.01 + 0.99 * first, 0.03 + 0.97 * second);
        let index = (1.0 + 1.5 * third).powi(if rng.bool() { 1 } else { -1 });
        let error = (glass_interpolated(&glass, [cosine.sqrt(), roughness, place_of_index(index)])
            - glass_share(cosine, roughness, index))
        .abs();
        worst = worst.max(error);
        sum += error;
    }
    println!("glass: off by {worst:.5} at most, by {:.5} in the mean", sum / PLACES as f64);
}

/// The shares of glass at the nodes: first those of the next index, then of the next roughness, then of the next cosine.
fn glass_table() -> Vec<f64> {
    let place = |node: usize| node as f64 / (OF_GLASS - 1) as f64;
    let share = |node: usize| {
        let index = index_at(place(node % OF_GLASS));
        glass_share(place(node / OF_GLASS / OF_GLASS).powi(2), place(node / OF_GLASS % OF_GLASS), index)
    };
    (0..OF_GLASS.pow(3)).map(share).collect()
}

/// A texel for each cell, which has its eight corners.
fn glass_cells(table: &[f64]) -> Vec<u8> {
    let cells = OF_GLASS - 1;
    let corners = |cell: usize| {
        let first = [cell / cells / cells, cell / cells % cells, cell % cells];
        (0..8).flat_map(move |corner: usize| rounded(table[node_of_glass(first, corner)]))
    };
    (0..cells.pow(3)).flat_map(corners).collect()
}

/// The node at a corner of a cell.
fn node_of_glass([cosine, roughness, index]: [usize; 3], corner: usize) -> usize {
    let along = |at: usize, axis: usize| at + (corner >> axis & 1);
    (along(cosine, 2) * OF_GLASS + along(roughness, 1)) * OF_GLASS + along(index, 0)
}

fn glass_interpolated(table: &[f64], place: [f64; 3]) -> f64 {
    let place = place.map(|place| place * (OF_GLASS - 1) as f64);
    let cell = place.map(|place| (place as usize).min(OF_GLASS - 2));
    let weight = |corner: usize, axis: usize| {
        let across = place[axis] - cell[axis] as f64;
        if corner >> (2 - axis) & 1 == 1 { across } else { 1.0 - across }
    };
    let share = |corner: usize| {
        let weight: f64 = (0..3).map(|axis| weight(corner, axis)).product();
        weight * table[node_of_glass(cell, corner)]
    };
    (0..8).map(share).sum()
}

/// The nodes are even in the fourth root of what is reflected at a right angle, with a sign: so they are close to each other
/// near the index 1, where the share changes fast.
fn index_at(place: f64) -> f64 {
    let most = (MOST_INDEX - 1.0) / (MOST_INDEX + 1.0);
    let side = 2.0 * place - 1.0;
    let root = most * side * side.abs();
    (1.0 + root) / (1.0 - root)
}

fn place_of_index(index: f64) -> f64 {
    let most = (MOST_INDEX - 1.0) / (MOST_INDEX + 1.0);
    let root = (index - 1.0) / (index + 1.0) / most;
    0.5 + 0.5 * root.abs().sqrt().copysign(root)
}

/// A share in 16 bits.
fn rounded(share: f64) -> [u8; 2] {
    ((share * 65535.0).round() as u16).to_le_bytes()
}

/// The mean over all directions that light comes from evenly, which weighs each by its cosine. Between the nodes, which
/// are even in the root `u` of the cosine, the shares are linear in `u`: so this is the integral of `4 u^3 share(u)`.
fn mean(row: &[Shares]) -> Shares {
    let step = 1.0 / (COLUMNS - 1) as f64;
    let mut sum = [0.0; 2];
    for (cell, ends) in row.windows(2).enumerate() {
        // The integral of 4 u^3 times each of the two linear weights of the cell.
        let (from, to) = (cell as f64 * step, (cell + 1) as f64 * step);
        let all = to.powi(4) - from.powi(4);
        let to_end = (0.8 * (to.powi(5) - from.powi(5)) - from * all) / step;
        for of in 0..2 {
            sum[of] += ends[0][of] * (all - to_end) + ends[1][of] * to_end;
        }
    }
    sum
}

fn interpolated(rows: &[Vec<Shares>], cosine: f64, roughness: f64) -> Shares {
    let place = |value: f64, nodes: usize| {
        let place = value * (nodes - 1) as f64;
        let cell = (place as usize).min(nodes - 2);
        (cell, place - cell as f64)
    };
    let ((column, across), (row, down)) = (place(cosine.sqrt(), COLUMNS), place(roughness, ROWS));
    [0, 1].map(|of| {
        let along = |row: usize| rows[row][column][of] * (1.0 - across) + rows[row][column + 1][of] * across;
        along(row) * (1.0 - down) + along(row + 1) * down
    })
}

/// The shares of light with this cosine.
fn shares(cosine: f64, roughness: f64) -> Shares {
    if roughness == 0.0 {
        return [1.0, (1.0 - cosine).powi(5)];
    }
    mean_over_facets(cosine, roughness, |cosine, alpha, [between, facet]| {
        let reflected = unblocked(cosine, 2.0 * between * facet - cosine, alpha);
        [reflected, reflected * (1.0 - between).powi(5)]
    })
}

/// The share of light with this cosine that leaves the facets of glass.
fn glass_share(cosine: f64, roughness: f64, index: f64) -> f64 {
    if roughness == 0.0 {
        return 1.0;
    }
    let [share, _] = mean_over_facets(cosine, roughness, |cosine, alpha, [between, facet]| {
        let reflected = unblocked(cosine, 2.0 * between * facet - cosine, alpha);
        let squared = 1.0 - (1.0 - between * between) / (index * index);
        if squared <= 0.0 {
            return [reflected, 0.0];
        }
        // A. Fresnel's laws.
        let beyond = squared.sqrt();
        let parallel = (index * between - beyond) / (index * between + beyond);
        let perpendicular = (between - index * beyond) / (between + index * beyond);
        let reflectance = 0.5 * (parallel * parallel + perpendicular * perpendicular);
        let down = cosine / index - (between / index - beyond) * facet;
        [reflectance * reflected + (1.0 - reflectance) * unblocked(cosine, down, alpha), 0.0]
    });
    share
}

/// The mean over the facets that light with this cosine meets: E. Heitz and E. d'Eon, "Importance Sampling
/// Microfacet-Based BSDFs using the Distribution of Visible Normals", CGF 33(4), 2014. If the slopes are scaled by
/// `1 / alpha`, these facets form a cap of the unit sphere: J. Dupuy and A. Benyoub, CGF 42(8), 2023.
///
/// `share` gets the cosine, alpha, and the cosines of the angles between facet and light and between facet and surface.
fn mean_over_facets(cosine: f64, roughness: f64, share: impl Fn(f64, f64, [f64; 2]) -> Shares) -> Shares {
    let alpha = roughness * roughness;
    // At 0 itself the slope would be infinite.
    let cosine = cosine.max(1e-5);
    let sine = (1.0 - cosine * cosine).sqrt();
    let length = (alpha * sine).hypot(cosine);
    let (along, up) = (alpha * sine / length, cosine / length);
    let mut sum = [0.0; 2];
    for first in 0..POINTS {
        // The share of the cap above, with more points at both ends, where the integrand bends most.
        let (above, weight) = eased((first as f64 + 0.5) / POINTS as f64);
        let height = 1.0 - above * (1.0 + up);
        let radius = (1.0 - height * height).max(0.0).sqrt();
        for second in 0..POINTS {
            let (half_turn, weight_of_turn) = eased((second as f64 + 0.5) / POINTS as f64);
            let (sine_of_turn, cosine_of_turn) = (PI * half_turn).sin_cos();
            let facet =
                [alpha * (radius * cosine_of_turn + along), alpha * radius * sine_of_turn, height + up];
            let length = facet.iter().map(|part| part * part).sum::<f64>().sqrt();
            let (x, z) = (facet[0] / length, facet[2] / length);
            let shares = share(cosine, alpha, [(sine * x + cosine * z).min(1.0), z]);
            for of in 0..2 {
                sum[of] += weight * weight_of_turn * shares[of];
            }
        }
    }
    sum.map(|sum| sum / (POINTS * POINTS) as f64)
}

/// Maps the unit interval to itself, with small steps at both ends: the value, and its derivative.
fn eased(t: f64) -> (f64, f64) {
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t))
}

/// The share of light that no facet blocks on its way out, in a direction with the cosine `out`.
fn unblocked(cosine: f64, out: f64, alpha: f64) -> f64 {
    if out <= 0.0 {
        return 0.0;
    }
    (1.0 + hidden(cosine, alpha)) / (1.0 + hidden(cosine, alpha) + hidden(out, alpha))
}

/// The area of facets that others hide in a direction with this cosine, relative to what can be seen.
fn hidden(cosine: f64, alpha: f64) -> f64 {
    let squared_slope = alpha * alpha * (1.0 - cosine * cosine).max(0.0) / (cosine * cosine);
    0.5 * ((1.0 + squared_slope).sqrt() - 1.0)
}
