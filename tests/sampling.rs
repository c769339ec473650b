//! The sampler, and what becomes of its values: places on the film and on the lens.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::probe::{probe, probe_as};
use common::scenes::FIXED_POINTS;
use common::statistics::{evenness_p, normal_p, sidak};
use common::{Gpu, prove};
use std::collections::{HashMap, HashSet};
use std::f64::consts::{FRAC_PI_4, TAU};
use thinlens::reference::sampler;
use thinlens::settings::Sampler;

/// Sample values are multiples of this.
const STEP: f64 = 1.0 / 16_777_216.0;

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Index {
    pixel: [u32; 2],
    sample_index: u32,
    seed: u32,
}

const SAMPLERS: [Sampler; 2] = [Sampler::Random, Sampler::Sobol];

/// The device's sample values, in multiples of [`STEP`].
fn bits(gpu: &Gpu, sampler: Sampler, indices: &[Index]) -> Vec<[u32; 4]> {
    probe_as(gpu, "sampler", sampler, None, &[], indices)
}

fn indices(size: [u32; 2], sample_index: u32, seed: u32) -> Vec<Index> {
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    pixels.map(|pixel| Index { pixel, sample_index, seed }).collect()
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Values {
    film: [f32; 2],
    lens: [f32; 2],
    jitter: f32,
    pad0: u32,
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Warped {
    offset: [f32; 2],
    landing: [i32; 2],
    disk: [f32; 2],
}

fn warp(gpu: &Gpu, values: &[Values]) -> Vec<Warped> {
    probe(gpu, "warps", None, &[], values)
}

/// The device's disk map.
fn disk(gpu: &Gpu, squares: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let values: Vec<_> = (squares.iter())
        .map(|square| Values { lens: square.map(|value| value as f32), ..Zeroable::zeroed() })
        .collect();
    warp(gpu, &values).iter().map(|warped| warped.disk.map(f64::from)).collect()
}

/// Points of the unit square, `n` by `n`, edges and diagonals among them. 1 / (n - 1) must be exact.
fn grid(n: u32) -> Vec<[f64; 2]> {
    let at = |i: u32| f64::from(i) / f64::from(n - 1);
    (0..n).flat_map(|y| (0..n).map(move |x| [at(x), at(y)])).collect()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Catches a hash that differs between the shaders and the oracle in any bit that is used.
#[test]
fn sample_values_are_the_oracles_to_the_bit() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut compared = 0;
        for sampler in SAMPLERS {
            let some = [(0, 0), (0, 1), (77, 0xffff_ffff), ((1 << 24) - 1, 7)];
            for (sample_index, seed) in some.into_iter().chain((0..24).map(|bit| (1 << bit, bit))) {
                let indices = indices([50, 50], sample_index, seed);
                for (index, values) in indices.iter().zip(bits(gpu, sampler, &indices)) {
                    let expected = sampler::sample_values(sampler, seed, index.pixel, sample_index, 0);
                    let same = values.map(|value| f64::from(value) * STEP) == expected;
                    ensure!(same, "{sampler:?}, {index:?}: {values:?}");
                    compared += 4;
                }
            }
        }
        Ok(format!("{compared} sample values, none differs"))
    };
    prove(
        check,
        &[
            "hash_without_its_fold",
            "sampler_without_seed",
            "sampler_without_pixel",
            "sobol_without_pixel",
            "sobol_one_dimension_twice",
            "sobol_high_directions_swapped",
            "scramble_off_by_a_constant",
        ],
    );
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
    prove(
        check,
        &["disk_by_polar_angle", "disk_sector_mirrored", "disk_angle_doubled", "disk_radius_squared"],
    );
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

/// Catches a disk map that clusters: the device's own samples fill cells of equal area equally, and
/// their moments are those of a uniform disk, 0 and 1/4.
#[test]
fn lens_points_fill_the_disk_evenly() {
    const RINGS: usize = 8;
    const SECTORS: usize = 16;
    let check = |gpu: &Gpu| -> Result<String> {
        let squares: Vec<_> = (0..4)
            .flat_map(|sample_index| {
                bits(gpu, Sampler::Random, &indices([256, 256], sample_index, 0xdead_beef))
            })
            .map(|values| [values[2], values[3]].map(|value| f64::from(value) * STEP))
            .collect();
        let mut cells = [0; RINGS * SECTORS];
        let mut sums = [0.0; 5];
        for [x, y] in disk(gpu, &squares) {
            let ring = (((x * x + y * y) * RINGS as f64) as usize).min(RINGS - 1);
            let sector = (((y.atan2(x) / TAU + 0.5) * SECTORS as f64) as usize).min(SECTORS - 1);
            cells[ring * SECTORS + sector] += 1;
            for (sum, value) in sums.iter_mut().zip([x, y, x * x - 0.25, y * y - 0.25, x * y]) {
                *sum += value;
            }
        }
        let p = evenness_p(&cells);
        ensure!(p > sidak(6), "cells of equal area are unequally full: p = {p:.1e}");
        // Variances of a uniform disk: of x 1/4, of x^2 1/16, of x y 1/24.
        let variances = [1.0 / 4.0, 1.0 / 4.0, 1.0 / 16.0, 1.0 / 16.0, 1.0 / 24.0];
        let mut least = 1.0_f64;
        for (sum, variance) in sums.iter().zip(variances) {
            ensure!(sum.is_finite(), "a point that is no number");
            least = least.min(normal_p(sum / (variance * squares.len() as f64).sqrt()));
            ensure!(least > sidak(6), "the moments {sums:?} of {} points are off", squares.len());
        }
        Ok(format!(
            "{} points in {} cells, p = {p:.2}; five moments, least p = {least:.2}",
            squares.len(),
            cells.len()
        ))
    };
    prove(check, &["disk_by_polar_angle", "disk_radius_squared", "values_lose_bits"]);
}

/// Catches one random number used twice: film and lens, one sample and another, one frame's first
/// sample and the next one's, a pixel and its neighbours (and the same place in the next workgroup),
/// one seed and the next. Every pair of dimensions is held against independence by its correlation
/// and by the evenness of its joint distribution.
#[test]
fn dimensions_samples_frames_pixels_and_seeds_are_independent() {
    const WIDTH: usize = 256;
    const CELLS: usize = 8;
    let check = |gpu: &Gpu, sampler: Sampler| -> Result<String> {
        let values = |sample_index, seed| bits(gpu, sampler, &indices([256, 256], sample_index, seed));
        let base = values(16, 5);
        // Pairs that share no pixel: of the pixels in every other block of the step's size.
        let neighbours = |dx: usize, dy: usize| -> Vec<_> {
            let even = |at: usize, step: usize| step == 0 || (at / step).is_multiple_of(2);
            let fits = |index: &usize| {
                let (x, y) = (index % WIDTH, index / WIDTH);
                x + dx < WIDTH && y + dy < WIDTH && if dx > 0 { even(x, dx) } else { even(y, dy) }
            };
            (0..base.len()).filter(fits).map(|index| (base[index], base[index + dy * WIDTH + dx])).collect()
        };
        let with = |other: Vec<[u32; 4]>| base.iter().copied().zip(other).collect::<Vec<_>>();
        let relations = [
            ("itself", with(base.clone())),
            ("the next sample", with(values(17, 5))),
            ("the next frame's sample", with(values(32, 5))),
            ("a far sample", with(values(16 + (1 << 20), 5))),
            ("the next seed", with(values(16, 6))),
            ("the right neighbour", neighbours(1, 0)),
            ("the lower neighbour", neighbours(0, 1)),
            ("the diagonal neighbour", neighbours(1, 1)),
            ("the next workgroup", neighbours(8, 0)),
        ];
        // A pixel's samples keep apart in each dimension of the Sobol sequence. Across dimensions, whose
        // scrambles are independent, two samples are independent too.
        let stratified =
            |name: &str, a: usize, b: usize| sampler == Sampler::Sobol && name.ends_with("sample") && a == b;
        let tests = 2 * (relations.len() * 16 - 4);
        let mut least = 1.0_f64;
        for (name, pairs) in &relations {
            for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
                if *name == "itself" && a == b || stratified(name, a, b) {
                    continue;
                }
                let mut covariance = 0.0;
                let mut cells = [0; CELLS * CELLS];
                for (x, y) in pairs {
                    let (x, y) = (f64::from(x[a]) * STEP, f64::from(y[b]) * STEP);
                    covariance += (x - 0.5) * (y - 0.5);
                    cells[(x * CELLS as f64) as usize * CELLS + (y * CELLS as f64) as usize] += 1;
                }
                // Of independent uniform values, with variances of 1/12.
                let correlated = normal_p(covariance * 12.0 / (pairs.len() as f64).sqrt());
                let uneven = evenness_p(&cells);
                least = least.min(correlated).min(uneven);
                ensure!(
                    least > sidak(tests),
                    "dimension {a} of a sample and {b} of {name}: correlation p = {correlated:.1e}, \
                     evenness p = {uneven:.1e}"
                );
            }
        }
        Ok(format!("{tests} tests, least p = {least:.1e}, {:.1e} allowed", sidak(tests)))
    };
    prove(
        |gpu| check(gpu, Sampler::Random),
        &[
            "lens_values_from_the_film",
            "sampler_without_index",
            "sampler_without_seed",
            "sampler_without_pixel",
            "hash_without_its_rounds",
        ],
    );
    prove(
        |gpu| check(gpu, Sampler::Sobol),
        &[
            "lens_values_from_the_film",
            "sobol_without_pixel",
            "sobol_without_seed",
            "sobol_one_key_for_all",
            "sobol_keys_not_folded",
        ],
    );
}

/// Catches the same jitter in every frame, or in every sixteenth, which would freeze the noise: the
/// set of places in a pixel keeps growing.
#[test]
fn every_sample_has_another_place_in_its_pixel() {
    let check = |gpu: &Gpu| -> Result<String> {
        let indices: Vec<_> =
            (0..4096).map(|sample_index| Index { pixel: [5, 3], sample_index, seed: 9 }).collect();
        for sampler in SAMPLERS {
            let mut seen = HashSet::new();
            for (frame, samples) in bits(gpu, sampler, &indices).chunks(16).enumerate() {
                let before = seen.len();
                seen.extend(samples.iter().map(|values| [values[0], values[1]]));
                let added = seen.len() - before;
                ensure!(added == 16, "{sampler:?}: frame {frame} adds {added} places of 16");
            }
        }
        Ok("4096 places after 256 frames of 16 samples, with each sampler".to_owned())
    };
    prove(
        check,
        &["sampler_without_index", "index_within_the_frame_only", "sobol_index_within_the_frame_only"],
    );
}

/// Catches a Sobol sequence with wrong directions, film and lens that take the same points, and a
/// scramble that does not respect the bits above. The first 2^m samples of a pixel, and every block of
/// 2^m after them, are a net: on the lens each of the 2^m intervals of equal size, whatever their
/// shape, has exactly one point, and so has each strip of each dimension; in all four dimensions each
/// interval of 8 in 2^m has exactly 8, for the quality parameter t of these dimensions is 3.
#[test]
fn sobol_points_fill_every_elementary_interval() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut intervals = 0;
        let mut fill = |block: &[[u32; 4]], splits: [u32; 4], expected: usize| -> Result<()> {
            let mut cells = HashMap::new();
            for values in block {
                let cell = [0, 1, 2, 3].map(|axis| values[axis] >> (24 - splits[axis]));
                *cells.entry(cell).or_insert(0) += 1;
            }
            intervals += cells.len();
            let even = cells.values().all(|count| *count == expected);
            ensure!(even, "{} samples are uneven in intervals of 2^-{splits:?}", block.len());
            Ok(())
        };
        for (pixel, seed) in [([0, 0], 0), ([17, 300], 1), ([4095, 4], 0xdead_beef)] {
            let indices: Vec<_> = (0..4096).map(|sample_index| Index { pixel, sample_index, seed }).collect();
            let values = bits(gpu, Sampler::Sobol, &indices);
            for m in 0..=10_u32 {
                for block in values.chunks(1 << m) {
                    fill(block, [m, 0, 0, 0], 1)?;
                    fill(block, [0, m, 0, 0], 1)?;
                    for across in 0..=m {
                        fill(block, [0, 0, across, m - across], 1)?;
                    }
                    // The film's pair is a net of quality 0 up to eight points, then of 1, and of 2.
                    let t = [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2][m as usize];
                    for across in 0..=m - t {
                        fill(block, [across, m - t - across, 0, 0], 1 << t)?;
                    }
                }
            }
            for block in values.chunks(1 << 9) {
                for (a, b, c) in (0..=6)
                    .flat_map(|a| (0..=6 - a).flat_map(move |b| (0..=6 - a - b).map(move |c| (a, b, c))))
                {
                    fill(block, [a, b, c, 6 - a - b - c], 8)?;
                }
            }
        }
        Ok(format!("{intervals} intervals, each with as many points as it should have"))
    };
    prove(
        check,
        &[
            "sobol_one_dimension_twice",
            "sobol_film_like_the_lens",
            "sobol_directions_cut_short",
            "sobol_directions_of_another_bit",
            "sobol_fourth_of_the_table",
            "scramble_of_the_bits_as_they_are",
        ],
    );
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
    prove(check, &["landing_truncated", "jitter_to_both_sides"]);
}
