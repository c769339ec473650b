//! Makes `shaders/blue_noise_tile.bin`, the tile of the blue-noise sampler:
//! `cargo run --release --example blue_noise_tile`. It takes some minutes and 700 MB.
//!
//! Each pixel of the tile has a number, which chooses the mask that its samples are xored with. Here the
//! numbers are chosen so that the errors of neighbouring pixels cancel where the eye blurs them, for the
//! integrals that a lens gives and for 1, 2, 4, 8 and 16 samples at once. After E. Heitz and others, 2019
//! (see [`thinlens::settings::Sampler`]), with two differences: what is minimised is the power of the
//! blurred error, and a pixel takes any number, not only one that another pixel gives away.
//!
//! Errors with one sequence for all pixels, xored, cancel better than with a scramble for each pixel:
//! they differ in four dimensions only. The numbers of samples share the freedom there is; at the end
//! the blurred error is printed, as a part of that of numbers left to chance, for integrals that had
//! no say.

use fastrand::Rng;
use std::f32::consts::TAU;
use thinlens::reference::sampler::{TILE, blue_noise_bits, concentric_disk, unit};

const PIXELS: usize = (TILE * TILE) as usize;
/// Numbers to choose from.
const NUMBERS: usize = 1 << 14;
const INTEGRALS: usize = 1024;
/// How many samples, and how much each of these weighs: the first pictures are looked at the most.
const LEVELS: [(u32, f64); 5] = [(1, 4.0), (2, 2.0), (4, 2.0), (8, 1.0), (16, 1.0)];
const ERRORS: usize = INTEGRALS * LEVELS.len();
const SWEEPS: usize = 12;
/// Numbers tried for a pixel in a sweep.
const CANDIDATES: usize = 128;
/// The standard deviation in pixels of the eye's blur.
const BLUR: f32 = 1.35;
/// Errors of pixels further apart than this hardly meet.
const REACH: i32 = 6;

/// What of film and lens sees a thing: the pixel's value is the share.
enum Integrand {
    /// The lit side of an edge that is blurred over `2 lens / film` pixels.
    Edge { normal: [f32; 2], film: f32, lens: f32, offset: f32 },
    /// A part of the lens, through which a lamp far out of focus is seen.
    Lamp { center: [f32; 2], radius: f32 },
}

impl Integrand {
    /// One of a range that goes evenly from lamps, by edges about in focus, to edges far out of it.
    fn random(rng: &mut Rng, quantile: f32) -> Self {
        let (sine, cosine) = (rng.f32() * TAU).sin_cos();
        if quantile < 0.1 {
            let distance = rng.f32().sqrt();
            let radius = 0.1 * 6_f32.powf(rng.f32());
            return Self::Lamp { center: [distance * cosine, distance * sine], radius };
        }
        let ratio = if quantile < 0.2 { 0.1 * 15_f32.powf(rng.f32()) } else { 1.5 * 20_f32.powf(rng.f32()) };
        let (film, lens) = (1.0 / (1.0 + ratio), ratio / (1.0 + ratio));
        let offset = 0.9 * (2.0 * rng.f32() - 1.0) * (0.5 * film + lens);
        Self::Edge { normal: [cosine, sine], film, lens, offset }
    }

    fn at(&self, [x, y, u, v]: [f32; 4]) -> f32 {
        let seen = match *self {
            Self::Edge { normal, film, lens, offset } => {
                normal[0] * (film * x + lens * u) + normal[1] * (film * y + lens * v) > offset
            }
            Self::Lamp { center, radius } => (u - center[0]).hypot(v - center[1]) < radius,
        };
        f32::from(u8::from(seen))
    }
}

/// Integrands, and their integrals.
fn integrals(seed: u64) -> Vec<(Integrand, f32)> {
    const POINTS: u32 = 1 << 14;
    let mut rng = Rng::with_seed(seed);
    let points: Vec<_> = (0..POINTS).map(|index| sample(0, index)).collect();
    let one = |number| {
        let integrand = Integrand::random(&mut rng, (number as f32 + 0.5) / INTEGRALS as f32);
        let sum: f32 = points.iter().map(|point| integrand.at(*point)).sum();
        (integrand, sum / POINTS as f32)
    };
    (0..INTEGRALS).map(one).collect()
}

/// The film offset and lens point of a sample of a pixel with this number.
fn sample(number: u16, index: u32) -> [f32; 4] {
    let [x, y, a, b] = blue_noise_bits(number, 0, index, 0).map(unit);
    let [u, v] = concentric_disk([a, b]);
    [x - 0.5, y - 0.5, u, v].map(|value| value as f32)
}

/// For each number, by how much its samples miss the integrals: all of them, level after level. The
/// levels' mean powers are brought to their weights.
fn errors(integrals: &[(Integrand, f32)]) -> Vec<f32> {
    let mut table = vec![0.0; ERRORS * NUMBERS];
    for (number, row) in (0..).zip(table.chunks_exact_mut(ERRORS)) {
        let mut sums = [0.0; INTEGRALS];
        let mut taken = 0;
        for ((count, _), errors) in LEVELS.into_iter().zip(row.chunks_exact_mut(INTEGRALS)) {
            for point in (taken..count).map(|index| sample(number, index)) {
                sums.iter_mut().zip(integrals).for_each(|(sum, (integrand, _))| *sum += integrand.at(point));
            }
            taken = count;
            for ((error, sum), (_, integral)) in errors.iter_mut().zip(sums).zip(integrals) {
                *error = sum / count as f32 - integral;
            }
        }
    }
    for (level, (_, weight)) in LEVELS.into_iter().enumerate() {
        let of_level = level * INTEGRALS..(level + 1) * INTEGRALS;
        let rows = || table.chunks_exact(ERRORS).flat_map(|row| &row[of_level.clone()]);
        let power = rows().map(|error| f64::from(error * error)).sum::<f64>() / NUMBERS as f64;
        let scale = (weight / power).sqrt() as f32;
        table
            .chunks_exact_mut(ERRORS)
            .flat_map(|row| &mut row[of_level.clone()])
            .for_each(|error| *error *= scale);
    }
    table
}

/// In lanes of a fixed order, for speed and for the same sum everywhere.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0; 16];
    for (a, b) in a.chunks_exact(16).zip(b.chunks_exact(16)) {
        (0..16).for_each(|lane| lanes[lane] += a[lane] * b[lane]);
    }
    lanes.iter().sum()
}

/// A tile of numbers, and the blurred errors in each of its pixels.
struct Tile<'a> {
    errors: &'a [f32],
    numbers: Vec<u16>,
    blurred: Vec<f32>,
}

impl<'a> Tile<'a> {
    fn new(errors: &'a [f32], numbers: Vec<u16>) -> Self {
        let mut tile = Self { errors, numbers, blurred: vec![0.0; ERRORS * PIXELS] };
        for pixel in 0..PIXELS {
            let own = tile.of(tile.numbers[pixel]).to_vec();
            tile.add(pixel, &own);
        }
        tile
    }

    fn of(&self, number: u16) -> &'a [f32] {
        &self.errors[usize::from(number) * ERRORS..][..ERRORS]
    }

    /// Adds to a pixel's errors. Blurring both factors of a power is blurring one of them twice, by a
    /// Gaussian of twice the variance.
    fn add(&mut self, pixel: usize, change: &[f32]) {
        let size = TILE as usize;
        let across = |at: usize, step: i32| (at + size).wrapping_add_signed(step as isize) % size;
        for (x, y) in (-REACH..=REACH).flat_map(|y| (-REACH..=REACH).map(move |x| (x, y))) {
            let weight = (-(x * x + y * y) as f32 / (4.0 * BLUR * BLUR)).exp();
            let near = across(pixel / size, y) * size + across(pixel % size, x);
            let blurred = &mut self.blurred[near * ERRORS..][..ERRORS];
            blurred.iter_mut().zip(change).for_each(|(blurred, change)| *blurred += weight * change);
        }
    }

    /// Gives a pixel the best of its number and these.
    fn improve(&mut self, pixel: usize, candidates: impl Iterator<Item = u16>) {
        let present = self.numbers[pixel];
        let own = self.of(present);
        let blurred = &self.blurred[pixel * ERRORS..][..ERRORS];
        let others: Vec<f32> = blurred.iter().zip(own).map(|(all, own)| all - own).collect();
        let power = |number| {
            let errors = self.of(number);
            dot(errors, errors) + 2.0 * dot(errors, &others)
        };
        let start = (present, power(present));
        let least = |best: (u16, f32), number| {
            let power = power(number);
            if power < best.1 { (number, power) } else { best }
        };
        let (best, _) = candidates.fold(start, least);
        if best != present {
            let change: Vec<f32> = self.of(best).iter().zip(own).map(|(new, old)| new - old).collect();
            self.numbers[pixel] = best;
            self.add(pixel, &change);
        }
    }

    /// The blurred error's power, level by level.
    fn powers(&self) -> [f64; LEVELS.len()] {
        let mut powers = [0.0; LEVELS.len()];
        for (number, blurred) in self.numbers.iter().zip(self.blurred.chunks_exact(ERRORS)) {
            let levels = self.of(*number).chunks_exact(INTEGRALS).zip(blurred.chunks_exact(INTEGRALS));
            powers.iter_mut().zip(levels).for_each(|(power, (a, b))| *power += f64::from(dot(a, b)));
        }
        powers
    }
}

fn main() -> std::io::Result<()> {
    let mut rng = Rng::with_seed(2);
    let mut number = || rng.u16(0..NUMBERS as u16);
    let chance: Vec<u16> = (0..PIXELS).map(|_| number()).collect();
    let errors_to_learn = errors(&integrals(1));
    let mut tile = Tile::new(&errors_to_learn, chance.clone());
    let mut order: Vec<usize> = (0..PIXELS).collect();
    for sweep in 1..=SWEEPS {
        Rng::with_seed(sweep as u64).shuffle(&mut order);
        for pixel in &order {
            tile.improve(*pixel, (0..CANDIDATES).map(|_| number()));
        }
        println!("sweep {sweep} of {SWEEPS}: powers of the blurred error {:.3?}", tile.powers());
    }
    let numbers = tile.numbers;
    drop(errors_to_learn);
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/blue_noise_tile.bin"), bytes)?;

    let errors_to_see = errors(&integrals(3));
    let before = Tile::new(&errors_to_see, chance).powers();
    let after = Tile::new(&errors_to_see, numbers).powers();
    for (level, (count, _)) in LEVELS.into_iter().enumerate() {
        let part = (after[level] / before[level]).sqrt();
        println!("{count} samples: the blurred error is {part:.3} of that of numbers left to chance");
    }
    Ok(())
}
