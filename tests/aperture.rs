//! The shape of the aperture: blades, cat's eye, anamorphic, image.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::scenes::EVERYTHING;
use common::{Gpu, probe, prove, render, run, settings_of};
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;
use thinlens::gpu_types::{ApertureBuffer, aperture_constant, aperture_sums, lens_constants};
use thinlens::interface::{self, binding};
use thinlens::passes::{ApertureBuffers, BlueNoiseTile};
use thinlens::reference::{aperture, sampler};
use thinlens::scene::{Aperture, ApertureImage};
use thinlens::settings::{Estimator, Sampler};
use thinlens::verify::verify;
use thinlens::vulkan::{Binding, BindingSet, Buffer, Commands, ComputePipeline, Residence};

/// The number of Sobol points. Equal parts of the unit square hold equally many of them.
const POINTS: u32 = 1 << 16;
/// The number of cells in each direction in which the points of a shape are counted.
const CELLS: usize = 16;

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Place {
    q: [f32; 2],
    xi: [f32; 2],
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Point {
    point: [f32; 3],
    pad0: u32,
}

fn estimator(aperture: Aperture) -> Estimator {
    let mut estimator = settings_of(EVERYTHING, [64, 48], 8).estimator;
    estimator.aperture = aperture;
    estimator
}

/// The device's points.
fn points(gpu: &Gpu, estimator: &Estimator, places: &[Place]) -> Result<Vec<[f64; 3]>> {
    let device = gpu.device();
    let sums = estimator.aperture.image.as_ref().map(aperture_sums).unwrap_or_default();
    let aperture = ApertureBuffers::new(device, &sums)?;
    let mut commands = Commands::new(device)?;
    let mut recording = commands.begin()?;
    aperture.record(&mut recording, &ApertureBuffer::new(estimator));
    recording.submit()?;
    commands.wait()?;

    let pipeline = ComputePipeline::new(device, gpu.shader("aperture"), &lens_constants(estimator))?;
    let input = Arc::new(Buffer::upload(device, "places", places)?);
    let bytes = size_of::<Point>() * places.len();
    let output = Arc::new(Buffer::new(device, "points", bytes as u64, Residence::Host)?);
    let mut bindings = vec![
        (binding::PROBE_INPUTS, Binding::Buffer(input)),
        (binding::PROBE_OUTPUTS, Binding::Buffer(Arc::clone(&output))),
    ];
    bindings.extend(aperture.bindings());
    bindings.push(BlueNoiseTile::new(device)?.binding());
    let bindings = BindingSet::new(&pipeline, &bindings)?;
    probe::run(gpu, &pipeline, &bindings, &[], [u32::try_from(places.len())?, 1]);
    let points: Vec<Point> = bytemuck::allocation::pod_collect_to_vec(&output.bytes()[..bytes]);
    Ok(points.iter().map(|point| point.point.map(f64::from)).collect())
}

/// A ring with a hole, brighter at its right, and a dot at the upper left.
fn ring(folder: &Path) -> ApertureImage {
    let path = folder.join("ring.png");
    let size = 96_u32;
    let levels = (0..size * size).map(|i| {
        let [x, y] = [i % size, i / size].map(|at| (f64::from(at) + 0.5) / f64::from(size) * 2.0 - 1.0);
        let radius = x.hypot(y);
        let dot = (x + 0.8).hypot(y + 0.8) < 0.15;
        if dot || (0.4..0.9).contains(&radius) { if x > 0.0 { 255 } else { 128 } } else { 0 }
    });
    let file = std::fs::File::create(&path).expect("a writable folder");
    let mut encoder = png::Encoder::new(file, size, size);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&levels.collect::<Vec<u8>>()).expect("pixels");
    writer.finish().expect("a file");
    ApertureImage::read(&path).expect("an image")
}

/// A shape, by the book: how much light comes in at a point, for a film point off the middle.
struct Shape {
    aperture: Aperture,
    /// Where the film point lies, as a share of the way to the picture's corner.
    film: [f64; 2],
    light: Box<dyn Fn([f64; 2]) -> f64>,
}

fn shapes(folder: &Path) -> Vec<Shape> {
    let plain = Aperture::default();
    let mut shapes = Vec::new();
    for (blades, rotation_degrees) in [(3, 0.0), (5, 20.0), (6, -33.0), (16, 90.0)] {
        for roundness in [0.0, 0.3, 1.0] {
            let aperture = Aperture { blades, rotation_degrees, roundness, ..plain.clone() };
            let half = PI / f64::from(blades);
            let light = move |[x, y]: [f64; 2]| {
                let turned = y.atan2(x) - f64::from(rotation_degrees).to_radians();
                let angle = (turned + half).rem_euclid(2.0 * half) - half;
                let straight = half.cos() / angle.cos();
                let round = f64::from(roundness);
                let edge = ((1.0 - round) * straight * straight + round).sqrt();
                if x.hypot(y) <= edge { 1.0 } else { 0.0 }
            };
            shapes.push(Shape { aperture, film: [0.3, 0.1], light: Box::new(light) });
        }
    }
    for (cats_eye, film) in [(0.4, [0.0, 0.0]), (0.4, [0.6, 0.8]), (0.7, [-0.5, 0.3]), (0.9, [0.1, -0.9])] {
        let aperture = Aperture { cats_eye, ..plain.clone() };
        let off = film.map(|share| -2.0 * f64::from(cats_eye) * share);
        let light = move |[x, y]: [f64; 2]| {
            let inside = x.hypot(y) <= 1.0 && (x - off[0]).hypot(y - off[1]) <= 1.0;
            if inside { 1.0 } else { 0.0 }
        };
        shapes.push(Shape { aperture, film, light: Box::new(light) });
    }
    for anamorphic in [0.5, 2.0] {
        let aperture = Aperture { anamorphic, ..plain.clone() };
        let [width, height] = if anamorphic > 1.0 { [0.5, 1.0] } else { [1.0, 0.5] };
        let light = move |[x, y]: [f64; 2]| if (x / width).hypot(y / height) <= 1.0 { 1.0 } else { 0.0 };
        shapes.push(Shape { aperture, film: [0.3, 0.1], light: Box::new(light) });
    }
    // Profiles: at the squared distance t from the centre, as a share of that of the rim, 1 + p (1 - 2 t) of the light.
    for profile in [-1.0, -0.4, 0.7, 1.0] {
        let of = move |t: f64| if t <= 1.0 { 1.0 + f64::from(profile) * (1.0 - 2.0 * t) } else { 0.0 };
        let aperture = Aperture { profile, ..plain.clone() };
        let light = move |[x, y]: [f64; 2]| of(x * x + y * y);
        shapes.push(Shape { aperture, film: [0.3, 0.1], light: Box::new(light) });
        let aperture = Aperture { profile, anamorphic: 2.0, ..plain.clone() };
        let light = move |[x, y]: [f64; 2]| of(4.0 * x * x + y * y);
        shapes.push(Shape { aperture, film: [0.3, 0.1], light: Box::new(light) });
        let aperture = Aperture { profile, blades: 4, ..plain.clone() };
        // The middles of a square's edges are at the right, at the top and so on, at the squared distance 1/2.
        let light = move |[x, y]: [f64; 2]| of(2.0 * x.abs().max(y.abs()).powi(2));
        shapes.push(Shape { aperture, film: [0.3, 0.1], light: Box::new(light) });
        let aperture = Aperture { profile, cats_eye: 0.7, ..plain.clone() };
        let light = move |[x, y]: [f64; 2]| {
            if (x - 0.7).hypot(y + 0.42) <= 1.0 { of(x * x + y * y) } else { 0.0 }
        };
        shapes.push(Shape { aperture, film: [-0.5, 0.3], light: Box::new(light) });
    }
    let image = ring(folder);
    let cells = image.cells.clone();
    let light = move |[x, y]: [f64; 2]| {
        let [column, row] = [x, -y].map(|at| ((at + 1.0) / 2.0 * 96.0) as usize);
        if column < 96 && row < 96 { f64::from(cells[row * 96 + column]) } else { 0.0 }
    };
    let aperture = Aperture { image: Some(image), ..plain };
    shapes.push(Shape { aperture, film: [0.3, 0.1], light: Box::new(light) });
    shapes
}

fn cell([x, y]: [f64; 2]) -> usize {
    let [column, row] = [x, y].map(|at| (((at + 1.0) / 2.0 * CELLS as f64) as usize).min(CELLS - 1));
    row * CELLS + column
}

/// Catches a shape that has another size, is turned or mirrored, or has its corners elsewhere; light that comes in more
/// in the middle than at the rim; and points that are thrown away, because equal parts of the sample values would then
/// not be equal parts of the aperture. The test computes each shape anew by the book, and sums its light over a fine
/// grid.
#[test]
fn light_comes_in_evenly_all_over_the_aperture() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let shapes = shapes(folder.path());
    let values_of_samples: Vec<[f64; 2]> = (0..POINTS)
        .map(|index| {
            let [_, _, x, y] = sampler::sample_values(Sampler::Sobol, 0, [3, 5], index, 0);
            [x, y]
        })
        .collect();
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut worst, mut worst_point, mut stray) = (0.0_f64, 0.0_f64, 0);
        for Shape { aperture, film, light } in &shapes {
            let estimator = estimator(aperture.clone());
            let [width, height] = estimator.size.map(f64::from);
            let corner = width.hypot(height) / 2.0 / estimator.camera.view_distance_pixels(estimator.size[1]);
            let q = film.map(|share| (share * corner) as f32);
            let places: Vec<Place> =
                values_of_samples.iter().map(|xi| Place { q, xi: xi.map(|value| value as f32) }).collect();
            let got = points(gpu, &estimator, &places)?;

            let mut found = vec![0.0; CELLS * CELLS];
            for (xi, point) in values_of_samples.iter().zip(&got) {
                let (expected, share) = aperture::point(aperture, estimator.model, *film, *xi);
                let off = (point[0] - expected[0]).hypot(point[1] - expected[1]);
                if off > 1e-4 {
                    stray += 1;
                } else {
                    worst_point = worst_point.max(off);
                }
                ensure!(
                    (point[2] - share).abs() < 1e-5,
                    "{aperture:?}: {} of the light, not {share}",
                    point[2]
                );
                found[cell([point[0], point[1]])] += point[2] / got.len() as f64;
            }
            let passed: f64 = found.iter().sum();
            // Rounding may choose the next cell of an image, or the other part of a bent blade.
            ensure!(stray < 100, "{aperture:?}: {stray} points are not the oracle's");

            let fine: u32 = 32 * CELLS as u32;
            let mut expected = vec![0.0; CELLS * CELLS];
            for pixel in common::pixels([fine; 2]) {
                let at = pixel.map(|at| (f64::from(at) + 0.5) / f64::from(fine) * 2.0 - 1.0);
                expected[cell(at)] += light(at);
            }
            let all: f64 = expected.iter().sum();
            for (found, expected) in found.iter().zip(&expected) {
                let error = (found / passed - expected / all).abs();
                worst = worst.max(error);
                ensure!(
                    error < 4e-4,
                    "{aperture:?}: a cell has {found} of the light, not {}",
                    expected / all
                );
            }
            let share = all / f64::from(fine).powi(2) * 4.0 / PI;
            if aperture.cats_eye > 0.0 {
                ensure!((passed - share).abs() < 1e-3, "{passed} of a disc's light passes, not {share}");
            }
        }
        Ok(format!(
            "{} shapes: a cell of {CELLS} by {CELLS} is off by {worst:.1e} of the light, points by {worst_point:.1e}; {stray} stray",
            shapes.len()
        ))
    };
    prove(check, &["aperture"]);
}

/// Catches an aperture that the trace pass does not look through, or that does not darken where it closes:
/// whole scenes, sample by sample, against the oracle. And one that stays when the next is chosen.
#[test]
fn pictures_are_taken_through_the_aperture() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let image = ring(folder.path());
    let plain = Aperture::default();
    let apertures = [
        Aperture { blades: 5, rotation_degrees: 12.0, roundness: 0.2, anamorphic: 1.6, ..plain.clone() },
        Aperture { blades: 7, ..plain.clone() },
        Aperture { cats_eye: 0.6, ..plain.clone() },
        Aperture { anamorphic: 0.6, ..plain.clone() },
        Aperture { profile: -0.8, ..plain.clone() },
        Aperture { profile: 0.9, cats_eye: 0.6, ..plain.clone() },
        Aperture { image: Some(image), ..plain.clone() },
        plain,
    ];
    let mut kinds: Vec<u32> =
        apertures.iter().map(|of| aperture_constant(&estimator(of.clone())).1).collect();
    kinds.sort_unstable();
    kinds.dedup();
    assert_eq!(kinds.len(), interface::aperture::NAMES.len(), "every kind is looked through");
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings_of(EVERYTHING, [64, 48], 8));
        let (mut samples, mut mismatches) = (0, 0);
        for aperture in &apertures {
            for sampler in [Sampler::BlueNoise, Sampler::Random] {
                let mut settings = settings_of(EVERYTHING, [64, 48], 8);
                settings.estimator.aperture = aperture.clone();
                settings.estimator.sampler = sampler;
                let agreement = verify(&mut renderer, &settings)?;
                samples += agreement.samples;
                mismatches += agreement.mismatches;
            }
        }
        Ok(format!("{samples} samples, {mismatches} differ"))
    };
    prove(
        check,
        &[
            "blades_of_one_edge",
            "cats_eye_not_darkened",
            "cats_eye_on_the_other_side",
            "aperture_image_upside_down",
            "anamorphic_sideways",
            "disc_of_half_the_area",
            "one_pair_for_film_and_lens",
        ],
    );
}

/// Catches a pinhole with a shape: it has none, and lets in all the light.
#[test]
fn a_pinhole_has_no_shape() {
    let gpu = Gpu::new();
    let mut settings = settings_of(EVERYTHING, [64, 48], 2);
    let mut renderer = gpu.renderer(&settings);
    settings.estimator.model = thinlens::scene::CameraModel::Pinhole;
    let plain = common::bits(&render(&mut renderer, &settings).expect("a film"));
    settings.estimator.aperture.cats_eye = 0.8;
    assert!(plain == common::bits(&render(&mut renderer, &settings).expect("a film")));
}

/// Catches shapes that are taken for others, and messages that do not say what to do.
#[test]
fn what_is_no_aperture_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    ring(folder.path());
    std::fs::write(folder.path().join("text.png"), "not an image").expect("a writable folder");
    let black = std::fs::File::create(folder.path().join("black.png")).expect("a writable folder");
    let mut encoder = png::Encoder::new(black, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[0; 4]).expect("pixels");
    writer.finish().expect("a file");
    for (arguments, code, message) in [
        (&["--blades", "2"][..], 2, "must be from 3 to 16"),
        (&["--blades", "17"], 2, "must be from 3 to 16"),
        (&["--roundness", "1.1"], 2, "roundness is 1.1"),
        (&["--anamorphic", "0"], 2, "anamorphic is 0"),
        (&["--cats-eye", "nan"], 2, "cats-eye is NaN"),
        (&["--blades", "5", "--cats-eye", "0.2"], 2, "choose one"),
        (&["--blades", "5", "--aperture-image", "ring.png"], 2, "choose one"),
        (&["--aperture-image", "none.png"], 1, "cannot read none.png"),
        (&["--aperture-image", "text.png"], 1, "not a PNG"),
        (&["--aperture-image", "black.png"], 1, "no light"),
    ] {
        let outcome = run(folder.path(), &[&["render", "-o", "out.png"], arguments].concat());
        assert_eq!(outcome.code, code, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    }
}

/// Catches brightness that goes with the diameter alone where the shape leaves less open, while it is not locked: by
/// the areas of regular polygons, ovals and images.
#[test]
fn unlocked_brightness_is_proportional_to_the_area_of_the_aperture() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("half.png");
    // Two by four pixels, of which half are white: as open as half of half a square.
    let mut encoder = png::Encoder::new(std::fs::File::create(&file).expect("a file"), 2, 4);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[255, 0, 255, 0, 0, 255, 0, 255]).expect("pixels");
    writer.finish().expect("a picture");
    let image = Some(ApertureImage::read(&file).expect("an image"));

    let polygon = |blades: f64| 0.5 * blades * (2.0 * PI / blades).sin() / PI;
    let plain = Aperture::default();
    let cases = [
        (plain.clone(), 1.0),
        (Aperture { blades: 3, ..plain.clone() }, polygon(3.0)),
        (Aperture { blades: 6, rotation_degrees: 20.0, ..plain.clone() }, polygon(6.0)),
        (Aperture { blades: 6, roundness: 1.0, ..plain.clone() }, 1.0),
        (Aperture { blades: 5, roundness: 0.5, ..plain.clone() }, 0.5 * (1.0 + polygon(5.0))),
        (Aperture { anamorphic: 2.0, ..plain.clone() }, 0.5),
        (Aperture { anamorphic: 0.25, blades: 8, ..plain.clone() }, 0.25 * polygon(8.0)),
        (Aperture { image, ..plain }, 0.25 * 4.0 / PI),
    ];
    for (aperture, expected) in cases {
        let mut settings = settings_of(EVERYTHING, [64, 48], 8);
        settings.estimator.aperture = aperture;
        assert_eq!(settings.exposure(), 1.0, "it is locked");
        settings.view.exposure_lock = false;
        let got = f64::from(settings.exposure());
        assert!(
            (got / expected - 1.0).abs() < 1e-5,
            "{:?}: {got}, not {expected}",
            settings.estimator.aperture
        );
    }
}
