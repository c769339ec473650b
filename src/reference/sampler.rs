//! The samplers, and the map to the disk.

use crate::settings::Sampler;
use std::f64::consts::FRAC_PI_4;

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

/// Four values in [0, 1), multiples of 2^-24: the film jitter's x and y, the lens point's.
pub fn sample_values(sampler: Sampler, seed: u32, pixel: [u32; 2], index: u32, block: u32) -> [f64; 4] {
    let [x, y] = pixel;
    let bits = match sampler {
        Sampler::Random => pcg4d([x, y, index, seed.wrapping_add(block.wrapping_mul(0x9e37_79b9))]),
        Sampler::Sobol => {
            // The scramble's first bits come from a key's lower half, which the hash mixes less well.
            let keys = pcg4d([x, y, block, seed]).map(|key| key ^ (key >> 16));
            let [first, second, third, fourth] = sobol(index);
            // The film takes the third and fourth dimension, the lens the first two.
            let of_film_and_lens = [third, fourth, first, second];
            [0, 1, 2, 3].map(|axis| owen_scramble(of_film_and_lens[axis], keys[axis]))
        }
    };
    bits.map(|bits| f64::from(bits >> 8) / 16_777_216.0)
}

/// The first four dimensions of the Sobol sequence, in multiples of 2^-32: S. Joe and F. Kuo, "Notes
/// on Generating Sobol Sequences", 2008, with the primitive polynomials and initial numbers of their
/// table, but for the fourth dimension's initial numbers: with 1, 1, 3 the first eight points of the
/// third and fourth are a net.
pub fn sobol(index: u32) -> [u32; 4] {
    [
        // The first dimension has no polynomial: its directions are the bits.
        radical_sum(index, &std::array::from_fn(|bit| 1 << (31 - bit))),
        radical_sum(index, &directions(1, 0, &[1])),
        radical_sum(index, &directions(2, 1, &[1, 3])),
        radical_sum(index, &directions(3, 1, &[1, 1, 3])),
    ]
}

/// The sum, modulo two, of the directions of the bits that the index has.
fn radical_sum(index: u32, directions: &[u32; 32]) -> u32 {
    let chosen = directions.iter().enumerate().filter(|(bit, _)| index >> bit & 1 == 1);
    chosen.fold(0, |sum, (_, direction)| sum ^ direction)
}

/// Direction numbers of a polynomial of this degree, with its inner coefficients as bits.
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

/// Flips each bit as a hash of the bits above it and of the key says: N. Vegdahl, "Building a Better LK
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
