//! Makes `shaders/blue_noise_tile.bin`, the tile of the blue-noise sampler:
//! `cargo run --release --example blue_noise_tile`. It takes some minutes.
//!
//! Each pixel of the tile has a number of its own, which chooses the mask that its samples are xored with. Here the
//! numbers are chosen so that the errors of neighbouring pixels cancel where the eye blurs them, in
//! pictures of edges in and out of focus, with 1, 2, 4, 8 and 16 samples at once. After E. Heitz and
//! others, 2019 (see [`thinlens::settings::Sampler`]), by swaps, with two differences: what is minimised is
//! the power of the blurred error, and the edges run through the picture, so that a pixel's neighbour sees
//! them elsewhere.
//!
//! At the end the blurred error is printed, as a part of that of numbers left to chance, for edges that
//! had no say.

use fastrand::Rng;
use std::f32::consts::TAU;
use thinlens::reference::sampler::{TILE, blue_noise_bits, concentric_disk, unit};

const SIZE: usize = TILE as usize;
const PIXELS: usize = SIZE * SIZE;
/// Pictures that the error is taken of.
const PICTURES: usize = 256;
/// How many samples, and how much each of these weighs: the first pictures are looked at the most.
const LEVELS: [(usize, f32); 5] = [(1, 4.0), (2, 2.0), (4, 2.0), (8, 1.0), (16, 1.0)];
const SAMPLES: usize = 16;
const ERRORS: usize = PICTURES * LEVELS.len();
const SWEEPS: usize = 12;
/// Swaps tried for a pixel in a sweep.
const CANDIDATES: usize = 64;
/// The standard deviation in pixels of the eye's blur.
const BLUR: f32 = 1.35;
/// Errors of pixels further apart than this hardly meet.
const REACH: i32 = 6;

/// A picture of parallel stripes, out of focus. Phases are in units of 2^-16 of a period.
struct Stripes {
    /// Across the stripes, in periods a pixel.
    wave: [f32; 2],
    /// How far the rim of the lens moves a point, in pixels: in front of the focal plane the other way
    /// round than behind it.
    blur_radius: f32,
    start: u16,
    /// The phases that are lit.
    width: u16,
}

impl Stripes {
    /// From about in focus to far out of it, and so wide that a pixel sees one edge at most, or two.
    fn random(rng: &mut Rng) -> Self {
        let (sine, cosine) = (rng.f32() * TAU).sin_cos();
        let blur = if rng.f32() < 0.1 { rng.f32() } else { 1.5 * 20_f32.powf(rng.f32()) };
        let period = (2.5 * blur).max(6.0);
        let side = if rng.bool() { 0.5 } else { -0.5 };
        Self {
            wave: [cosine / period, sine / period],
            blur_radius: side * blur,
            start: rng.u16(..),
            width: (1500.0 * 36_f32.powf(rng.f32())) as u16,
        }
    }

    /// Where a sample falls, from its pixel's centre. The lens's second axis points up, the film's down.
    fn of_sample(&self, [x, y, u, v]: [f32; 4]) -> u16 {
        let across = self.wave[0] * (x + self.blur_radius * u) + self.wave[1] * (y - self.blur_radius * v);
        ((65536.0 * across).floor() as i32 as u16).wrapping_add(self.start)
    }

    /// Where a pixel's centre lies. The tile repeats, so a whole number of periods goes into it.
    fn of_pixel(&self, pixel: usize) -> u16 {
        let step = self.wave.map(|wave| (wave * SIZE as f32).round() as i32 as u16);
        let [column, row] = [pixel % SIZE, pixel / SIZE].map(|at| at as u16);
        let turns = step[0].wrapping_mul(column).wrapping_add(step[1].wrapping_mul(row));
        turns.wrapping_mul((65536 / SIZE) as u16)
    }
}

/// Pictures, what the samples of each number see of them, and what is the truth.
struct Pictures {
    stripes: Vec<Stripes>,
    /// Of number, sample and picture.
    phases: Vec<u16>,
    /// Of phase and picture: a pixel has one of as many phases as pixels go along the tile.
    truth: Vec<f32>,
    /// What an error of a level is multiplied by, to give it its weight.
    scales: [f32; LEVELS.len()],
}

impl Pictures {
    fn new(seed: u64) -> Self {
        const POINTS: u32 = 1 << 13;
        let mut rng = Rng::with_seed(seed);
        let stripes: Vec<_> = (0..PICTURES).map(|_| Stripes::random(&mut rng)).collect();
        let of_number = |number: u16| (0..SAMPLES as u32).map(move |index| sample(number, index));
        let samples = (0..PIXELS as u16).flat_map(of_number);
        let phases = samples.flat_map(|sample| stripes.iter().map(move |stripes| stripes.of_sample(sample)));
        let phases = phases.collect();
        let mut truth = vec![0.0; SIZE * PICTURES];
        for point in (0..POINTS).map(|index| sample(0, index)) {
            for (picture, stripes) in stripes.iter().enumerate() {
                let at = stripes.of_sample(point);
                for phase in 0..SIZE {
                    let lit = at.wrapping_add((phase * 65536 / SIZE) as u16) < stripes.width;
                    truth[phase * PICTURES + picture] += f32::from(u8::from(lit)) / POINTS as f32;
                }
            }
        }
        let mut pictures = Self { stripes, phases, truth, scales: [1.0; LEVELS.len()] };
        let mut powers = [0.0; LEVELS.len()];
        let mut errors = vec![0.0; ERRORS];
        for pixel in 0..PIXELS {
            pictures.errors(&pictures.view(pixel), pixel as u16, &mut errors);
            let levels = errors.chunks_exact(PICTURES);
            powers
                .iter_mut()
                .zip(levels)
                .for_each(|(power, errors)| *power += dot(errors, errors) / PIXELS as f32);
        }
        pictures.scales = std::array::from_fn(|level| (LEVELS[level].1 / powers[level]).sqrt());
        pictures
    }

    fn view(&self, pixel: usize) -> View {
        let phases: Vec<u16> = self.stripes.iter().map(|stripes| stripes.of_pixel(pixel)).collect();
        let truth = |(picture, phase): (usize, &u16)| {
            self.truth[usize::from(*phase) * SIZE / 65536 * PICTURES + picture]
        };
        View { truth: phases.iter().enumerate().map(truth).collect(), phases }
    }

    /// By how much the samples of a number miss the truth in a pixel: in all pictures, level by level.
    fn errors(&self, view: &View, number: u16, errors: &mut [f32]) {
        let samples = &self.phases[usize::from(number) * SAMPLES * PICTURES..][..SAMPLES * PICTURES];
        let mut samples = samples.chunks_exact(PICTURES);
        let mut lit = [0_u16; PICTURES];
        let mut taken = 0;
        for (level, errors) in errors.chunks_exact_mut(PICTURES).enumerate() {
            let (count, _) = LEVELS[level];
            for phases in samples.by_ref().take(count - taken) {
                for picture in 0..PICTURES {
                    let phase = phases[picture].wrapping_add(view.phases[picture]);
                    lit[picture] += u16::from(phase < self.stripes[picture].width);
                }
            }
            taken = count;
            for picture in 0..PICTURES {
                let share = f32::from(lit[picture]) / count as f32;
                errors[picture] = self.scales[level] * (share - view.truth[picture]);
            }
        }
    }
}

/// What a pixel should see of the pictures.
struct View {
    phases: Vec<u16>,
    truth: Vec<f32>,
}

/// The film offset and lens point of a sample of a pixel with this number.
fn sample(number: u16, index: u32) -> [f32; 4] {
    let [x, y, a, b] = blue_noise_bits(number, 0, index, 0).map(unit);
    let [u, v] = concentric_disk([a, b]);
    [x - 0.5, y - 0.5, u, v].map(|value| value as f32)
}

/// In lanes of a fixed order, for speed and for the same sum everywhere.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0; 16];
    for (a, b) in a.chunks_exact(16).zip(b.chunks_exact(16)) {
        (0..16).for_each(|lane| lanes[lane] += a[lane] * b[lane]);
    }
    lanes.iter().sum()
}

/// A tile of numbers, the errors of its pixels, and these blurred.
struct Tile<'a> {
    pictures: &'a Pictures,
    numbers: Vec<u16>,
    errors: Vec<f32>,
    blurred: Vec<f32>,
}

impl<'a> Tile<'a> {
    fn new(pictures: &'a Pictures, numbers: Vec<u16>) -> Self {
        let zeros = vec![0.0; ERRORS * PIXELS];
        let mut tile = Self { pictures, numbers, errors: zeros.clone(), blurred: zeros };
        (0..PIXELS).for_each(|pixel| tile.update(pixel));
        tile
    }

    /// Takes in that a pixel has another number. Blurring both factors of a power is blurring one of
    /// them twice, by a Gaussian of twice the variance.
    fn update(&mut self, pixel: usize) {
        let own = &mut self.errors[pixel * ERRORS..][..ERRORS];
        let mut change = vec![0.0; ERRORS];
        self.pictures.errors(&self.pictures.view(pixel), self.numbers[pixel], &mut change);
        for (change, own) in change.iter_mut().zip(own) {
            (*own, *change) = (*change, *change - *own);
        }
        let across = |at: usize, step: i32| (at + SIZE).wrapping_add_signed(step as isize) % SIZE;
        for (x, y) in (-REACH..=REACH).flat_map(|y| (-REACH..=REACH).map(move |x| (x, y))) {
            let weight = (-(x * x + y * y) as f32 / (4.0 * BLUR * BLUR)).exp();
            let near = across(pixel / SIZE, y) * SIZE + across(pixel % SIZE, x);
            let blurred = &mut self.blurred[near * ERRORS..][..ERRORS];
            blurred.iter_mut().zip(&change).for_each(|(blurred, change)| *blurred += weight * change);
        }
    }

    /// By how much the power changes if a pixel has this number.
    fn change(&self, pixel: usize, view: &View, number: u16) -> f32 {
        let mut errors = [0.0; ERRORS];
        self.pictures.errors(view, number, &mut errors);
        errors.iter_mut().zip(&self.errors[pixel * ERRORS..]).for_each(|(error, own)| *error -= own);
        dot(&errors, &errors) + 2.0 * dot(&errors, &self.blurred[pixel * ERRORS..][..ERRORS])
    }

    /// Swaps a pixel's number with that of the one of these, all out of its reach, where that lowers the
    /// power most, if it does.
    fn improve(&mut self, pixel: usize, candidates: impl Iterator<Item = usize>) {
        let view = self.pictures.view(pixel);
        let mut best = (0.0, pixel);
        for other in candidates.filter(|other| far(pixel, *other)) {
            let there = self.change(other, &self.pictures.view(other), self.numbers[pixel]);
            let change = there + self.change(pixel, &view, self.numbers[other]);
            if change < best.0 {
                best = (change, other);
            }
        }
        if best.1 != pixel {
            self.numbers.swap(pixel, best.1);
            self.update(pixel);
            self.update(best.1);
        }
    }

    /// The blurred error's power, level by level.
    fn powers(&self) -> [f32; LEVELS.len()] {
        let mut powers = [0.0; LEVELS.len()];
        for pixels in self.errors.chunks_exact(ERRORS).zip(self.blurred.chunks_exact(ERRORS)) {
            let levels = pixels.0.chunks_exact(PICTURES).zip(pixels.1.chunks_exact(PICTURES));
            powers.iter_mut().zip(levels).for_each(|(power, (a, b))| *power += dot(a, b));
        }
        powers
    }
}

/// Whether no pixel is in reach of both.
fn far(a: usize, b: usize) -> bool {
    let apart = |a: usize, b: usize| a.abs_diff(b).min(SIZE - a.abs_diff(b));
    let reach = REACH.unsigned_abs() as usize;
    apart(a % SIZE, b % SIZE).max(apart(a / SIZE, b / SIZE)) > reach
}

fn main() -> std::io::Result<()> {
    let mut rng = Rng::with_seed(2);
    let mut chance: Vec<u16> = (0..PIXELS as u16).collect();
    rng.shuffle(&mut chance);
    let pictures = Pictures::new(1);
    let mut tile = Tile::new(&pictures, chance.clone());
    let mut order: Vec<usize> = (0..PIXELS).collect();
    for sweep in 1..=SWEEPS {
        Rng::with_seed(sweep as u64).shuffle(&mut order);
        for pixel in &order {
            tile.improve(*pixel, (0..CANDIDATES).map(|_| rng.usize(0..PIXELS)));
        }
        println!("sweep {sweep} of {SWEEPS}: powers of the blurred error {:.0?}", tile.powers());
    }
    let numbers = tile.numbers;
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/blue_noise_tile.bin"), bytes)?;

    let unseen = Pictures::new(3);
    let before = Tile::new(&unseen, chance).powers();
    let after = Tile::new(&unseen, numbers).powers();
    for (level, (count, _)) in LEVELS.into_iter().enumerate() {
        let part = (after[level] / before[level]).sqrt();
        println!("{count} samples: the blurred error is {part:.3} of that of numbers left to chance");
    }
    Ok(())
}
