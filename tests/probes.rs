//! The shaders' own sampler, disk map, camera and encoding, one by one, against the oracle and
//! against what they must be.

mod common;

use bytemuck::{Pod, Zeroable};
use common::Gpu;
use glam::{DVec3, Vec3};
use std::collections::HashSet;
use std::sync::Arc;
use thinlens::gpu_types::Camera;
use thinlens::reference::{Reference, sampler, tone};
use thinlens::settings::{Estimator, Settings};
use thinlens::vulkan::{Binding, BindingSet, Buffer, Commands, ComputePipeline, Residence, Shader};

const PROBE: Shader =
    Shader { name: "probe", spirv: include_bytes!(concat!(env!("OUT_DIR"), "/probe.comp.spv")) };

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Probe {
    bits: [u32; 4],
    disk: [f32; 2],
    offset: [f32; 2],
    origin: [f32; 3],
    srgb: f32,
    direction: [f32; 3],
    landing: i32,
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct ProbePush {
    camera: Camera,
    extent: [u32; 2],
    seed: u32,
    sample_index: u32,
}

/// What the device makes of the sample `index` of every pixel, row by row.
fn probe(gpu: &Gpu, estimator: &Estimator, index: u32) -> Vec<Probe> {
    let pixels = estimator.size[0] * estimator.size[1];
    let bytes = u64::from(pixels) * size_of::<Probe>() as u64;
    let pipeline = ComputePipeline::new(gpu.device(), PROBE, &[]).expect("a pipeline");
    let output = Arc::new(Buffer::new(gpu.device(), "probes", bytes, Residence::Host).expect("a buffer"));
    let bindings =
        BindingSet::new(&pipeline, &[(0, Binding::Buffer(Arc::clone(&output)))]).expect("bindings");
    let push = ProbePush {
        camera: Camera::new(estimator),
        extent: estimator.size,
        seed: estimator.seed,
        sample_index: index,
    };
    let mut commands = Commands::new(gpu.device()).expect("commands");
    let mut recording = commands.begin().expect("a recording");
    recording.dispatch(&pipeline, &bindings, bytemuck::bytes_of(&push), [pixels, 1]);
    recording.barrier();
    recording.submit().expect("a submission");
    commands.wait().expect("the device");
    let bytes = usize::try_from(bytes).expect("a small buffer");
    bytemuck::allocation::pod_collect_to_vec(&output.bytes()[..bytes])
}

/// A slanted camera with a wide lens.
fn slanted(size: [u32; 2]) -> Estimator {
    let scene = common::scene_of(
        "[camera]\neye = [3, 4, 12]\nlook_at = [-2, 1, -9]\nup = [0.2, 1, 0]\nvfov_degrees = 65\n\
         lens_diameter = 1.4\nfocal_distance = 17\n",
    );
    let mut estimator = Settings::of_scene(scene).estimator;
    (estimator.size, estimator.seed) = (size, 0xdead_beef);
    estimator
}

fn pixels(size: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    (0..size[1]).flat_map(move |y| (0..size[0]).map(move |x| [x, y]))
}

/// Catches a hash that differs between the shaders and the oracle in any bit that is used.
#[test]
fn sample_values_are_the_oracles_to_the_bit() {
    let gpu = Gpu::new();
    for (seed, index) in [(0, 0), (1, 0), (0xffff_ffff, 77), (7, (1 << 24) - 1)] {
        let mut estimator = slanted([100, 100]);
        estimator.seed = seed;
        for (pixel, probe) in pixels([100, 100]).zip(probe(&gpu, &estimator, index)) {
            let expected =
                sampler::sample_values(seed, pixel, index, 0).map(|value| (value * 16_777_216.0) as u32);
            assert_eq!(probe.bits, expected, "{pixel:?}");
        }
    }
}

/// Catches a lens of another radius or orientation, a focal sphere instead of a plane, and a field
/// of view that is off at the edges.
#[test]
fn primary_rays_are_the_oracles_and_meet_in_the_focal_plane() {
    let gpu = Gpu::new();
    let estimator = slanted([33, 21]);
    let (frame, eye) = (estimator.camera.frame(), estimator.camera.eye.as_dvec3());
    let reference = Reference::new(&estimator);
    let (mut worst, mut nearest_to_sphere) = (0.0_f64, f64::INFINITY);
    for index in 0..40 {
        for (pixel, probe) in pixels([33, 21]).zip(probe(&gpu, &estimator, index)) {
            let sample = reference.sample(pixel, index);
            let origin = Vec3::from_array(probe.origin).as_dvec3();
            let direction = Vec3::from_array(probe.direction).as_dvec3();
            assert!((origin - sample.ray.origin).length() < 1e-5, "{pixel:?}");
            assert!((direction - sample.ray.direction).length() < 1e-6, "{pixel:?}");
            assert!((direction.length() - 1.0).abs() < 1e-6);
            // Where the device's ray meets the plane at depth F, against where the centre ray does.
            let depth = |point: DVec3| -frame.w().dot(point - eye);
            let met = origin + (17.0 - depth(origin)) / -frame.w().dot(direction) * direction;
            let k = 10.5 / (65_f64.to_radians() / 2.0).tan();
            let at = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + f64::from(probe.offset[axis]));
            let focus =
                eye + 17.0 * ((at[0] - 16.5) / k * frame.u() - (at[1] - 10.5) / k * frame.v() - frame.w());
            worst = worst.max((met - focus).length() / 17.0);
            if pixel == [0, 0] {
                let on_sphere = eye + 17.0 * (focus - eye).normalize();
                nearest_to_sphere = nearest_to_sphere.min((focus - on_sphere).length() / 17.0);
            }
        }
    }
    println!("worst distance from the point in focus: {worst:e} F");
    assert!(worst < 1e-4, "{worst} F");
    assert!(nearest_to_sphere > 0.1, "in the corner, a focal sphere is far away: {nearest_to_sphere} F");
}

/// Catches a disk map that leaves the disk, clusters, or is folded: it equals the oracle's, its
/// equal-area cells are equally full, and its moments are 0 and 1/4.
#[test]
fn lens_points_fill_the_disk_evenly() {
    const RINGS: usize = 8;
    const SECTORS: usize = 16;
    let gpu = Gpu::new();
    let estimator = slanted([256, 256]);
    let mut cells = [[0.0_f64; SECTORS]; RINGS];
    let (mut sum, mut squares, mut count) = ([0.0; 2], [0.0; 2], 0.0);
    for index in 0..4 {
        for probe in probe(&gpu, &estimator, index) {
            let xi = [2, 3].map(|axis| f64::from(probe.bits[axis]) / 16_777_216.0);
            let expected = sampler::concentric_disk(xi);
            let [x, y] = probe.disk.map(f64::from);
            assert!((x - expected[0]).abs() < 1e-6 && (y - expected[1]).abs() < 1e-6, "{xi:?}");
            let square = x * x + y * y;
            assert!(square <= 1.0 + 1e-6);
            let ring = ((square * RINGS as f64) as usize).min(RINGS - 1);
            let turn = y.atan2(x) / std::f64::consts::TAU + 0.5;
            cells[ring][((turn * SECTORS as f64) as usize).min(SECTORS - 1)] += 1.0;
            for (axis, value) in [x, y].into_iter().enumerate() {
                sum[axis] += value;
                squares[axis] += value * value;
            }
            count += 1.0;
        }
    }
    let expected = count / (RINGS * SECTORS) as f64;
    let chi_square: f64 = cells.iter().flatten().map(|cell| (cell - expected).powi(2) / expected).sum();
    // 127 degrees of freedom: 127 on average, standard deviation 16; five of those above.
    println!("chi-square {chi_square:.1} of 127 degrees of freedom");
    assert!(chi_square < 127.0 + 5.0 * 254_f64.sqrt(), "{chi_square}");
    for axis in 0..2 {
        // A coordinate's variance is 1/4, its square's 1/16.
        assert!((sum[axis] / count).abs() < 5.0 * 0.5 / count.sqrt(), "mean {}", sum[axis] / count);
        assert!(
            (squares[axis] / count - 0.25).abs() < 5.0 * 0.25 / count.sqrt(),
            "{}",
            squares[axis] / count
        );
    }
}

/// Catches one random number used twice: film and lens, sample and next sample, pixel and
/// neighbour, seed and next seed must not be correlated in any pair of dimensions.
#[test]
fn dimensions_samples_pixels_and_seeds_are_independent() {
    let gpu = Gpu::new();
    let size = [128, 128];
    let values = |seed: u32, index: u32| -> Vec<[f64; 4]> {
        let mut estimator = slanted(size);
        estimator.seed = seed;
        let probes = probe(&gpu, &estimator, index);
        probes.iter().map(|probe| probe.bits.map(|bits| f64::from(bits) / 16_777_216.0)).collect()
    };
    let (base, next_sample, next_seed) = (values(5, 0), values(5, 1), values(6, 0));
    let right: Vec<_> = base.iter().skip(1).copied().collect();
    let below: Vec<_> = base.iter().skip(128).copied().collect();
    let mut worst = 0.0_f64;
    for (name, other) in [
        ("itself", &base),
        ("sample", &next_sample),
        ("seed", &next_seed),
        ("right", &right),
        ("below", &below),
    ] {
        let count = base.len().min(other.len()) as f64;
        for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
            if name == "itself" && a == b {
                continue;
            }
            let covariance: f64 = base.iter().zip(other).map(|(x, y)| (x[a] - 0.5) * (y[b] - 0.5)).sum();
            // Of independent uniform values: variance 1/12 each.
            let z = covariance * 12.0 / count.sqrt();
            worst = worst.max(z.abs());
            assert!(z.abs() < 5.0, "{name}: dimension {a} with {b}, z {z}");
        }
    }
    println!("worst |z| of 76 pairs: {worst:.2}");
}

/// Catches the same jitter in every frame, which would freeze the noise.
#[test]
fn every_sample_has_another_place_in_its_pixel() {
    let gpu = Gpu::new();
    let estimator = slanted([4, 4]);
    let mut seen = HashSet::new();
    for index in 0..256 {
        let probe = probe(&gpu, &estimator, index)[5];
        assert!(seen.insert(probe.offset.map(f32::to_bits)), "sample {index} repeats a place");
    }
}

/// Catches samples that land one pixel off at the edge of a pixel, and an encoding that strays.
#[test]
fn landing_and_encoding_are_the_oracles() {
    let gpu = Gpu::new();
    for jitter in [0.0, 1.0, 2.2, 3.0, 15.0] {
        let mut estimator = slanted([128, 128]);
        estimator.jitter = jitter;
        for probe in probe(&gpu, &estimator, 3) {
            let xi = f64::from(probe.bits[0]) / 16_777_216.0;
            let landing = ((xi - 0.5) * f64::from(jitter) + 0.5).floor();
            assert_eq!(f64::from(probe.landing), landing, "xi {xi}, jitter {jitter}");
            assert!(f64::from(probe.landing).abs() <= (0.5 * f64::from(jitter) - 0.5).ceil().max(0.0));
            let error = (f64::from(probe.srgb) - tone::srgb(xi)).abs();
            assert!(error < 0.1 / 255.0, "{xi} is encoded {error} off");
        }
    }
}
