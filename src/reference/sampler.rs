//! The counter-based sampler, and the map to the disk.

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
pub fn sample_values(seed: u32, pixel: [u32; 2], index: u32, block: u32) -> [f64; 4] {
    let stream = seed.wrapping_add(block.wrapping_mul(0x9e37_79b9));
    pcg4d([pixel[0], pixel[1], index, stream]).map(|bits| f64::from(bits >> 8) / 16_777_216.0)
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
