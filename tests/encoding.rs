//! How colours are encoded: the shaders' function against the oracle.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::probe::probe;
use common::{Gpu, prove};
use thinlens::reference::tone;

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Linear {
    value: [f32; 3],
    pad0: u32,
}

/// Catches a power of 2.2 for the sRGB curve, a missing foot of it, and values beyond white or below
/// black that wrap: a tenth of a step of eight bits is the bound.
#[test]
fn colours_are_encoded_as_srgb() {
    let check = |gpu: &Gpu| -> Result<String> {
        let values: Vec<_> = (-64..=4160)
            .map(|i| f64::from(i) / 4096.0)
            .chain((0..400).map(|i| f64::from(i) / 1e5))
            .chain([1e9, -1e9])
            .map(|value| Linear { value: [value as f32, 0.5 * value as f32, 1.0 - value as f32], pad0: 0 })
            .collect();
        let mut worst = 0.0_f64;
        for (linear, encoded) in values.iter().zip(probe::<_, Linear>(gpu, "color", None, &[], &values)) {
            for (value, got) in linear.value.into_iter().zip(encoded.value) {
                let error = (f64::from(got) - tone::srgb(value.into())).abs();
                worst = worst.max(error);
                ensure!(error < 0.1 / 255.0, "{value} is encoded as {got}");
            }
        }
        Ok(format!("{} values within {worst:.1e}", 3 * values.len()))
    };
    prove(check, &["srgb"]);
}
