//! Where points appear, and how wide they blur.

mod common;

use common::{Gpu, film, scene_of, small};
use thinlens::settings::Settings;

/// A small emitter at `center` in front of black, seen from the origin along -z.
fn emitter(center: [f64; 3], radius: f64, diameter: f32, focal_distance: f32, samples: u32) -> Settings {
    let [x, y, z] = center;
    let scene = scene_of(&format!(
        r#"
        [camera]
        eye = [0, 0, 0]
        look_at = [0, 0, -1]
        vfov_degrees = 40
        lens_diameter = 0
        focal_distance = 1
        [emissive.lamp]
        radiance = 1
        [[sphere]]
        center = [{x}, {y}, {z}]
        radius = {radius}
        material = "lamp"
        "#
    ));
    let mut settings = small("version-4");
    settings.estimator.camera = scene.camera;
    settings.estimator.lens.diameter = diameter;
    settings.estimator.lens.focal_distance = focal_distance;
    settings.estimator.size = [160, 120];
    settings.estimator.scene = scene;
    settings.samples = samples;
    settings
}

/// Sum, centroid, and across x and y the diameter of a disc of the same second moment.
fn spot(film: &[[f32; 4]]) -> (f64, [f64; 2], [f64; 2]) {
    let pixels =
        || (0..120_u32).flat_map(|y| (0..160_u32).map(move |x| [f64::from(x) + 0.5, f64::from(y) + 0.5]));
    let light = |index: usize| f64::from(film[index][0]);
    let sum: f64 = (0..film.len()).map(light).sum();
    let mean =
        |f: &dyn Fn([f64; 2]) -> f64| pixels().enumerate().map(|(i, at)| light(i) * f(at)).sum::<f64>() / sum;
    let centroid = [0, 1].map(|axis| mean(&|at| at[axis]));
    // A disc of radius r has a mean square of r^2 / 4 along each axis.
    let diameter = [0, 1].map(|axis| 4.0 * mean(&|at| (at[axis] - centroid[axis]).powi(2)).sqrt());
    (sum, centroid, diameter)
}

/// Pixels per unit of slope, and the film position of a point.
fn project(settings: &Settings, point: [f64; 3]) -> [f64; 2] {
    let k = settings.estimator.camera.view_distance_pixels(120);
    [80.0 + k * point[0] / -point[2], 60.0 - k * point[1] / -point[2]]
}

/// Catches pictures that are upside down, mirrored, off by half a pixel, or scaled: a point off
/// both axes must appear where it projects to, in focus or not.
#[test]
fn a_point_appears_where_it_projects_to() {
    let gpu = Gpu::new();
    for point in [[2.0, 1.0, -10.0], [-2.5, -1.8, -10.0], [3.0, -2.0, -10.0], [0.0, 0.0, -10.0]] {
        for focal_distance in [10.0, 7.0, 20.0] {
            let settings = emitter(point, 0.3, 0.5, focal_distance, 64);
            let (sum, centroid, _) = spot(&film(&gpu, &settings));
            let expected = project(&settings, point);
            assert!(sum > 0.0, "{point:?} is in the picture");
            for axis in 0..2 {
                let error = (centroid[axis] - expected[axis]).abs();
                assert!(error < 0.1, "{point:?} at {centroid:?}, not {expected:?}");
            }
        }
    }
}

/// Catches a lens of the wrong radius (D for D / 2, or its square root) and a wrong focal distance:
/// a point off the focal plane spreads over `D |z - F| / (z F) k` pixels. Off the axis too, which
/// a focal sphere fails. Where the blur is about a pixel's width, one random pair for film and lens
/// fails too: then the two spreads do not add as independent ones do.
#[test]
fn a_point_out_of_focus_spreads_over_the_circle_of_confusion() {
    let gpu = Gpu::new();
    for (point, diameter, focal_distance) in [
        ([0.0, 0.0, -10.0], 0.5, 5.0),
        ([0.3, 0.2, -10.0], 0.2, 5.25),
        ([0.3, 0.2, -10.0], 0.2, 100.0),
        ([0.0, 0.0, -10.0], 1.0, 25.0),
        ([2.2, 1.4, -10.0], 0.8, 6.0),
        ([-2.2, -1.4, -10.0], 0.8, 16.0),
    ] {
        let radius = 0.05;
        let settings = emitter(point, radius, diameter, focal_distance, 4096);
        let (_, _, measured) = spot(&film(&gpu, &settings));
        let k = settings.estimator.camera.view_distance_pixels(120);
        let (z, f, d) = (-point[2], f64::from(focal_distance), f64::from(diameter));
        let blur = d * (z - f).abs() / (z * f) * k;
        // The emitter's own disc and the pixel's square add their second moments.
        let own = 2.0 * radius / z * k;
        let expected = (blur * blur + own * own + 16.0 / 12.0).sqrt();
        for diameter in measured {
            let error = (diameter / expected - 1.0).abs();
            assert!(error < 0.02, "{point:?}, D {d}, F {f}: {measured:.2?} px, not {expected:.2}");
        }
    }
}

/// Catches a lens that adds or loses light: blur spreads a flat emitter's light, no more.
#[test]
fn blur_keeps_the_light() {
    let gpu = Gpu::new();
    let sums = [0.0, 0.4, 1.0].map(|diameter| {
        let settings = emitter([0.5, -0.4, -10.0], 0.4, diameter, 6.0, 256);
        spot(&film(&gpu, &settings)).0
    });
    for sum in sums {
        assert!((sum / sums[0] - 1.0).abs() < 0.02, "{sums:?}");
    }
}
