//! The sampler's values: equal to the oracle's, independent where they should be, even where they can.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::probe::{Index, STEP, disk, indices, probe_as, sample_bits as bits};
use common::statistics::{evenness_p, normal_p, sidak};
use common::{Gpu, prove};
use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;
use thinlens::reference::sampler::{self, Use};
use thinlens::settings::Sampler;

const SAMPLERS: [Sampler; 3] = [Sampler::Random, Sampler::Sobol, Sampler::BlueNoise];

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
    prove(check, &["sample_bits"]);
}

/// The place of a path's decision in the sequences of pixels and seeds.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Decision {
    pixel: [u32; 2],
    sample_index: u32,
    seed: u32,
    bounce: u32,
    of: u32,
}

const USES: [Use; 2] = [Use::Light, Use::Direction];

/// Catches a block that is another's, of a bounce or a use or of film, lens and time; and values that the oracle has not.
/// Of every pair of dimensions of two blocks, all cells of a grid must be about as full as random numbers fill them, at a
/// pixel and over its samples. Numbers that depend on one another leave half of them empty.
#[test]
fn blocks_of_a_path_have_nothing_to_do_with_one_another() {
    const CELLS: usize = 8;
    const COUNT: u32 = 2048;
    // Of random numbers, a cell's count is off by the square root of what is expected. The points of a sequence are not
    // independent of each other, so that some cells may be off together.
    const MOST: f64 = 4.0;
    let places = [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (63, 1)];
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut most, mut pairs) = (0.0_f64, 0);
        for sampler in SAMPLERS {
            for pixel in [[0, 0], [37, 250]] {
                let samples = |bounce: u32, of: u32| -> Vec<_> {
                    let decision = |sample_index| Decision { pixel, sample_index, seed: 5, bounce, of };
                    (0..COUNT).map(decision).collect()
                };
                let questions: Vec<Decision> =
                    places.iter().flat_map(|(bounce, of)| samples(*bounce, *of)).collect();
                let answers: Vec<[u32; 4]> = probe_as(gpu, "path", sampler, None, &[], &questions);
                let values: Vec<[f64; 4]> =
                    answers.iter().map(|values| values.map(|value| f64::from(value) * STEP)).collect();
                for (of, values) in questions.iter().zip(&values) {
                    let use_ = USES[of.of as usize];
                    let expected = sampler::path_values(sampler, 5, pixel, of.sample_index, of.bounce, use_);
                    ensure!(*values == expected, "{sampler:?}, {of:?}: {values:?}, not {expected:?}");
                }
                let camera = |index| sampler::sample_values(sampler, 5, pixel, index, 0);
                let time = |index| [sampler::time_value(sampler, 5, pixel, index); 4];
                let mut blocks: Vec<Vec<[f64; 4]>> =
                    vec![(0..COUNT).map(camera).collect(), (0..COUNT).map(time).collect()];
                blocks.extend(values.chunks(COUNT as usize).map(<[_]>::to_vec));
                for (b, a) in (0..blocks.len()).flat_map(|b| (0..b).map(move |a| (b, a))) {
                    for [x, y] in common::pixels([4, 4]).map(|pair| pair.map(|axis| axis as usize)) {
                        let mut cells = [0; CELLS * CELLS];
                        for (first, second) in blocks[a].iter().zip(&blocks[b]) {
                            let cell = |value: f64| (value * CELLS as f64) as usize;
                            cells[cell(first[x]) * CELLS + cell(second[y])] += 1;
                        }
                        let expected = f64::from(COUNT) / (CELLS * CELLS) as f64;
                        let off = |count: &i32| (f64::from(*count) - expected).powi(2) / expected;
                        let unevenness = cells.iter().map(off).sum::<f64>() / (CELLS * CELLS - 1) as f64;
                        ensure!(
                            unevenness < MOST,
                            "{sampler:?}: dimension {x} of block {a} and {y} of {b}: {unevenness:.1}"
                        );
                        most = most.max(unevenness);
                        pairs += 1;
                    }
                }
            }
        }
        Ok(format!("{pairs} pairs of dimensions, at most {most:.2} times as uneven as random numbers"))
    };
    prove(check, &["path"]);
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
            ensure!(sum.is_finite(), "a point that is not a number");
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
/// one seed and the next. Every pair of dimensions is tested for independence by its correlation
/// and by the evenness of its joint distribution.
///
/// The blue-noise sampler arranges neighbours, and repeats itself from tile to tile: within one tile, and
/// but for neighbours, all the same must hold.
#[test]
fn dimensions_samples_frames_pixels_and_seeds_are_independent() {
    const CELLS: usize = 8;
    let check = |gpu: &Gpu, sampler: Sampler| -> Result<String> {
        let width = if sampler == Sampler::BlueNoise { sampler::TILE } else { 256 };
        let values = |sample_index, seed| bits(gpu, sampler, &indices([width; 2], sample_index, seed));
        let width = width as usize;
        let base = values(16, 5);
        // Pairs that share no pixel: of the pixels in every other block of the step's size.
        let neighbours = |dx: usize, dy: usize| -> Vec<_> {
            let even = |at: usize, step: usize| step == 0 || (at / step).is_multiple_of(2);
            let fits = |index: &usize| {
                let (x, y) = (index % width, index / width);
                x + dx < width && y + dy < width && if dx > 0 { even(x, dx) } else { even(y, dy) }
            };
            (0..base.len()).filter(fits).map(|index| (base[index], base[index + dy * width + dx])).collect()
        };
        let with = |other: Vec<[u32; 4]>| base.iter().copied().zip(other).collect::<Vec<_>>();
        let mut relations = vec![
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
        relations.retain(|(name, _)| sampler != Sampler::BlueNoise || !name.ends_with("neighbour"));
        // A pixel's samples keep apart in each dimension of the Sobol sequence. Across dimensions, whose
        // scrambles or masks are independent, two samples are independent too.
        let stratified =
            |name: &str, a: usize, b: usize| sampler != Sampler::Random && name.ends_with("sample") && a == b;
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
                // The variance of a uniform value is 1/12.
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
    prove(|gpu| check(gpu, Sampler::Random), &["random_values"]);
    prove(|gpu| check(gpu, Sampler::Sobol), &["sobol_values"]);
    prove(|gpu| check(gpu, Sampler::BlueNoise), &["blue_noise_values"]);
}

/// Catches seeds that only choose among the tile's numbers: no number of pictures would then have the
/// mean that they should. Over the seeds each sample of a pixel goes everywhere in its four dimensions.
#[test]
fn over_the_seeds_a_sample_goes_everywhere() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut least = 1.0_f64;
        let samples = [([3, 4], 0), ([3, 4], 1), ([300, 17], 15), ([0, 0], 1000)];
        for sampler in SAMPLERS {
            for (pixel, sample_index) in samples {
                let of_seed = |seed| Index { pixel, sample_index, seed };
                let indices: Vec<_> = (0..1 << 16).map(of_seed).collect();
                let mut cells = vec![0; 1 << 12];
                for values in bits(gpu, sampler, &indices) {
                    cells[values.iter().fold(0, |cell, value| cell << 3 | (value >> 21) as usize)] += 1;
                }
                let p = evenness_p(&cells);
                least = least.min(p);
                ensure!(
                    p > sidak(SAMPLERS.len() * samples.len()),
                    "{sampler:?}: sample {sample_index} of {pixel:?} leaves places out: p = {p:.1e}"
                );
            }
        }
        Ok(format!("4096 cells, 65536 seeds of {} samples, least p = {least:.2}", samples.len()))
    };
    prove(check, &["seed"]);
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
    prove(check, &["index"]);
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
        for (sampler, pixel, seed) in [
            (Sampler::Sobol, [0, 0], 0),
            (Sampler::Sobol, [17, 300], 1),
            (Sampler::Sobol, [4095, 4], 0xdead_beef),
            (Sampler::BlueNoise, [0, 0], 0),
            (Sampler::BlueNoise, [17, 300], 1),
        ] {
            let indices: Vec<_> = (0..4096).map(|sample_index| Index { pixel, sample_index, seed }).collect();
            let values = bits(gpu, sampler, &indices);
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
    prove(check, &["intervals"]);
}
