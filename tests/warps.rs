//! The maps from sample values to places on the film and on the lens.

mod common;

use anyhow::{Result, ensure};
use bytemuck::Zeroable;
use common::probe::{STEP, Values, disk, warp};
use common::scenes::FIXED_POINTS;
use common::{Gpu, prove};
use std::f64::consts::FRAC_PI_4;
use thinlens::reference::sampler;

/// Points of the unit square, `n` by `n`, edges and diagonals among them. 1 / (n - 1) must be exact.
fn grid(n: u32) -> Vec<[f64; 2]> {
    let at = |i: u32| f64::from(i) / f64::from(n - 1);
    (0..n).flat_map(|y| (0..n).map(move |x| [at(x), at(y)])).collect()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Catches a disk map that is not Shirley and Chiu's: centre, axes and corners are known; the inverse
/// leads back to the square from everywhere, which a folded map's does not; and no point leaves the
/// disk.
#[test]
fn the_disk_map_is_concentric_and_has_an_inverse() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (squares, expected): (Vec<_>, Vec<_>) = FIXED_POINTS.into_iter().unzip();
        for ((square, expected), got) in squares.iter().zip(expected).zip(disk(gpu, &squares)) {
            ensure!(distance(got, expected) < 2e-7, "{square:?} goes to {got:?}, not {expected:?}");
        }
        let squares = grid(513);
        let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
        for (square, got) in squares.iter().zip(disk(gpu, &squares)) {
            largest = largest.max(got[0].hypot(got[1]));
            worst = worst.max(distance(inverse(got), *square));
            ensure!(largest <= 1.0 + 1e-6, "{square:?} leaves the disk: {got:?}");
            ensure!(
                distance(got, sampler::concentric_disk(*square)) < 1e-6,
                "{square:?} is not the oracle's"
            );
            ensure!(worst < 1e-6, "{square:?} goes to {got:?}, which comes from {:?}", inverse(got));
        }
        Ok(format!("10 fixed points, {} points back within {worst:.1e}, r <= {largest:.7}", squares.len()))
    };
    prove(check, &["disk"]);
}

/// Shirley and Chiu's map, the other way.
fn inverse([x, y]: [f64; 2]) -> [f64; 2] {
    let radius = x.hypot(y);
    let (a, b) = if x.abs() >= y.abs() {
        let signed = radius.copysign(x);
        (signed, if x == 0.0 { 0.0 } else { signed * (y / x).atan() / FRAC_PI_4 })
    } else {
        let signed = radius.copysign(y);
        (signed * (x / y).atan() / FRAC_PI_4, signed)
    };
    [0.5 * (a + 1.0), 0.5 * (b + 1.0)]
}

/// Catches a map that tears at the sectors' boundaries: neighbours in the square are neighbours on
/// the disk. Along an axis the map stretches by sqrt(1 + (pi / 4)^2) at most, times 2 from the unit
/// square.
#[test]
fn the_disk_map_is_continuous_across_sectors() {
    let check = |gpu: &Gpu| -> Result<String> {
        const N: usize = 513;
        let points = disk(gpu, &grid(513));
        let spacing = 1.0 / (N - 1) as f64;
        let limit = 2.0 * FRAC_PI_4.hypot(1.0) * spacing + 1e-6;
        let mut widest = 0.0_f64;
        for (x, y) in (1..N).flat_map(|y| (1..N).map(move |x| (x, y))) {
            for neighbour in [y * N + x - 1, (y - 1) * N + x] {
                let step = distance(points[y * N + x], points[neighbour]);
                widest = widest.max(step);
                ensure!(step < limit, "a step of {step} at column {x}, row {y}");
            }
        }
        // Right at the diagonals, as close as f32 comes.
        let near = |t: f64, side: f64| [[t, t + side * STEP], [t, 1.0 - t + side * STEP]];
        let of_side = |side: f64| (1..256).flat_map(|i| near(f64::from(i) / 256.0, side)).collect::<Vec<_>>();
        for (a, b) in disk(gpu, &of_side(-1.0)).into_iter().zip(disk(gpu, &of_side(1.0))) {
            ensure!(distance(a, b) < 1e-6, "{a:?} and {b:?} lie on the two sides of a diagonal");
        }
        Ok(format!("steps of {spacing:.5} become {widest:.5} at most, {limit:.5} allowed"))
    };
    prove(check, &["disk_sector_mirrored", "disk_angle_doubled", "disk_sectors_swapped"]);
}

/// Catches samples that land one pixel off at the edge of a pixel, to either side, and jitter of the
/// wrong width: the floor of exact numbers decides, but for places so near a pixel's edge that f32
/// cannot tell; and the reach that accumulation looks around is enough.
#[test]
fn samples_land_where_their_offset_says() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut compared = 0;
        for jitter in [0.0_f32, 1.0, 2.2, 3.0, 15.0] {
            let reach = thinlens::renderer::schedule::reach(jitter);
            // The ends, what lies next to each pixel's edge, and a grid.
            let edges = (-8..8).map(|edge| (f64::from(edge) + 0.5) / f64::from(jitter.max(1.0)) + 0.5);
            let near = edges.flat_map(|edge| [edge - STEP, edge, edge + STEP]);
            let places: Vec<_> = (near.chain((0..1000).map(|i| f64::from(i) / 1000.0)))
                .map(|xi| (xi / STEP).round().clamp(0.0, 16_777_215.0) * STEP)
                .collect();
            let values: Vec<_> = (places.iter())
                .map(|xi| Values { film: [*xi as f32, 1.0 - *xi as f32], jitter, ..Zeroable::zeroed() })
                .collect();
            for (values, warped) in values.iter().zip(warp(gpu, &values)) {
                for axis in 0..2 {
                    let offset = (f64::from(values.film[axis]) - 0.5) * f64::from(jitter);
                    ensure!((f64::from(warped.offset[axis]) - offset).abs() < 1e-6, "{values:?}: {warped:?}");
                    let at_edge = (offset + 0.5 - (offset + 0.5).round()).abs() < 1e-6;
                    let landing = f64::from(warped.landing[axis]);
                    let below = (offset + 0.5).floor();
                    ensure!(
                        landing == below
                            || at_edge && [0.0, 1.0].contains(&((offset + 0.5).round() - landing)),
                        "{values:?}: {warped:?}"
                    );
                    ensure!(
                        warped.landing[axis].unsigned_abs() <= reach || values.film[axis] == 1.0,
                        "{values:?}"
                    );
                }
                compared += 1;
            }
        }
        Ok(format!("{compared} places"))
    };
    prove(check, &["landing"]);
}
