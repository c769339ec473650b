//! The oracle against closed forms, and the device against the oracle.

mod common;

use common::{Gpu, scene_of, small};
use glam::DVec3;
use thinlens::reference::sampler::{concentric_disk, pcg4d, sample_values};
use thinlens::reference::{Reference, tone};
use thinlens::renderer::Renderer;
use thinlens::settings::{Estimator, Settings};
use thinlens::verify::{Agreement, compare, verify};

/// Catches an oracle whose disk map is not Shirley and Chiu's: centre, axes and corners are known,
/// radii stay within one, and the moments are those of a uniform disk.
#[test]
fn the_disk_map_is_concentric() {
    let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12;
    let half = 0.5_f64.sqrt();
    for (square, disk) in [
        ([0.5, 0.5], [0.0, 0.0]),
        ([1.0, 0.5], [1.0, 0.0]),
        ([0.0, 0.5], [-1.0, 0.0]),
        ([0.5, 1.0], [0.0, 1.0]),
        ([0.5, 0.0], [0.0, -1.0]),
        ([1.0, 1.0], [half, half]),
        ([0.0, 1.0], [-half, half]),
        ([0.0, 0.0], [-half, -half]),
        ([1.0, 0.0], [half, -half]),
        ([0.75, 0.5], [0.5, 0.0]),
    ] {
        assert!(close(concentric_disk(square), disk), "{square:?} to {:?}", concentric_disk(square));
    }
    let n = 400;
    let (mut sum, mut square) = (DVec3::ZERO, DVec3::ZERO);
    for i in 0..n * n {
        let xi = [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
        let [x, y] = concentric_disk(xi);
        assert!(x * x + y * y <= 1.0 + 1e-12);
        sum += DVec3::new(x, y, 0.0);
        square += DVec3::new(x * x, y * y, x * y);
    }
    let (mean, square) = (sum / f64::from(n * n), square / f64::from(n * n));
    assert!(mean.length() < 1e-9, "{mean}");
    assert!((square - DVec3::new(0.25, 0.25, 0.0)).length() < 1e-5, "{square}");
}

/// Catches a hash that is off by a constant: it must scatter, and equal its definition at zero.
#[test]
fn the_sampler_is_the_one_that_is_cited() {
    // By hand: with all inputs c = 1013904223, four multiply-adds, a fold, and four more.
    let c = 1_013_904_223_u32;
    let round = |v: [u32; 4]| {
        let x = v[0].wrapping_add(v[1].wrapping_mul(v[3]));
        let y = v[1].wrapping_add(v[2].wrapping_mul(x));
        let z = v[2].wrapping_add(x.wrapping_mul(y));
        [x, y, z, v[3].wrapping_add(y.wrapping_mul(z))]
    };
    assert_eq!(pcg4d([0; 4]), round(round([c; 4]).map(|v| v ^ (v >> 16))));
    let mut sums = [0.0; 4];
    for index in 0..10_000 {
        let values = sample_values(3, [17, 5], index, 0);
        for (sum, value) in sums.iter_mut().zip(values) {
            assert!((0.0..1.0).contains(&value));
            *sum += value / 10_000.0;
        }
    }
    // Five standard deviations of the mean of 10,000 uniform values.
    assert!(sums.iter().all(|mean| (mean - 0.5).abs() < 5.0 * (1.0_f64 / 12.0).sqrt() / 100.0), "{sums:?}");
}

fn with(scene: &str, size: [u32; 2]) -> Settings {
    let scene = scene_of(scene);
    let mut settings = Settings::of_scene(scene);
    settings.estimator.size = size;
    settings.samples = 1;
    settings
}

const CAMERA: &str = "[camera]\neye = [1, 2, 3]\nlook_at = [0, 1, -4]\nvfov_degrees = 70\n\
                      lens_diameter = 0.8\nfocal_distance = 6\n";

/// Catches a focal sphere, and a field of view measured to the wrong edge: every primary ray of a
/// film position, whatever its lens point, passes through one point of the focal plane, and that
/// point projects back to the film position.
#[test]
fn primary_rays_meet_in_the_focal_plane() {
    let settings = with(CAMERA, [40, 30]);
    let estimator = &settings.estimator;
    let frame = estimator.camera.frame();
    let eye = estimator.camera.eye.as_dvec3();
    let reference = Reference::new(estimator);
    for pixel in [[0, 0], [39, 0], [0, 29], [39, 29], [20, 15], [7, 22]] {
        for index in 0..50 {
            let sample = reference.sample(pixel, index);
            let along = sample.ray.direction.dot(-frame.w());
            let start = (sample.ray.origin - eye).dot(-frame.w());
            let focus = sample.ray.origin + (6.0 - start) / along * sample.ray.direction;
            // Back through the lens centre: slope times height over twice the half height's slope.
            let relative = focus - eye;
            let k = 15.0 / 35_f64.to_radians().tan();
            let x = 20.0 + k * relative.dot(frame.u()) / 6.0;
            let y = 15.0 - k * relative.dot(frame.v()) / 6.0;
            let expected = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + sample.offset[axis]);
            assert!((x - expected[0]).abs() < 1e-9 && (y - expected[1]).abs() < 1e-9, "{pixel:?}, {index}");
            let lens_point = sample.ray.origin - eye;
            assert!(lens_point.length() <= 0.4 + 1e-12 && lens_point.dot(frame.w()).abs() < 1e-12);
        }
    }
}

/// Catches wrong factors in the shading: each term alone has a value that can be written down.
#[test]
fn shading_has_the_values_of_its_formulas() {
    let floor = "[camera]\neye = [0, 5, 0]\nlook_at = [0, 0, 0]\nup = [0, 0, -1]\nvfov_degrees = 1\n\
                 lens_diameter = 0\nfocal_distance = 5\n[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 2, 0]\n\
                 material = \"m\"\n";
    let matte = "[matte.m]\nka = 0.5\nkd = 0.6\ncolor = [1, 0.5, 0.25]\n";
    let light = |direction: &str| format!("[[directional]]\ndirection = {direction}\nradiance = 3\n");
    let lit = |cosine: f64| DVec3::new(1.0, 0.5, 0.25) * (0.6 / std::f64::consts::PI * 3.0 * cosine);
    let blocker = "[[sphere]]\ncenter = [3, 3, 0]\nradius = 0.5\nmaterial = \"m\"\n";
    let slanted = light("[1, 1, 0]");
    let cases = [
        (format!("[ambient]\nradiance = 2\n{matte}"), DVec3::new(1.0, 0.5, 0.25)),
        (format!("{}{matte}", light("[0, 1, 0]")), lit(1.0)),
        (format!("{slanted}{matte}"), lit(0.5_f64.sqrt())),
        (format!("{}{matte}", light("[0, -1, 0]")), DVec3::ZERO),
        (format!("{slanted}{matte}{blocker}"), DVec3::ZERO),
        (format!("{slanted}shadows = false\n{matte}{blocker}"), lit(0.5_f64.sqrt())),
        (format!("[[point]]\nposition = [3, 3, 0]\nradiance = 3\n{matte}"), lit(0.5_f64.sqrt())),
        ("[emissive.m]\nradiance = 4\ncolor = [0.5, 1, 0]\n".into(), DVec3::new(2.0, 4.0, 0.0)),
        (
            "[background]\nhorizon = [0, 0, 0]\nzenith = [1, 1, 1]\n[mirror.m]\nkr = 0.5\ncolor = [1, 0.5, 0]\n".into(),
            DVec3::new(0.5, 0.25, 0.0),
        ),
        (
            format!("{}[phong.m]\nka = 0\nkd = 0\nks = 0.5\nexponent = 9\ncolor = [1, 1, 1]\n", light("[0, 1, 0]")),
            DVec3::splat(1.5),
        ),
    ];
    for (scene, expected) in cases {
        let settings = with(&format!("{floor}{scene}"), [1, 1]);
        let mut estimator = settings.estimator.clone();
        estimator.jitter = 0.0;
        let radiance = Reference::new(&estimator).sample([0, 0], 0).radiance;
        assert!((radiance - expected).length() < 1e-6, "{scene}: {radiance}, not {expected}");
    }
}

/// Catches a tone curve with a step: the two branches of sRGB meet.
#[test]
fn srgb_is_continuous_and_keeps_black_and_white() {
    assert_eq!((tone::srgb(-1.0), tone::srgb(0.0)), (0.0, 0.0));
    assert!((tone::srgb(1.0) - 1.0).abs() < 1e-12 && tone::srgb(2.0) == tone::srgb(1.0));
    assert!((tone::srgb(0.003_130_8) - tone::srgb(0.003_130_9)).abs() < 1e-5);
    assert!((tone::srgb(0.214_041_14) - 0.5).abs() < 1e-6);
}

/// A scene with every kind of shape, material and light, seen from close by.
const EVERYTHING: &str = r#"
[camera]
eye = [0.3, 1.5, 4]
look_at = [0, 0.8, 0]
vfov_degrees = 55
lens_diameter = 0.4
focal_distance = 3.6
[background]
horizon = [0.9, 0.6, 0.4]
zenith = [0.1, 0.2, 0.6]
[ambient]
radiance = 0.4
[[directional]]
direction = [0.5, 1, 0.7]
radiance = 2
[[point]]
position = [-2, 3, 2]
color = [1, 0.7, 0.5]
radiance = 1.5
[matte.floor]
ka = 0.5
kd = 0.8
color = { even = [0.8, 0.8, 0.7], odd = [0.2, 0.3, 0.3], size = 0.7 }
[phong.shiny]
ka = 0.3
kd = 0.6
ks = 0.4
exponent = 25
color = [0.3, 0.1, 0.6]
[mirror.glass]
kr = 0.8
color = [0.9, 1, 0.8]
ks = 0.3
exponent = 80
[emissive.lamp]
radiance = 3
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
[[sphere]]
center = [-0.9, 0.7, 0.2]
radius = 0.7
material = "glass"
[[sphere]]
center = [1.6, 1.8, -1]
radius = 0.2
material = "lamp"
[[box]]
lower = [0.4, 0, -0.6]
upper = [1.2, 1.1, 0.3]
material = "shiny"
[[triangle]]
vertices = [[-0.2, 0, 1], [0.5, 0, 1.2], [0.1, 0.9, 0.7]]
material = "glass"
"#;

/// A room seen from inside, and a ball beyond its lamp that must not shadow anything.
const ROOM: &str = r#"
[camera]
eye = [0.2, 0.1, 1.8]
look_at = [0, 0, 0]
vfov_degrees = 80
lens_diameter = 0.1
focal_distance = 2
[[point]]
position = [0.3, 0.6, 0.4]
radiance = 3
[matte.wall]
ka = 0
kd = 0.8
color = { even = [0.9, 0.8, 0.7], odd = [0.3, 0.4, 0.5], size = 0.37 }
[[box]]
lower = [-1.5, -1, -2]
upper = [1.5, 1.2, 2]
material = "wall"
[[sphere]]
center = [0.5, 0.95, 0.6]
radius = 0.15
material = "wall"
"#;

fn scenes() -> Vec<Settings> {
    let mut all: Vec<Settings> = ["version-4", "suffern-boxes", "suffern-mirror"].map(small).into();
    all.push(with(EVERYTHING, [64, 48]));
    all.push(with(ROOM, [64, 48]));
    for settings in &mut all {
        settings.samples = 8;
    }
    all
}

/// Catches a shader that strays from the mathematics anywhere on the way from the sampler to the
/// radiance: every sample of every scene is held against the oracle's.
#[test]
fn the_device_renders_what_the_oracle_does() {
    let gpu = Gpu::new();
    let mut renderer = Renderer::new(gpu.device()).expect("a renderer");
    for settings in scenes() {
        for jitter in [1.0, 0.0] {
            let mut settings = settings.clone();
            settings.estimator.jitter = jitter;
            let agreement = verify(&mut renderer, &settings).unwrap_or_else(|error| panic!("{error}"));
            println!("{}, jitter {jitter}: {agreement:?}", settings.estimator.scene.name);
            assert_eq!(agreement.samples, 64 * 48 * 8);
        }
    }
}

/// Catches a landing, a merge or a gather that differs from the film's formula: whole films with
/// narrow and wide jitter, counts exact.
#[test]
fn the_film_is_the_oracles() {
    let gpu = Gpu::new();
    for (jitter, samples) in [(1.0, 9), (3.0, 5), (2.2, 4)] {
        let mut settings = with(EVERYTHING, [40, 30]);
        settings.estimator.jitter = jitter;
        settings.samples = samples;
        let device = common::film(&gpu, &settings);
        let oracle = Reference::new(&settings.estimator).render(samples);
        let mut off = 0;
        for (device, oracle) in device.iter().zip(&oracle) {
            assert_eq!(f64::from(device[3]), oracle[3], "counts, jitter {jitter}");
            let differs = (0..3).any(|channel| {
                // Where no sample landed the colours mean nothing.
                oracle[3] > 0.0 && (f64::from(device[channel]) - oracle[channel]).abs() > 1e-3
            });
            off += u32::from(differs);
        }
        // A pixel is off where any of its samples is.
        assert!(f64::from(off) < 1200.0 * f64::from(samples) * 2e-3, "{off} of 1200 pixels, jitter {jitter}");
    }
}

/// Changes what the oracle is asked for, and so makes the device look wrong.
type Fault = fn(&mut Estimator);

/// The comparison must turn red on a fault, or it proves nothing.
#[test]
fn the_comparison_sees_planted_faults() {
    let gpu = Gpu::new();
    let mut renderer = Renderer::new(gpu.device()).expect("a renderer");
    let faults: [(&str, Fault); 7] = [
        ("lens radius x 1.05", |estimator| estimator.lens.diameter *= 1.05),
        ("radius = sqrt of the aperture", |estimator| {
            estimator.lens.diameter = estimator.lens.diameter.sqrt()
        }),
        ("focal distance x 1.02", |estimator| estimator.lens.focal_distance *= 1.02),
        ("jitter dropped", |estimator| estimator.jitter = 0.0),
        ("upside down", |estimator| estimator.camera.up = -estimator.camera.up),
        ("no reflections", |estimator| estimator.max_bounces = 0),
        ("another seed", |estimator| estimator.seed += 1),
    ];
    let settings = with(EVERYTHING, [64, 48]);
    assert!(compare(&mut renderer, &settings, Estimator::clone).expect("a comparison").holds());
    for (name, fault) in faults {
        let faulty = |estimator: &Estimator| {
            let mut estimator = estimator.clone();
            fault(&mut estimator);
            estimator
        };
        let agreement = compare(&mut renderer, &settings, faulty).expect("a comparison");
        assert!(!agreement.holds(), "{name}: {agreement:?}");
    }
}

/// Catches a comparison that lets a NaN, a missing sample or a small tint over everything pass.
#[test]
fn the_bounds_are_bounds() {
    let oracle = vec![[0.5, 0.5, 0.5, 1.0]; 1000];
    let holds = |texel: [f32; 4], how_many: usize| {
        let mut device = vec![[0.5, 0.5, 0.5, 1.0]; 1000];
        device[..how_many].fill(texel);
        let mut agreement = Agreement::default();
        agreement.add(&device, &oracle);
        agreement.holds()
    };
    assert!(holds([0.5, 0.5, 0.5, 1.0], 1000) && holds([0.9, 0.5, 0.5, 1.0], 1));
    assert!(!holds([0.9, 0.5, 0.5, 1.0], 2));
    assert!(!holds([f32::NAN, 0.5, 0.5, 1.0], 2));
    assert!(!holds([0.5, 0.5, 0.5, 0.0], 2));
    assert!(!holds([0.502, 0.5, 0.5, 1.0], 1000));
    assert!(!Agreement::default().holds(), "nothing compared is nothing proved");
}
