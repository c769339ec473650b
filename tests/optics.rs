//! Pictures of points and edges: where they appear, and how wide they blur.

mod common;

use anyhow::{Result, ensure};
use common::{Gpu, circle_of_confusion, film, pixels, prove, scene_of, settings_of};
use glam::Vec3;
use thinlens::scene::{self, Background, Box, Emissive, Extents, Scene, SceneRef};
use thinlens::settings::Settings;

const SIZE: [u32; 2] = [160, 120];

/// A camera at the origin that looks along -z, 40 degrees high, and something that glows.
fn glowing(shape: &str, diameter: f32, focal_distance: f32, samples: u32) -> Settings {
    let toml = format!(
        "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = {diameter}\n\
         focal_distance = {focal_distance}\n[emissive.lamp]\nradiance = 1\n{shape}material = \"lamp\"\n"
    );
    settings_of(&toml, SIZE, samples)
}

/// A square parallel to the lens: unlike a ball's its picture is not stretched off the axis.
fn tile([x, y, z]: [f64; 3], edge: f64) -> String {
    let half = edge / 2.0;
    format!(
        "[[box]]\nlower = [{}, {}, {}]\nupper = [{}, {}, {z}]\n",
        x - half,
        y - half,
        z - 1e-3,
        x + half,
        y + half
    )
}

/// Pixels per unit of slope.
fn k() -> f64 {
    f64::from(SIZE[1]) / 2.0 / 20_f64.to_radians().tan()
}

/// Where a point appears on the film.
fn project(point: [f64; 3]) -> [f64; 2] {
    [80.0 + k() * point[0] / -point[2], 60.0 - k() * point[1] / -point[2]]
}

/// Sum, centroid, and across x and y the diameter of a disc of the same second moment.
fn spot(film: &[[f32; 4]]) -> (f64, [f64; 2], [f64; 2]) {
    let pixels = || pixels(SIZE).map(|pixel| pixel.map(|at| f64::from(at) + 0.5));
    let light = |index: usize| f64::from(film[index][0]);
    let sum: f64 = (0..film.len()).map(light).sum();
    let mean =
        |f: &dyn Fn([f64; 2]) -> f64| pixels().enumerate().map(|(i, at)| light(i) * f(at)).sum::<f64>() / sum;
    let centroid = [0, 1].map(|axis| mean(&|at| at[axis]));
    // A disc of radius r has a mean square of r^2 / 4 along each axis.
    let diameter = [0, 1].map(|axis| 4.0 * mean(&|at| (at[axis] - centroid[axis]).powi(2)).sqrt());
    (sum, centroid, diameter)
}

/// Catches pictures that are upside down, mirrored, off by half a pixel, or scaled: a point off both
/// axes must appear where it projects to, in focus or not.
#[test]
fn a_point_appears_where_it_projects_to() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut count, mut worst) = (0, 0.0_f64);
        for point in [[2.0, 1.0, -10.0], [-2.5, -1.8, -10.0], [3.0, -2.0, -10.0], [0.0, 0.0, -10.0]] {
            for focal_distance in [10.0, 7.0, 20.0] {
                let settings = glowing(&tile(point, 0.5), 0.5, focal_distance, 64);
                let (sum, centroid, _) = spot(&film(gpu, &settings));
                let expected = project(point);
                ensure!(sum > 0.0, "{point:?} is not in the picture");
                for axis in 0..2 {
                    let error = (centroid[axis] - expected[axis]).abs();
                    worst = worst.max(error);
                    ensure!(error < 0.1, "{point:?} appears at {centroid:.2?}, not {expected:.2?}");
                }
                count += 1;
            }
        }
        Ok(format!("{count} points within {worst:.3} px"))
    };
    prove(check, &["framing"]);
}

/// Catches a lens of the wrong radius (D for D / 2, or its square root), a wrong focal distance, and
/// off the axis a focal sphere: a small lamp spreads over its circle of confusion. Where that is
/// about a pixel, one random pair for film and lens is seen too: then the two spreads do not add as
/// independent ones do.
#[test]
fn a_lamp_out_of_focus_spreads_over_its_circle_of_confusion() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut count, mut worst) = (0, 0.0_f64);
        for (point, diameter, focal_distance) in [
            ([0.0, 0.0, -10.0], 0.5, 5.0),
            ([0.3, 0.2, -10.0], 0.2, 5.25),
            ([0.3, 0.2, -10.0], 0.2, 100.0),
            ([0.0, 0.0, -10.0], 1.0, 25.0),
            ([2.2, 1.4, -10.0], 0.8, 6.0),
            ([-2.2, -1.4, -10.0], 0.8, 16.0),
            ([3.0, 2.0, -10.0], 1.0, 11.5),
        ] {
            let width = 0.08;
            let settings = glowing(&tile(point, width), diameter, focal_distance, 4096);
            let (_, _, measured) = spot(&film(gpu, &settings));
            let z = -point[2];
            let blur = circle_of_confusion(diameter.into(), focal_distance.into(), z, k());
            // The lamp's own square and the pixel's add their second moments, a twelfth of their areas.
            let own = width / z * k();
            let expected = (blur * blur + 16.0 / 12.0 * (own * own + 1.0)).sqrt();
            for got in measured {
                let error = (got / expected - 1.0).abs();
                worst = worst.max(error);
                ensure!(
                    error < 0.02,
                    "{point:?}, D {diameter}, F {focal_distance}: {measured:.2?} px, not {expected:.2}"
                );
                count += 1;
            }
        }
        Ok(format!("{count} diameters within {:.2}%", 100.0 * worst))
    };
    prove(check, &["lens", "one_pair_for_film_and_lens", "disk_radius_squared"]);
}

/// A blurred edge: where it lies along a line of pixels, and over how many it spreads, from what the
/// pixels of the line show on average over several lines.
///
/// The difference of neighbours is the light at their border, blurred by two pixels' widths, which
/// add 2 / 12 to its variance. A disc of diameter c, looked at from the side, has a variance of
/// c^2 / 16.
fn edge(profile: &[f64]) -> (f64, f64) {
    let rise = profile[profile.len() - 1] - profile[0];
    let at = |f: &dyn Fn(f64) -> f64| {
        let steps = profile.windows(2).enumerate();
        steps.map(|(i, pair)| (pair[1] - pair[0]) / rise * f(i as f64 + 1.0)).sum::<f64>()
    };
    let position = at(&|x| x);
    let variance = at(&|x| (x - position).powi(2));
    (position, 4.0 * (variance - 1.0 / 6.0).max(0.0).sqrt())
}

/// What the pixels of columns `columns` show on average over `rows`.
fn profile(film: &[[f32; 4]], width: u32, columns: (u32, u32), rows: (u32, u32)) -> Vec<f64> {
    let pixel = |x: u32, y: u32| f64::from(film[(y * width + x) as usize][0]);
    let column = |x| (rows.0..rows.1).map(|y| pixel(x, y)).sum::<f64>() / f64::from(rows.1 - rows.0);
    (columns.0..columns.1).map(column).collect()
}

/// Catches a wrong lens radius or focal distance, a focal sphere, and a disk filled unevenly, on a step
/// edge in front of and behind the focal plane: upright and lying, through the axis and in the corner.
#[test]
fn an_edge_out_of_focus_spreads_over_its_circle_of_confusion() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (mut count, mut worst, mut worst_place) = (0, 0.0_f64, 0.0_f64);
        for (diameter, focal_distance) in [(0.5, 5.0), (0.3, 7.0), (1.0, 16.0), (0.5, 100.0)] {
            // The slope of the line of sight to the edge, and the lines of pixels across it.
            for (slope, lines) in [(0.0, (40, 80)), (0.35, (2, 38)), (-0.35, (82, 118))] {
                for lying in [false, true] {
                    let slope = if lying { 0.6 * slope } else { slope };
                    let (from, to) = (10.0 * slope, 99.0);
                    let shape = match lying {
                        false => format!("lower = [{from}, -99, -10.001]\nupper = [{to}, 99, -10]\n"),
                        true => format!("lower = [-99, {from}, -10.001]\nupper = [99, {to}, -10]\n"),
                    };
                    let settings = glowing(&format!("[[box]]\n{shape}"), diameter, focal_distance, 1024);
                    let mut film = film(gpu, &settings);
                    let [width, height] = SIZE;
                    let extent = if lying {
                        let at =
                            |along: u32, across: u32| film[((height - 1 - across) * width + along) as usize];
                        film = (0..width)
                            .flat_map(|along| (0..height).map(move |across| at(along, across)))
                            .collect();
                        height
                    } else {
                        width
                    };
                    let (position, measured) = edge(&profile(&film, extent, (0, extent), lines));
                    let place = (position - f64::from(extent) / 2.0 - k() * slope).abs();
                    let expected = circle_of_confusion(diameter.into(), focal_distance.into(), 10.0, k());
                    let error = (measured / expected - 1.0).abs();
                    (worst, worst_place) = (worst.max(error), worst_place.max(place));
                    ensure!(
                        error < 0.02 && place < 0.05,
                        "D {diameter}, F {focal_distance}, an edge at slope {slope}: {measured:.2} px wide, not \
                         {expected:.2}, and {place:.2} px beside its place"
                    );
                    count += 1;
                }
            }
        }
        Ok(format!("{count} edges within {:.2}%, placed within {worst_place:.3} px", 100.0 * worst))
    };
    prove(check, &["lens", "disk_by_polar_angle", "half_a_pixel_off"]);
}

/// The built-in boxes, of which one glows and nothing else does.
fn only_box(number: usize) -> Scene {
    let mut scene = scene::load("suffern-boxes").expect("a built-in scene");
    scene.lights.clear();
    scene.ambient = Vec3::ZERO;
    scene.background = Background::BLACK;
    let lamp = scene.of_kind::<Box>().nth(number).expect("a box").1.material as usize;
    for (index, material) in scene.materials.iter_mut().enumerate() {
        let radiance = if index == lamp { Vec3::ONE } else { Vec3::ZERO };
        *material = Emissive { radiance }.into();
    }
    scene
}

/// Catches a built-in scene that is not the book's, and everything that the edges above catch: the
/// upright edges of Suffern's boxes blur over the pixels that figure 10.11's lens and distances give.
#[test]
fn the_boxes_of_the_book_blur_as_the_book_says() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        // Box, columns that see the edge and nothing else, rows that see only the box, the slope of
        // the silhouette, its depth, and the circle of confusion.
        for (number, columns, rows, slope, depth, expected) in [
            (0, (36, 76), (70, 230), -9.0 / 50.0, 50.0, 10.38),
            (0, (133, 165), (70, 230), -3.0 / 51.0, 51.0, 9.75),
            (2, (330, 365), (90, 185), 18.0 / 98.0, 98.0, 5.30),
            (2, (256, 280), (90, 185), 8.0 / 99.0, 99.0, 5.46),
        ] {
            let mut settings = Settings::of_scene(SceneRef::new(only_box(number)));
            settings.samples = 256;
            let width = settings.estimator.size[0];
            let k = settings.estimator.camera.view_distance_pixels(settings.estimator.size[1]);
            let formula = circle_of_confusion(2.0, 74.0, depth, k);
            ensure!((formula - expected).abs() < 0.005, "the scene is another: {formula} px, not {expected}");
            let (position, measured) = edge(&profile(&film(gpu, &settings), width, columns, rows));
            let position = f64::from(columns.0) + position;
            let place = (position - 200.0 - 800.0 * slope).abs();
            ensure!(
                (measured / expected - 1.0).abs() < 0.02 && place < 0.05,
                "box {}, edge at column {position:.2}: {measured:.3} px wide, not {expected}; {place:.2} px beside \
                 its place",
                number + 1
            );
            figures.push(format!("{measured:.2} ({expected})"));
        }
        Ok(format!("px measured (of the formula): {}", figures.join(", ")))
    };
    prove(check, &["lens_radius_times_1.05", "lens_radius_square_root", "focal_distance_times_1.02"]);
}

/// Catches depths along the ray instead of along the axis, things that count although they are beside the picture or
/// behind the camera, and a ground that begins at the camera.
#[test]
fn a_picture_has_the_depths_of_what_is_in_it() {
    let sphere =
        |[x, z]: [f64; 2]| format!("[[sphere]]\ncenter = [{x}, 0, {z}]\nradius = 1\nmaterial = \"m\"\n");
    let spheres = [[0.0, -10.0], [5.0, -20.0], [30.0, -10.0], [0.0, 10.0]].map(sphere).concat();
    let scene = scene_of(&format!(
        "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 90\nlens_diameter = 0.1\nfocal_distance = 9\n\
         [ambient]\nradiance = 1\n[matte.m]\nka = 0.5\nkd = 0.5\ncolor = [1, 1, 1]\n\
         [[plane]]\npoint = [0, -2, 0]\nnormal = [0, 1, 0]\nmaterial = \"m\"\n{spheres}"
    ));
    let depths = Extents::of(&scene).depths(&scene.camera, [100, 100]);
    let expected = [[9.0, 11.0], [19.0, 21.0]];
    assert_eq!(depths.shapes.len(), expected.len(), "{:?}", depths.shapes);
    for (range, expected) in depths.shapes.iter().zip(expected) {
        assert!((0..2).all(|end| (range[end] - expected[end]).abs() < 1e-9), "{range:?}, not {expected:?}");
    }
    // The lowest row looks down by 45 degrees, and the horizon is in the picture.
    let [[nearest, farthest]] = depths.planes[..] else { panic!("{:?}", depths.planes) };
    assert!((nearest - 2.0).abs() < 1e-9 && farthest == f64::INFINITY, "{nearest} to {farthest}");
    assert!(depths.meet([1.0, 2.5]) && !depths.meet([0.5, 1.5]) && depths.meet([100.0, f64::INFINITY]));
}
