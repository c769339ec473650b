//! The lens: where primary rays start, where they meet, and how wide the view is.

mod common;

use anyhow::{Result, ensure};
use bytemuck::{Pod, Zeroable};
use common::probe::probe;
use common::{Gpu, prove, settings_of, slanted_frame};
use glam::{DVec2, DVec3, Vec3};
use thinlens::gpu_types::Camera;
use thinlens::scene::{CameraModel, FORMATS, Hole, Overlay, PRESETS, Preset, SceneRef, Sensor, Tolerance};
use thinlens::settings::{Called, Estimator, Settings, Value, list};

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Place {
    pixel: [u32; 2],
    offset: [f32; 2],
    disk: [f32; 2],
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct ProbedRay {
    origin: [f32; 3],
    pad0: u32,
    direction: [f32; 3],
    pad1: u32,
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct CameraPush {
    camera: Camera,
    extent: [u32; 2],
}

impl CameraPush {
    fn new(estimator: &Estimator) -> Self {
        Self { camera: Camera::new(estimator), extent: estimator.size }
    }
}

/// The device's primary rays: origin and direction.
fn primary_rays(gpu: &Gpu, estimator: &Estimator, places: &[Place]) -> Vec<(DVec3, DVec3)> {
    let push = CameraPush::new(estimator);
    let rays: Vec<ProbedRay> = probe(gpu, "camera", None, bytemuck::bytes_of(&push), places);
    rays.iter()
        .map(|ray| (Vec3::from_array(ray.origin).as_dvec3(), Vec3::from_array(ray.direction).as_dvec3()))
        .collect()
}

/// A camera that looks from somewhere to somewhere, tilted, with a wide lens.
fn slanted(size: [u32; 2], vfov_degrees: f64, diameter: f64, focal_distance: f64) -> Estimator {
    let toml = format!(
        "[camera]\neye = [3, 4, 12]\nlook_at = [-2, 1, -9]\nup = [0.2, 1, 0]\n\
         vfov_degrees = {vfov_degrees}\nlens_diameter = {diameter}\nfocal_distance = {focal_distance}\n"
    );
    settings_of(&toml, size, 1).estimator
}

/// Pixels at corners, edges, centre and between, with offsets to their edges.
fn film_positions([width, height]: [u32; 2]) -> Vec<([u32; 2], [f32; 2])> {
    let along = |extent: u32| [0, extent / 5, extent / 2, extent - 1];
    let offsets = [[0.0, 0.0], [-0.5, -0.5], [0.5, 0.5], [0.5, -0.5], [0.25, -0.125]];
    let pixels = along(height).into_iter().flat_map(|y| along(width).map(|x| [x, y]));
    pixels.flat_map(|pixel| offsets.map(|offset| (pixel, offset))).collect()
}

/// Points of the unit disk: the centre, and rings out to the rim.
fn lens_points() -> Vec<[f32; 2]> {
    let ring = |radius: f32| (0..8).map(move |i| (i as f32 * std::f32::consts::FRAC_PI_4, radius));
    let points = [0.25, 0.5, 0.75, 1.0].into_iter().flat_map(ring);
    std::iter::once([0.0, 0.0])
        .chain(points.map(|(angle, radius)| [radius * angle.cos(), radius * angle.sin()]))
        .collect()
}

/// Every one of those film positions with every one of those lens points.
fn places(size: [u32; 2]) -> Vec<Place> {
    let with_lens =
        |(pixel, offset)| lens_points().into_iter().map(move |disk| Place { pixel, offset, disk });
    film_positions(size).into_iter().flat_map(with_lens).collect()
}

/// Where a point appears on the film, in pixels from its upper left corner: straight through the
/// lens centre. Written from figure 3.18 and section 10.2 of the book.
fn project(point: DVec3, [width, height]: [u32; 2], vfov_degrees: f64) -> DVec2 {
    let (eye, [u, v, w]) = slanted_frame();
    let relative = point - eye;
    let depth = -w.dot(relative);
    let k = f64::from(height) / 2.0 / (vfov_degrees.to_radians() / 2.0).tan();
    DVec2::new(
        f64::from(width) / 2.0 + k * u.dot(relative) / depth,
        f64::from(height) / 2.0 - k * v.dot(relative) / depth,
    )
}

/// Catches a lens of another radius, a focal sphere instead of a plane, and a picture that is
/// turned, mirrored or shifted: for film positions out to the corners and lens points out to the
/// rim, a primary ray starts on the lens where it should and goes through the point of the focal
/// *plane* that projects to the film position.
#[test]
fn primary_rays_go_from_the_lens_to_the_point_in_focus() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (eye, [u, v, w]) = slanted_frame();
        let (mut rays, mut worst_focus, mut worst_pixel, mut worst_start) = (0, 0.0_f64, 0.0_f64, 0.0_f64);
        let mut nearest_sphere = f64::INFINITY;
        for (size, vfov, diameter, focal_distance) in [
            ([33, 21], 65.0, 1.4, 17.0),
            ([20, 30], 40.0, 0.1, 2.5),
            ([640, 360], 90.0, 2.0, 0.8),
            ([8, 8], 20.0, 5.0, 900.0),
        ] {
            let estimator = slanted(size, vfov, diameter, focal_distance);
            let focal_distance = f64::from(estimator.lens.focal_distance);
            let places = places(size);
            for (place, (origin, direction)) in places.iter().zip(primary_rays(gpu, &estimator, &places)) {
                ensure!(
                    (direction.length() - 1.0).abs() < 1e-6,
                    "{place:?}: a direction of length {}",
                    direction.length()
                );
                let lens_point = f64::from(estimator.lens.diameter) / 2.0
                    * (f64::from(place.disk[0]) * u + f64::from(place.disk[1]) * v);
                let start = (origin - eye - lens_point).length() / diameter;
                worst_start = worst_start.max(start);
                ensure!(start < 1e-5, "{place:?} starts {start:.1e} D beside its lens point");

                let depth = |point: DVec3| -w.dot(point - eye);
                let met = origin + (focal_distance - depth(origin)) / -w.dot(direction) * direction;
                let position =
                    [0, 1].map(|axis| f64::from(place.pixel[axis]) + 0.5 + f64::from(place.offset[axis]));
                let pixel = (project(met, size, vfov) - DVec2::from(position)).length();
                worst_pixel = worst_pixel.max(pixel);
                ensure!(pixel < 5e-3, "{place:?} is projected back {pixel:.1e} px beside itself");

                let k = f64::from(size[1]) / 2.0 / (vfov.to_radians() / 2.0).tan();
                let [x, y] = [0, 1].map(|axis| (position[axis] - f64::from(size[axis]) / 2.0) / k);
                let centre_ray = x * u - y * v - w;
                let focus = (met - eye - focal_distance * centre_ray).length() / focal_distance;
                worst_focus = worst_focus.max(focus);
                ensure!(focus < 1e-4, "{place:?} passes {focus:.1e} F beside the point in focus");
                if place.pixel == [0, 0] {
                    let on_sphere = eye + focal_distance * centre_ray.normalize();
                    nearest_sphere = nearest_sphere.min((met - on_sphere).length() / focal_distance);
                }
                rays += 1;
            }
        }
        ensure!(nearest_sphere > 1e-3, "the corner is too near a focal sphere to tell: {nearest_sphere} F");
        Ok(format!(
            "{rays} rays start within {worst_start:.1e} D, meet within {worst_focus:.1e} F, and are projected back \
             within {worst_pixel:.1e} px; a focal sphere would be {nearest_sphere:.1e} F away at least"
        ))
    };
    prove(check, &["lens", "framing", "lens_point_mirrored"]);
}

/// Catches a field of view measured across the width or the diagonal, to the centres of the outer
/// pixels instead of their edges, or of twice or half the angle: the angles to the picture's edges
/// and corners are known.
#[test]
fn the_field_of_view_reaches_every_edge_and_corner() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (_, [u, v, w]) = slanted_frame();
        let (mut count, mut worst) = (0, 0.0_f64);
        for size in [[64, 48], [48, 64], [1920, 1080], [7, 7]] {
            for vfov in [10.0, 45.0, 90.0, 150.0] {
                let [width, height] = size;
                // Left, middle, right times top, middle, bottom: from a pixel to its edge.
                let ends = |extent: u32| {
                    [
                        (0, -0.5),
                        ((extent - 1) / 2, if extent.is_multiple_of(2) { 0.5 } else { 0.0 }),
                        (extent - 1, 0.5),
                    ]
                };
                let places: Vec<_> = (ends(height).into_iter())
                    .flat_map(|y| {
                        ends(width).map(|x| Place { pixel: [x.0, y.0], offset: [x.1, y.1], disk: [0.0; 2] })
                    })
                    .collect();
                let rays = primary_rays(gpu, &slanted(size, vfov, 1.0, 5.0), &places);
                let top = (vfov.to_radians() / 2.0).tan();
                let side = top * f64::from(width) / f64::from(height);
                for (i, (_, direction)) in rays.into_iter().enumerate() {
                    let slopes = DVec2::new(u.dot(direction), v.dot(direction)) / -w.dot(direction);
                    let expected = DVec2::new(side * [-1.0, 0.0, 1.0][i % 3], top * [1.0, 0.0, -1.0][i / 3]);
                    let error = (slopes.x.atan() - expected.x.atan())
                        .abs()
                        .max((slopes.y.atan() - expected.y.atan()).abs());
                    worst = worst.max(error);
                    count += 1;
                    ensure!(
                        error < 2e-6,
                        "{size:?}, {vfov} degrees, {:?}: {slopes}, not {expected}",
                        places[i]
                    );
                }
            }
        }
        Ok(format!("{count} edges, corners and centres within {worst:.1e} rad"))
    };
    prove(check, &["framing"]);
}

/// Catches a pinhole that is not one: with no lens every ray starts at the eye, and the focal distance
/// changes no bit of it.
#[test]
fn a_pinhole_has_one_ray_for_a_film_position() {
    let check = |gpu: &Gpu| -> Result<String> {
        let places = places([33, 21]);
        let rays = [0.37, 10.0, 1e6].map(|focal_distance| {
            let push = CameraPush::new(&slanted([33, 21], 65.0, 0.0, focal_distance));
            probe::<_, ProbedRay>(gpu, "camera", None, bytemuck::bytes_of(&push), &places)
        });
        let bits = rays.each_ref().map(|rays| {
            rays.iter()
                .map(|ray| [ray.origin, ray.direction].map(|v| v.map(f32::to_bits)))
                .collect::<Vec<_>>()
        });
        ensure!(bits[0] == bits[1] && bits[0] == bits[2], "the focal distance changes the pinhole's rays");
        let eye = slanted_frame().0.as_vec3().to_array();
        ensure!(rays[0].iter().all(|ray| ray.origin == eye), "a ray that starts beside the eye");
        Ok(format!("{} rays, the same bits at three focal distances", places.len()))
    };
    prove(check, &["focal_point_leaks_into_the_pinhole"]);
}

/// Catches a hole whose picture stands upright or is mirrored, a film at another distance than the field of
/// view and `metres_per_unit` say, and a hole of another size: a primary ray starts in the hole and comes
/// from the film point, which is seen from behind.
#[test]
fn rays_of_a_hole_come_from_the_film() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (eye, [u, v, w]) = slanted_frame();
        let (mut rays, mut worst) = (0, 0.0_f64);
        for (size, vfov, metres_per_unit, upright) in [
            ([33, 21], 65.0, 0.1, false),
            ([33, 21], 65.0, 0.1, true),
            ([20, 30], 40.0, 0.001, false),
            ([640, 360], 90.0, 2.0, true),
        ] {
            let mut estimator = slanted(size, vfov, 0.3, 17.0);
            let film_distance = 0.012 / (vfov.to_radians() / 2.0).tan() / metres_per_unit;
            let diameter = (0.02 * film_distance) as f32;
            estimator.model = CameraModel::Hole;
            estimator.camera.metres_per_unit = metres_per_unit;
            estimator.hole = Hole { diameter, upright };
            let places = places(size);
            for (place, (origin, direction)) in places.iter().zip(primary_rays(gpu, &estimator, &places)) {
                let hole_point =
                    f64::from(diameter) / 2.0 * (f64::from(place.disk[0]) * u + f64::from(place.disk[1]) * v);
                ensure!(
                    (origin - eye - hole_point).length() < 1e-5 * f64::from(diameter) + 1e-6,
                    "{place:?} starts beside its point of the hole"
                );
                let pixel = 2.0 * film_distance * (vfov.to_radians() / 2.0).tan() / f64::from(size[1]);
                let [right, down] = [0, 1].map(|axis| {
                    let at = f64::from(place.pixel[axis]) + 0.5 + f64::from(place.offset[axis]);
                    (at - f64::from(size[axis]) / 2.0) * pixel
                });
                let side = if upright { -1.0 } else { 1.0 };
                // From the eye, which carries the rounding of its own coordinates.
                let film_point = side * (right * u - down * v) + film_distance * w;
                let expected = (hole_point - film_point).normalize();
                let error = (direction - expected).length();
                worst = worst.max(error);
                ensure!(error < 1e-6, "{place:?} leaves along {direction}, not {expected}");
                rays += 1;
            }
        }
        Ok(format!("{rays} rays within {worst:.1e} rad"))
    };
    prove(check, &["framing", "lens_radius_times_1.05", "focal_distance_times_1.02", "lens_point_mirrored"]);
}

/// Catches f-numbers of a frame that is not 24 mm high, of a focal length that breathes with the focus,
/// and presets that leave the field of view or change it where they should not.
#[test]
fn lenses_have_the_f_numbers_and_fields_of_view_they_are_named_for() {
    let of = |name: &str| {
        let mut estimator = slanted([64, 48], 37.0, 0.3, 5.0);
        estimator.camera.metres_per_unit = 0.1;
        estimator.take_preset(Preset::named(name).expect("a preset"));
        estimator
    };
    // A 24 mm high frame behind a 50 mm lens is 26.99 degrees high.
    for (name, f_number) in [("50mm-f1.8", 1.8), ("50mm-f1.4", 1.4), ("50mm-f1.2", 1.2)] {
        let estimator = of(name);
        let vfov = estimator.camera.vfov_radians.to_degrees();
        assert!((vfov - 26.991).abs() < 1e-3, "{name}: {vfov} degrees");
        let millimetres = f64::from(estimator.lens.diameter) * 0.1 * 1000.0;
        assert!((millimetres - 50.0 / f_number).abs() < 1e-5, "{name}: {millimetres} mm wide");
        assert!((estimator.f_number() - f_number).abs() < 1e-6, "{name}: f/{}", estimator.f_number());
        assert!((estimator.lens.focal_distance - 5.0).abs() < 1e-9, "{name} moves the focal plane");
    }
    // An eye is about f/2.1 in the dark, and its own view is 2 atan(9 / 17) = 55.80 degrees high, whatever was on before.
    for (name, diameter, f_number) in [("eye-2mm", 0.02, 8.5), ("eye-8mm", 0.08, 2.125)] {
        for before in ["50mm-f1.2", "eye-2mm", "pinhole"] {
            let mut estimator = of(before);
            estimator.take_preset(Preset::named(name).expect("a preset"));
            assert!((f64::from(estimator.lens.diameter) - diameter).abs() < 1e-8, "{name}");
            let vfov = estimator.camera.vfov_radians.to_degrees();
            assert!((vfov - 55.795).abs() < 1e-3, "{name} after {before}: {vfov} degrees");
            assert!((estimator.f_number() - f_number).abs() < 1e-6, "{name}: f/{}", estimator.f_number());
        }
    }
    assert_eq!(of("pinhole").model, CameraModel::Pinhole);

    // The list shows which one is on, until anything of it changes. A photographer's lens replaces the eye's film.
    for preset in &PRESETS {
        let mut estimator = of("eye-8mm");
        estimator.take_preset(preset);
        let on = |estimator: &Estimator| {
            Preset::on(&estimator.camera, estimator.model, &estimator.lens).map(|preset| preset.name)
        };
        assert_eq!(on(&estimator), Some(preset.name));
        if preset.has_f_number() {
            assert_eq!(estimator.camera.sensor, Sensor::FULL_FRAME, "{}", preset.name);
        }
        estimator.model = CameraModel::ThinLens;
        estimator.lens.diameter *= 1.01;
        estimator.camera.vfov_radians *= 1.01;
        assert_eq!(on(&estimator), None, "{}", preset.name);
    }

    let mut estimator = slanted([64, 48], 37.0, 0.3, 5.0);
    estimator.camera.metres_per_unit = 0.1;
    estimator.set_f_number(2.0);
    // 12 mm / tan(18.5 degrees) = 35.864 mm, half of which in units of 0.1 m.
    assert!((f64::from(estimator.lens.diameter) - 0.179_32).abs() < 1e-5, "{}", estimator.lens.diameter);
    for bad in [0.0, -2.0, f64::NAN, f64::INFINITY] {
        list::setting("f-number").check(&Value::Double(bad), Called::Flag).expect_err("no f-number");
    }
}

/// Catches a depth of field that is off by the tolerance, or that ends where it should not: at its limits
/// the circle of confusion is the tolerance, and focused at the hyperfocal distance it has no far one.
#[test]
fn the_depth_of_field_ends_where_the_blur_reaches_the_tolerance() {
    let mut estimator = slanted([1280, 720], 37.0, 0.3, 5.0);
    let k = 360.0 / (18.5_f64.to_radians()).tan();
    for (diameter, focal_distance, tolerance) in [(0.3, 5.0, 2.0), (0.01, 12.0, 0.5), (2.0, 0.7, 30.0)] {
        (estimator.lens.diameter, estimator.lens.focal_distance) = (diameter, focal_distance);
        let (camera, lens) = (&estimator.camera, &estimator.lens);
        let [near, far] = camera.depth_of_field(lens, tolerance, 720);
        let blur = |depth: f64| {
            common::circle_of_confusion(f64::from(diameter), f64::from(focal_distance), depth, k)
        };
        for (depth, sign) in [(near, -1.0), (far, 1.0)] {
            assert!((blur(depth) - tolerance).abs() < 1e-6 * tolerance, "{depth}: {} px", blur(depth));
            let signed = camera.circle_of_confusion(lens, depth, 720);
            assert!((signed - sign * tolerance).abs() < 1e-6 * tolerance, "{depth}: {signed} px");
        }
    }
    let hyperfocal = estimator.camera.hyperfocal_distance(&estimator.lens, 1.0, 720);
    estimator.lens.focal_distance = (1.0001 * hyperfocal) as f32;
    let [near, far] = estimator.camera.depth_of_field(&estimator.lens, 1.0, 720);
    assert!(far.is_infinite() && (near / hyperfocal - 0.5).abs() < 1e-3, "{near} to {far}");
    estimator.lens.diameter = 0.0;
    assert_eq!(estimator.camera.depth_of_field(&estimator.lens, 1.0, 720), [0.0, f64::INFINITY]);
}

/// Catches a depth of field that depends on the size of the picture although its tolerance is a length on the film, and
/// one that does not follow a tolerance in pixels.
#[test]
fn the_depth_of_field_is_that_of_the_film_at_every_size() {
    let scene = thinlens::scene::load("version-4").expect("a built-in scene");
    let mut settings = Settings::of_scene(SceneRef::new(scene));
    settings.view.overlay = Some(Overlay::FocusPeaking);
    let mut seen = Vec::new();
    for size in [[1280, 720], [1920, 1061], [2560, 1581]] {
        settings.estimator.size = size;
        settings.view.tolerance = Tolerance::Film(0.03);
        // On film v behind the lens: 1 / near = 1 / F + c / (D v), and D v / c is the hyperfocal distance.
        let Estimator { camera, lens, .. } = &settings.estimator;
        let (diameter, focused) = (f64::from(lens.diameter), f64::from(lens.focal_distance));
        let hyperfocal = diameter * 12.0 / (camera.vfov_radians / 2.0).tan() / f64::from(0.03_f32);
        let limits = [1.0, -1.0].map(|side| (focused.recip() + side / hyperfocal).recip());
        let got = [settings.depth_of_field(), [settings.hyperfocal_distance(); 2]].concat();
        for (got, expected) in got.iter().zip([limits, [hyperfocal; 2]].concat()) {
            assert!((got / expected - 1.0).abs() < 1e-12, "{size:?}: {got}, not {expected}");
        }
        // Focus peaking marks what is sharp by the same measure.
        let share = settings.overlay_scale(Overlay::FocusPeaking) / size[1] as f32;
        assert!((share - 0.03 / 24.0).abs() < 1e-8, "{size:?}: {share} of the height");

        settings.view.tolerance = Tolerance::Pixels(1.0);
        assert_eq!(settings.overlay_scale(Overlay::FocusPeaking), 1.0);
        seen.push(settings.hyperfocal_distance());
    }
    assert!((seen[1] / seen[0] - 1061.0 / 720.0).abs() < 1e-12, "{seen:?}");
}

/// Catches a format of other sides, a focal length that is measured by the width or by the diagonal, one that does not come
/// back, and a tolerance that does not shrink with the sensor: the fields of view of a table.
#[test]
fn focal_lengths_have_the_fields_of_view_of_each_format() {
    // The vertical field of view in degrees of lenses of 14, 24, 50, 85 and 200 mm: 2 atan(h / 2f).
    let focal_lengths = [14.0, 24.0, 50.0, 85.0, 200.0];
    for (name, vfov, crop) in [
        ("full-frame", [81.203, 53.130, 26.991, 16.071, 6.867], 1.0),
        ("aps-c", [58.248, 36.008, 17.733, 10.486, 4.467], 1.5339),
        ("micro-four-thirds", [49.810, 30.308, 14.814, 8.746, 3.723], 1.9994),
        ("medium-format", [99.200, 68.855, 36.422, 21.906, 9.404], 0.7898),
        ("1-inch", [34.894, 20.778, 10.058, 5.927, 2.521], 2.7273),
        ("phone", [29.225, 17.295, 8.350, 4.918, 2.091], 3.5406),
        ("eye", [65.470, 41.112, 20.408, 12.088, 5.153], 1.4422),
        ("10x12", [46.397, 28.072, 13.686, 8.075, 3.437], 2.7699),
    ] {
        let mut estimator = slanted([64, 48], 37.0, 0.3, 5.0);
        estimator.camera.sensor = name.parse().expect("a sensor");
        for (mm, degrees) in focal_lengths.into_iter().zip(vfov) {
            let camera = &mut estimator.camera;
            camera.set_focal_length_mm(mm);
            assert!(
                (camera.vfov_degrees() - degrees).abs() < 6e-4,
                "{name}, {mm} mm: {}",
                camera.vfov_degrees()
            );
            assert!((camera.focal_length_mm() / mm - 1.0).abs() < 1e-12, "{name}, {mm} mm");
            assert!((camera.focal_length_35mm() / mm / crop - 1.0).abs() < 1e-4, "{name}, {mm} mm");
            // On full frame 0.03 mm, elsewhere the same share of the diagonal, at every number of rows.
            let pixels = camera.tolerance_pixels(Tolerance::Film(0.03), 720);
            let on_film = pixels * camera.sensor.height_mm / 720.0;
            assert!((on_film * crop / 0.03 - 1.0).abs() < 1e-4, "{name}: {on_film} mm");
        }
    }
    assert_eq!(FORMATS.len(), 7);
}

/// A 50 mm lens at f/1.8 on full frame, focused at this distance in metres.
fn fifty(focused: f64, breathes: bool) -> Settings {
    let toml = format!(
        "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\npreset = \"50mm-f1.8\"\nfocal_distance = {focused}\n\
         focus_breathing = {breathes}\n"
    );
    settings_of(&toml, [1280, 720], 1)
}

/// Catches a circle of confusion that is not the textbook's where the lens moves to focus, and one that differs from it by
/// more than is said where the film stays: f^2 |z - F| / (N z (F - f)), and the share f / F less.
#[test]
fn the_circle_of_confusion_of_a_breathing_lens_is_the_textbooks() {
    let (f, n) = (0.05, 1.8);
    println!("F in m, z in m: the textbook's circle of confusion in mm; with breathing; without");
    for focused in [0.5_f64, 1.0, 2.0, 10.0] {
        for depth in [0.6 * focused, 1.5 * focused, 4.0 * focused, 1e3] {
            let textbook = 1e3 * f * f * (depth - focused).abs() / (n * depth * (focused - f));
            let [with, without] = [true, false].map(|breathes| {
                let settings = fifty(focused, breathes);
                let Estimator { camera, lens, size, .. } = &settings.estimator;
                settings.mm_of_pixels(camera.circle_of_confusion(lens, depth, size[1]).abs())
            });
            println!("{focused:4}, {depth:6.1}: {textbook:.4} {with:.4} {without:.4}");
            assert!(
                (with / textbook - 1.0).abs() < 1e-3,
                "{focused} m, {depth} m: {with} mm, not {textbook}"
            );
            let less = 1.0 - without / textbook;
            assert!(
                (less - f / focused).abs() < 1e-6,
                "{focused} m, {depth} m: {less} less than {textbook} mm"
            );
        }
        // The textbook's depth of field and hyperfocal distance.
        let settings = fifty(focused, true);
        let tolerance = f64::from(0.03_f32) / 1e3;
        let hyperfocal = f * f / (n * tolerance) + f;
        assert!((settings.hyperfocal_distance() / hyperfocal - 1.0).abs() < 1e-6, "{hyperfocal} m");
        let near = focused * (hyperfocal - f) / (hyperfocal + focused - 2.0 * f);
        assert!((settings.depth_of_field()[0] / near - 1.0).abs() < 1e-6, "{focused} m: from {near} m");
    }
}

/// Catches a film that does not move with the focus on the device or in the oracle, or moves the wrong way: at half a metre a
/// 50 mm lens has the view of a 55.6 mm lens.
#[test]
fn a_breathing_lens_narrows_the_view_on_the_device() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut worst = 0.0_f64;
        for focused in [0.5, 1.0, 10.0] {
            let estimator = fifty(focused, true).estimator;
            // The middle of the picture's upper edge.
            let place = Place { pixel: [639, 0], offset: [0.5, -0.5], disk: [0.0; 2] };
            let (_, direction) = primary_rays(gpu, &estimator, &[place])[0];
            // 1 / v = 1 / f - 1 / F, in millimetres.
            let film_distance = 1.0 / (1.0 / 50.0 - 1e-3 / focused);
            let off = direction.y / -direction.z * film_distance / 12.0 - 1.0;
            worst = worst.max(off.abs());
            ensure!(off.abs() < 1e-5, "{focused} m: the edge is seen {off} too far from the middle");
        }
        Ok(format!("the edges of the view within {worst:.1e}"))
    };
    prove(check, &["field_of_view_by_the_width", "half_a_pixel_off", "picture_upside_down"]);
}
