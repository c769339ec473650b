//! The samplers, and the map from the unit square to the unit disk.

use crate::settings::Sampler;
use glam::DVec3;
use std::f64::consts::FRAC_PI_4;

/// The tile of `examples/blue_noise_tile.rs`: a number of 16 bits for each pixel, row by row.
const NUMBERS: &[u8; 2 * (TILE * TILE) as usize] = include_bytes!("../../shaders/blue_noise_tile.bin");
/// The number of pixels along an edge of the blue-noise tile.
pub const TILE: u32 = 128;
/// The keys of the scramble that all pixels share with blue noise. Of some hundreds of keys, these have small errors
/// with up to 256 samples, at edges in and out of focus.
const BLUE_NOISE_SCRAMBLE: [u32; 4] = [0x0e7e_f62e, 0xeec2_10f3, 0xbced_7d2a, 0x84af_394d];

/// M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: pcg4d.
pub fn pcg4d(input: [u32; 4]) -> [u32; 4] {
    let advanced = input.map(|value| value.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    mix(mix(advanced).map(|value| value ^ (value >> 16)))
}

fn mix([x, y, z, w]: [u32; 4]) -> [u32; 4] {
    let x = x.wrapping_add(y.wrapping_mul(w));
    let y = y.wrapping_add(z.wrapping_mul(x));
    let z = z.wrapping_add(x.wrapping_mul(y));
    let w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w]
}

/// Four values in [0, 1), which are multiples of 2^-24. In block 0 they are x and y of the film jitter, then x and y of
/// the lens point.
pub fn sample_values(sampler: Sampler, seed: u32, pixel: [u32; 2], index: u32, block: u32) -> [f64; 4] {
    let [x, y] = pixel;
    let bits = match sampler {
        Sampler::Random => pcg4d([x, y, index, seed.wrapping_add(block.wrapping_mul(0x9e37_79b9))]),
        Sampler::Sobol => scrambled(index, folded([x, y, block, seed])),
        Sampler::BlueNoise => blue_noise_bits(blue_noise_number(seed, [x, y], block), seed, index, block),
    };
    bits.map(unit)
}

/// The number of a pixel in the blue-noise tile, which the seed shifts.
fn blue_noise_number(seed: u32, [x, y]: [u32; 2], block: u32) -> u16 {
    let shift = folded([0, 0, block, seed]);
    // The last byte of the bits is free for the shift, because a sample value does not use it.
    let (column, row) = (x.wrapping_add(shift[0]) % TILE, y.wrapping_add(shift[1]) % TILE);
    let place = 2 * (row * TILE + column) as usize;
    u16::from_le_bytes([NUMBERS[place], NUMBERS[place + 1]])
}

/// The bits of the blue-noise sampler for a pixel that has this number in the tile. They are a point of a Sobol
/// sequence with one scramble for all pixels, xored with one mask that depends on the number and one that depends on
/// the seed.
pub fn blue_noise_bits(number: u16, seed: u32, index: u32, block: u32) -> [u32; 4] {
    let (shift, mask) = (folded([0, 0, block, seed]), folded([number.into(), 0, 0, 0]));
    let point = scrambled(index, BLUE_NOISE_SCRAMBLE);
    [0, 1, 2, 3].map(|axis| point[axis] ^ shift[axis] ^ mask[axis])
}

/// A value in [0, 1) for the time of a sample: the first dimension of the Sobol sequence, with its points in their own
/// order (B. Burley, JCGT 9(4), 2020, section 4).
pub fn time_value(sampler: Sampler, seed: u32, pixel: [u32; 2], index: u32) -> f64 {
    const BLOCK: u32 = 1;
    let ordered = |order: u32, key: u32| owen_scramble(owen_scramble(index, order).reverse_bits(), key);
    match sampler {
        Sampler::Random => sample_values(sampler, seed, pixel, index, BLOCK)[0],
        Sampler::Sobol => {
            let [order, key, ..] = folded([pixel[0], pixel[1], BLOCK, seed]);
            unit(ordered(order, key))
        }
        Sampler::BlueNoise => {
            let number = blue_noise_number(seed, pixel, BLOCK);
            let mask = folded([0, 0, BLOCK, seed])[0] ^ folded([number.into(), 0, 0, 0])[0];
            unit(ordered(0x6c8e_9cf5, 0x3f84_d5b5) ^ mask)
        }
    }
}

/// What sample values decide at a bounce of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// Which light is sampled, and at which point.
    Light,
    /// Whether the ray goes on, and in which direction.
    Direction,
}

/// Four values in [0, 1) for a use at a bounce of a path. Each use at each bounce has its own block, whose points are
/// in their own order, like those of the time.
pub fn path_values(
    sampler: Sampler,
    seed: u32,
    pixel: [u32; 2],
    index: u32,
    bounce: u32,
    of: Use,
) -> [f64; 4] {
    let block = match of {
        Use::Light => 2 * (bounce + 1),
        Use::Direction => 2 * (bounce + 1) + 1,
    };
    let order = match sampler {
        Sampler::Random => return sample_values(sampler, seed, pixel, index, block),
        Sampler::Sobol => folded(folded([pixel[0], pixel[1], block, seed]))[0],
        Sampler::BlueNoise => folded([0, block, 0, 0])[0],
    };
    let shuffled = owen_scramble(index, order) % (1 << 24);
    sample_values(sampler, seed, pixel, shuffled, block)
}

/// The value in [0, 1) of these bits, of which it uses the upper 24.
pub fn unit(bits: u32) -> f64 {
    f64::from(bits >> 8) / 16_777_216.0
}

/// The hash, with the upper half of each number's bits folded into the lower half. The hash mixes the lower bits less
/// well, but they decide the leading bits of the samples.
fn folded(input: [u32; 4]) -> [u32; 4] {
    pcg4d(input).map(|hash| hash ^ (hash >> 16))
}

/// The scrambled Sobol point of an index. The film takes the third and fourth dimension, the lens the first two.
fn scrambled(index: u32, keys: [u32; 4]) -> [u32; 4] {
    let [first, second, third, fourth] = sobol(index);
    let of_film_and_lens = [third, fourth, first, second];
    [0, 1, 2, 3].map(|axis| owen_scramble(of_film_and_lens[axis], keys[axis]))
}

/// The first four dimensions of the Sobol sequence, in multiples of 2^-32: S. Joe and F. Kuo, "Notes
/// on Generating Sobol Sequences", 2008. The primitive polynomials and initial numbers are those of their
/// table, except that the fourth dimension has the initial numbers 1, 1, 3. With these, the first eight
/// points of the third and fourth dimension are a net.
pub fn sobol(index: u32) -> [u32; 4] {
    [
        // The first dimension has no polynomial: its direction numbers are single bits.
        radical_sum(index, &std::array::from_fn(|bit| 1 << (31 - bit))),
        radical_sum(index, &directions(1, 0, &[1])),
        radical_sum(index, &directions(2, 1, &[1, 3])),
        radical_sum(index, &directions(3, 1, &[1, 1, 3])),
    ]
}

/// The sum, modulo two, of the direction numbers of the bits that are set in the index.
fn radical_sum(index: u32, directions: &[u32; 32]) -> u32 {
    let chosen = directions.iter().enumerate().filter(|(bit, _)| index >> bit & 1 == 1);
    chosen.fold(0, |sum, (_, direction)| sum ^ direction)
}

/// The direction numbers of a polynomial of this degree, whose inner coefficients are the bits of `coefficients`.
fn directions(degree: usize, coefficients: u32, initial: &[u32]) -> [u32; 32] {
    let mut directions = [0; 32];
    for bit in 0..32 {
        directions[bit] = if bit < degree {
            initial[bit] << (31 - bit)
        } else {
            let last = directions[bit - degree];
            let inner = (1..degree).filter(|k| coefficients >> (degree - 1 - k) & 1 == 1);
            inner.fold(last ^ (last >> degree), |sum, k| sum ^ directions[bit - k])
        };
    }
    directions
}

/// Flips each bit or not, as a hash of the key and the bits above it decides: N. Vegdahl, "Building a Better LK
/// Hash", 2021, after S. Laine and T. Karras, 2011.
pub fn owen_scramble(value: u32, key: u32) -> u32 {
    let mut bits = value.reverse_bits();
    bits ^= bits.wrapping_mul(0x3d20_adea);
    bits = bits.wrapping_add(key);
    bits = bits.wrapping_mul(key >> 16 | 1);
    bits ^= bits.wrapping_mul(0x0552_6c56);
    bits ^= bits.wrapping_mul(0x53a2_2864);
    bits.reverse_bits()
}

/// The concentric map from the unit square to the unit disk: P. Shirley and K. Chiu, JGT 2(3), 1997.
pub fn concentric_disk(xi: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * xi[0] - 1.0, 2.0 * xi[1] - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (radius, angle) =
        if a.abs() > b.abs() { (a, FRAC_PI_4 * (b / a)) } else { (b, FRAC_PI_4 * (2.0 - a / b)) };
    [radius * angle.cos(), radius * angle.sin()]
}

/// A direction in the cone around the y axis with this cosine at its edge, evenly over its solid angle.
pub fn in_cone(xi: [f64; 2], cosine: f64) -> DVec3 {
    let [x, z] = concentric_disk(xi);
    let radius = x.hypot(z);
    let height = 1.0 - radius * radius * (1.0 - cosine);
    let wide = (1.0 - height * height).max(0.0).sqrt();
    if radius == 0.0 { DVec3::Y } else { DVec3::new(wide * x / radius, height, wide * z / radius) }
}
