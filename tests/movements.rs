//! The movements of a view camera: shift, rise and tilt of the lens.

mod common;

use anyhow::{Result, ensure};
use common::scenes::EVERYTHING;
use common::{Gpu, film, pixels, prove, render, run, settings_of, slanted_frame};
use glam::DVec3;
use thinlens::reference::Reference;
use thinlens::renderer::Question;
use thinlens::scene::{CameraModel, Tolerance};
use thinlens::settings::{Estimator, Settings};
use thinlens::verify::verify;

/// A camera that looks from somewhere to somewhere, with a lens of 40 mm whose middle is 2 units wide.
fn tilted(degrees: f32, direction: f32, [shift, rise]: [f32; 2], breathes: bool) -> Settings {
    let toml = format!(
        "[camera]\neye = [3, 4, 12]\nlook_at = [-2, 1, -9]\nup = [0.2, 1, 0]\nfocal_length = 40\n\
         metres_per_unit = 0.02\nlens_diameter = 0.7\nfocal_distance = 17\nfocus_breathing = {breathes}\n\
         lens_tilt_degrees = {degrees}\ntilt_direction_degrees = {direction}\nlens_shift = {shift}\nlens_rise = {rise}\n"
    );
    let mut settings = settings_of(&toml, [60, 40], 1);
    settings.estimator.jitter = 0.0;
    settings
}

/// Catches a plane of sharp focus that is not tilted, or tilted as much as the lens is, or the other way, or about another
/// line; a lens that is not turned with its axis; and a focal length that is not that of the lens. By the hinge rule (H.
/// Merklinger, *Focusing the View Camera*): the plane goes through the point at the focal distance on the optical axis, and
/// through the line in the plane of the lens centre that lies J = f / sin(tilt) beside it. The rays of a pixel from all over
/// the lens meet where the ray through its centre meets this plane, so the circle of confusion there is 0.
#[test]
fn a_tilted_lens_is_sharp_in_the_plane_through_the_hinge_line() {
    let check = |gpu: &Gpu| -> Result<String> {
        let (eye, [u, v, w]) = slanted_frame();
        let (mut rays, mut worst, mut worst_oracle, mut off_plane) = (0, 0.0_f64, 0.0_f64, 0.0_f64);
        for (degrees, direction, shift, breathes) in [
            (8.0, 0.0, [0.0, 0.0], false),
            (8.0, 0.0, [0.0, 0.0], true),
            (-5.0, 0.0, [0.0, 4.0], false),
            (12.0, 90.0, [-3.0, 0.0], true),
            (25.0, 200.0, [2.0, 5.0], false),
        ] {
            let settings = tilted(degrees, direction, shift, breathes);
            let Estimator { lens, size, .. } = &settings.estimator;
            let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
            let focused = f64::from(lens.focal_distance);
            // Lengths of 1 mm are 0.05 units. Along the axis of the lens, 1 / f = 1 / v + 1 / F.
            let (f, film_distance) = if breathes {
                (2.0, (cosine / 2.0 - 1.0 / focused).recip())
            } else {
                (cosine / (1.0 / 2.0 + 1.0 / focused), 2.0)
            };
            let turn = f64::from(direction).to_radians();
            let below = turn.sin() * u - turn.cos() * v;
            let hinge = eye + f / sine * below;
            let normal = w.cross(below).cross(eye - focused * w - hinge).normalize();
            let axis = cosine * -w + sine * below;
            let k = f64::from(size[1]) * film_distance / (24.0 * 0.05);
            let mut renderer = gpu.renderer(&settings);
            let reference = Reference::new(&settings.estimator);
            for position in [[0.5, 0.5], [59.5, 0.5], [30.5, 20.5], [11.5, 33.5], [59.5, 39.5]] {
                let at = [(position[0] - 30.0) / 40.0, (20.0 - position[1]) / 40.0];
                let on_film = [0, 1].map(|i| at[i] * 24.0 * 0.05 + f64::from(shift[i]) * 0.05);
                let centre_ray = (on_film[0] * u + on_film[1] * v) / film_distance - w;
                let depth = normal.dot(hinge - eye) / normal.dot(centre_ray);
                let sharp = eye + depth * centre_ray;
                // How far a ray that starts on the lens passes beside the point, as pixels on the film.
                let beside = |origin: DVec3, direction: DVec3| {
                    (sharp - origin).cross(direction.normalize()).length() / depth.abs() * k
                };
                let question = Question { position: position.map(|at| at as f32), fan: 9, samples: 32 };
                let picked = renderer.pick(question)?.expect("an answer");
                let mut widest = 0.0_f64;
                for ray in &picked.rays {
                    let miss = beside(ray.origin, ray.direction);
                    worst = worst.max(miss);
                    ensure!(
                        miss < 0.02,
                        "{degrees} degrees, {position:?}: a ray passes {miss:.2} px beside the plane"
                    );
                    let way = ray.origin - eye;
                    let off = way.dot(axis).abs() / f64::from(lens.diameter);
                    off_plane = off_plane.max(off);
                    ensure!(off < 1e-5, "{degrees} degrees: a ray starts {off:.1e} D before the lens");
                    widest = widest.max(way.length());
                    rays += 1;
                }
                let rim = 2.0 * widest / f64::from(lens.diameter);
                ensure!((rim - 1.0).abs() < 1e-5, "{degrees} degrees: the lens is {rim} times as wide");
                for disk in [[1.0, 0.0], [0.0, -1.0], [-0.6, 0.8]] {
                    let ray = reference.primary_ray(position.map(|at| at as u32), [0.0; 2], disk, 0.0);
                    worst_oracle = worst_oracle.max(beside(ray.origin, ray.direction));
                    ensure!(
                        worst_oracle < 1e-9,
                        "{degrees} degrees: the oracle is sharp {worst_oracle} px beside the plane"
                    );
                }
            }
        }
        Ok(format!(
            "{rays} rays pass {worst:.1e} px beside the plane at most, and start within {off_plane:.1e} D of the lens; \
             the oracle's pass {worst_oracle:.1e} px beside"
        ))
    };
    prove(check, &["movements"]);
}

/// Catches a shift by another length, to the other side, or upside down, one that depends on the focus, and one that changes
/// the perspective: the picture is the same, moved by the pixels that are as long on the film as the shift.
#[test]
fn a_shift_moves_the_picture_by_its_length_on_the_film() {
    let gpu = Gpu::new();
    let size = [64, 48];
    // The film is 24 mm and 48 pixels high.
    let [right, up] = [7_i32, -5_i32];
    for (model, upright, breathes) in [
        (CameraModel::ThinLens, true, false),
        (CameraModel::ThinLens, true, true),
        (CameraModel::Pinhole, true, false),
        (CameraModel::Hole, true, false),
        (CameraModel::Hole, false, false),
    ] {
        let mut settings = settings_of(EVERYTHING, size, 1);
        let Estimator { camera, lens, hole, jitter, .. } = &mut settings.estimator;
        (lens.diameter, hole.diameter, *jitter, hole.upright) = (0.0, 0.0, 0.0, upright);
        camera.metres_per_unit = 0.1;
        camera.focus_breathing = breathes;
        settings.estimator.model = model;
        let plain = film(&gpu, &settings);
        settings.estimator.camera.lens_shift_mm = [right, up].map(|pixels| 0.5 * pixels as f32);
        let shifted = film(&gpu, &settings);
        // What a hole shows upside down moves to the other side.
        let side = if upright { 1 } else { -1 };
        let (mut same, mut count) = (0, 0);
        for [x, y] in pixels(size) {
            let (from_x, from_y) = (x.cast_signed() + side * right, y.cast_signed() - side * up);
            if (0..size[0].cast_signed()).contains(&from_x) && (0..size[1].cast_signed()).contains(&from_y) {
                let at = |x: i32, y: i32| (y * size[0].cast_signed() + x) as usize;
                let (now, before) =
                    (shifted[at(x.cast_signed(), y.cast_signed())], plain[at(from_x, from_y)]);
                same += u32::from((0..3).all(|channel| (now[channel] - before[channel]).abs() < 2e-3));
                count += 1;
            }
        }
        // At edges rounding decides what a ray meets.
        assert!(count > 2400 && count - same <= 6, "{model:?}, {upright}, {breathes}: {same} of {count}");
    }
}

/// Catches movements that the device has and the oracle has not, or the other way round, in whole pictures: with an aperture
/// whose shape depends on the axis of the lens, with focus breathing, and without a lens.
#[test]
fn pictures_with_movements_are_those_of_the_oracle() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings_of(EVERYTHING, [64, 48], 8));
        let (mut samples, mut mismatches) = (0, 0);
        for (degrees, direction, shift, breathes, cats_eye, model) in [
            (9.0, 0.0, [0.0, 0.0], false, 0.0, CameraModel::ThinLens),
            (6.0, 120.0, [3.0, 5.0], true, 0.0, CameraModel::ThinLens),
            (-14.0, 30.0, [0.0, -6.0], false, 0.7, CameraModel::ThinLens),
            (0.0, 0.0, [6.0, 0.0], true, 0.7, CameraModel::ThinLens),
            (9.0, 0.0, [3.0, 5.0], false, 0.0, CameraModel::Hole),
            (9.0, 0.0, [3.0, 5.0], true, 0.0, CameraModel::Pinhole),
        ] {
            let mut settings = settings_of(EVERYTHING, [64, 48], 8);
            let estimator = &mut settings.estimator;
            (estimator.lens.tilt_degrees, estimator.lens.tilt_direction_degrees) = (degrees, direction);
            (estimator.camera.lens_shift_mm, estimator.camera.focus_breathing) = (shift, breathes);
            (estimator.camera.metres_per_unit, estimator.aperture.cats_eye) = (0.03, cats_eye);
            (estimator.model, estimator.hole.diameter) = (model, 0.1);
            let agreement = verify(&mut renderer, &settings)?;
            samples += agreement.samples;
            mismatches += agreement.mismatches;
        }
        Ok(format!("{samples} samples, {mismatches} differ"))
    };
    prove(check, &["movements", "cats_eye_around_the_middle_of_a_shifted_picture"]);
}

/// Catches a tilt that changes what has no lens.
#[test]
fn a_pinhole_and_a_hole_have_no_lens_to_tilt() {
    let gpu = Gpu::new();
    let mut settings = settings_of(EVERYTHING, [64, 48], 2);
    settings.estimator.hole.diameter = 0.1;
    let mut renderer = gpu.renderer(&settings);
    for model in [CameraModel::Pinhole, CameraModel::Hole] {
        settings.estimator.model = model;
        let films = [0.0, 20.0].map(|degrees| {
            settings.estimator.lens.tilt_degrees = degrees;
            common::bits(&render(&mut renderer, &settings).expect("a film"))
        });
        assert!(films[0] == films[1], "{model:?}");
    }
}

/// Catches a place that is focused on by its depth though the lens is tilted: the rays of the place meet on what it shows,
/// and its circle of confusion is 0.
#[test]
fn a_tilted_lens_is_focused_on_a_place() {
    let gpu = Gpu::new();
    let mut by_depth = 0.0_f64;
    for breathes in [false, true] {
        let mut settings = settings_of(EVERYTHING, [64, 48], 1);
        let estimator = &mut settings.estimator;
        (estimator.lens.tilt_degrees, estimator.lens.tilt_direction_degrees) = (7.0, 20.0);
        (estimator.camera.lens_shift_mm, estimator.camera.focus_breathing) = ([2.0, -3.0], breathes);
        (estimator.camera.metres_per_unit, estimator.jitter) = (0.05, 0.0);
        let mut renderer = gpu.renderer(&settings);
        for pixel in [[10_u32, 40_u32], [50, 44], [31, 30], [45, 20]] {
            let position = pixel.map(|at| at as f32 + 0.5);
            let picked = renderer.pick(Question::at(position)).expect("it picks").expect("an answer");
            let surface = picked.surface.expect("something is there");
            let mut focused = settings.clone();
            let lens = &mut focused.estimator.lens;
            lens.focal_distance = surface.focal_distance.expect("it can be focused on") as f32;
            let Estimator { camera, lens, size, .. } = &focused.estimator;
            let blur = camera.circle_of_confusion_at(lens, surface.point, size[1]);
            assert!(blur.abs() < 1e-3, "{pixel:?}: {blur} px");
            // The pixel that shows the point may be another one, because a lens that moves changes the view.
            let [u, v, w] = [camera.frame().u(), camera.frame().v(), camera.frame().w()];
            let way = surface.point - camera.eye;
            let k = view_distance(&focused.estimator);
            let q = [way.dot(u), way.dot(v)].map(|part| part / -way.dot(w) * k);
            let shift = camera.lens_shift_mm.map(|mm| f64::from(mm) * 48.0 / 24.0);
            let at = [32.0 + q[0] - shift[0], 24.0 - q[1] + shift[1]];
            let offset = [at[0] - 0.5 - f64::from(pixel[0]), at[1] - 0.5 - f64::from(pixel[1])];
            let reference = Reference::new(&focused.estimator);
            for disk in [[1.0, 0.0], [0.0, 1.0], [-0.6, -0.8]] {
                let ray = reference.primary_ray(pixel, offset, disk, 0.0);
                let beside = (surface.point - ray.origin).cross(ray.direction).length() / surface.depth * k;
                assert!(beside < 2e-3, "{pixel:?}: a ray passes {beside} px beside");
            }
            focused.estimator.lens.focal_distance = surface.depth as f32;
            let Estimator { camera, lens, .. } = &focused.estimator;
            by_depth = by_depth.max(camera.circle_of_confusion_at(lens, surface.point, 48).abs());
        }
    }
    assert!(by_depth > 1.0, "focused by the depth, all places would be blurred over {by_depth} px at most");
}

/// `k` of the camera in focus.
fn view_distance(estimator: &Estimator) -> f64 {
    estimator.focused_camera().view_distance_pixels(estimator.size[1])
}

/// Catches a circle of confusion that is not that of the rays: light from a point through the rim of a tilted lens, traced to
/// the film with the thin lens equation, is as far apart there as is said, across the direction of the tilt.
#[test]
fn the_circle_of_a_tilted_lens_is_as_wide_as_is_said() {
    for breathes in [false, true] {
        let settings = tilted(15.0, 0.0, [0.0, 0.0], breathes);
        let Estimator { camera, lens, size, .. } = &settings.estimator;
        let (eye, [u, v, w]) = slanted_frame();
        let reference = Reference::new(&settings.estimator);
        let k = view_distance(&settings.estimator);
        for (right, up, depth) in [(0.0, 0.0, 9.0), (0.0, 0.15, 30.0), (0.0, -0.2, 12.0)] {
            let point = eye + depth * (right * u + up * v - w);
            // The film point whose ray from the right end of the lens goes through the point: the ray is linear in it.
            let of = |x: f64| {
                let pixel = [30, 20];
                let offset = [x - 0.5, 20.0 - up * k - 20.5];
                reference.primary_ray(pixel, offset, [1.0, 0.0], 0.0)
            };
            let miss = |x: f64| {
                let ray = of(x);
                let t = (depth + w.dot(ray.origin - eye)) / -w.dot(ray.direction);
                u.dot(ray.origin + t * ray.direction - point)
            };
            let (a, b) = (miss(0.0), miss(1.0));
            let half = a / (a - b);
            let said = camera.circle_of_confusion_at(lens, point, size[1]);
            assert!((2.0 * half / said - 1.0).abs() < 2e-3, "{up}, {depth}: {} px, not {said}", 2.0 * half);
        }
        // With the optical axis for the middle, the depth of field ends where the circle is as wide as the tolerance.
        let mut settings = settings.clone();
        settings.view.tolerance = Tolerance::Pixels(0.5);
        let Estimator { camera, lens, size, .. } = &settings.estimator;
        for limit in settings.depth_of_field() {
            let blur = camera.circle_of_confusion(lens, limit, size[1]).abs();
            assert!((blur - 0.5).abs() < 1e-9, "{blur} px at {limit}");
        }
    }
}

/// Catches messages that do not say what is wrong with a movement.
#[test]
fn what_cannot_be_moved_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let render = ["render", "-s", "64x48", "-n", "1", "-o", "a.png", "--quiet"];
    for (arguments, message) in [
        (&["--lens-tilt", "46"][..], "--lens-tilt is 46, but must be from -45 to 45"),
        (&["--lens-rise=-2000"], "--lens-rise is -2000, but must be from -1000 to 1000"),
        (
            &["--lens-tilt", "44", "--metres-per-unit", "10", "--autofocus=5,46"],
            "no focal distance makes the picture of this tilted lens sharp at 5,46",
        ),
    ] {
        let outcome = run(folder.path(), &[&render[..], arguments].concat());
        assert!(outcome.code == 2 && outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
        assert!(!folder.path().join("a.png").exists(), "{arguments:?} leaves a picture");
    }
    let outcome = run(folder.path(), &[&render[..], &["--lens-shift", "-5mm", "--lens-tilt", "-3"]].concat());
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
}
