//! Adaptive sampling at night: what few rays meet keeps its light, and nothing is brighter than it is reckoned with.

mod common;

use anyhow::{Result, ensure};
use common::scenes::{EVERYTHING, Night, ROOM, a_lamp_at_night};
use common::{Gpu, pixels, plain_scene_of, prove, render, settings_of, small};
use glam::Vec3;
use thinlens::gpu_types::Brightest;
use thinlens::reference::Reference;
use thinlens::renderer::Renderer;
use thinlens::scene::{Aperture, CameraModel, Material, SceneRef};
use thinlens::settings::{Estimator, Settings};

const SIZE: [u32; 2] = [40, 40];
/// How wide lamps blur, in pixels.
const ACROSS: f64 = 16.0;

fn luminance(color: [f64; 3]) -> f64 {
    0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]
}

/// Scenes in which such a share of the rays of many pixels meets something bright, and adds some 0.3 to them.
fn nights(share: f64) -> [(&'static str, String); 5] {
    let night = Night::new(SIZE[1], ACROSS);
    let (sky, z) = (night.toml(), night.depth);
    let lamp = |radiance: f64| format!("[emissive.lamp]\nradiance = {radiance}\n");
    let sphere = |z: f64| {
        let radius = 0.5 * night.cone() * share.sqrt();
        format!("[[sphere]]\ncenter = [0, 0, {z}]\nradius = {radius}\nmaterial = \"lamp\"\n")
    };
    let aabb = |lower: [f64; 3], upper: [f64; 3], material: &str| {
        format!("[[box]]\nlower = {lower:?}\nupper = {upper:?}\nmaterial = \"{material}\"\n")
    };
    let bright = 0.3 / share;
    let line = 0.5 * share * night.cone();
    let gap = share * night.lens;
    // It stands behind the camera, and its mirror image as far away as the other lamps.
    let mirror = "[mirror.dim]\ncolor = [1, 1, 1]\nkr = 0.1\n[[plane]]\npoint = [0, 0, -45]\nnormal = [0, 0, 1]\nmaterial = \"dim\"\n";
    [
        ("a lamp", a_lamp_at_night(SIZE[1], ACROSS, share, bright)),
        ("a lamp in a dim mirror", sky.clone() + &lamp(10.0 * bright) + mirror + &sphere(z - 90.0)),
        (
            "a lamp that passes",
            format!("{sky}{}{}velocity = [1800, 600, 0]\n", lamp(2.0 * bright), sphere(-z)),
        ),
        (
            "a thin line",
            sky.clone() + &lamp(bright) + &aabb([-200.0, -line, -z - 0.1], [200.0, line, -z], "lamp"),
        ),
        (
            "a bright wall behind a gap before the lens",
            sky + &lamp(bright)
                + "[matte.black]\ncolor = [0, 0, 0]\nka = 0\nkd = 0\n"
                + &aabb([-90.0, -90.0, -5.1], [0.0, 90.0, -5.0], "black")
                + &aabb([gap, -90.0, -5.1], [90.0, 90.0, -5.0], "black")
                + &aabb([-900.0, -900.0, -120.0], [900.0, 900.0, -z], "lamp"),
        ),
    ]
}

/// The light of a few pictures, above the night's. Of a picture that stops nowhere where the threshold is zero.
fn light(renderer: &mut Renderer, settings: &Settings, threshold: f32) -> Result<f64> {
    let mut settings = settings.clone();
    settings.estimator.noise_threshold = threshold;
    let mut sum = 0.0;
    for seed in 0..4 {
        settings.estimator.seed = seed;
        for [r, g, b, _] in render(renderer, &settings)? {
            sum += luminance([r, g, b].map(f64::from)) - 0.02;
        }
    }
    Ok(sum)
}

/// Catches pixels that stop for good because none of their samples met a lamp: the light of its disc would be
/// missing. And pixels that stop because some met it early, which are too bright.
#[test]
fn what_few_rays_meet_keeps_its_light() {
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for one_in in [50, 1000] {
            for (name, toml) in nights(f64::from(one_in).recip()) {
                let settings = settings_of(&toml, SIZE, 1024);
                let mut renderer = gpu.renderer(&settings);
                let all = light(&mut renderer, &settings, 0.0)?;
                for threshold in [0.05, 1.0] {
                    let kept = light(&mut renderer, &settings, threshold)? / all;
                    let percent = 100.0 * kept;
                    figures.push(format!("{name}, 1 in {one_in}, threshold {threshold}: {percent:.2}%"));
                    ensure!((kept - 1.0).abs() < 0.01, "{}", figures.join("\n"));
                }
            }
        }
        Ok(figures.join("\n"))
    };
    prove(check, &["loses_what_it_has_not_met", "any_threshold"]);
}

/// The largest ratio of a sample of the oracle to the brightness that the renderer expects at most, in the pixels that
/// samples start from and in those that they land in.
fn excess(estimator: &Estimator) -> f64 {
    let (reference, brightest) = (Reference::new(estimator), Brightest::new(estimator));
    let mut most = 0.0_f64;
    for pixel in pixels(estimator.size) {
        for index in 0..16 {
            let sample = reference.sample(pixel, index);
            let step = sample.offset.map(|offset| (0.5 + offset).floor() as i64);
            let landed = [0, 1].map(|axis| u32::try_from(i64::from(pixel[axis]) + step[axis]));
            let landed = match landed {
                [Ok(x), Ok(y)] if x < estimator.size[0] && y < estimator.size[1] => [x, y],
                _ => pixel,
            };
            let least = brightest.at(pixel).min(brightest.at(landed));
            most = most.max(luminance(sample.radiance.to_array()) / f64::from(least));
        }
    }
    most
}

/// Catches a shape that is looked for beside its picture, or in a part of it: through some lens points, at some
/// times, on the other side of a hole. And a light, a highlight or a mirror image that is left out.
#[test]
fn nothing_is_brighter_than_it_is_reckoned_with() {
    let mut scenes = vec![("version-4", small("version-4")), ("passing", small("passing"))];
    scenes.extend([EVERYTHING, ROOM].map(|toml| ("a scene", settings_of(toml, [64, 48], 16))));
    scenes.extend(nights(0.05).map(|(name, toml)| (name, settings_of(&toml, [64, 48], 16))));
    for (name, settings) in scenes {
        let whole = settings.estimator;
        // In a picture of more than 16384 pixels a cell has several pixels.
        let large = Estimator { size: [191, 131], ..whole.clone() };
        let hole = |upright| {
            let mut of = Estimator { model: CameraModel::Hole, ..whole.clone() };
            (of.hole.upright, of.hole.diameter) = (upright, 0.5 * whole.lens.diameter);
            of
        };
        let mut wide = Estimator { jitter: 4.0, ..whole.clone() };
        wide.lens.diameter *= 4.0;
        let mut bubbles = wide.clone();
        (bubbles.aperture.cats_eye, bubbles.aperture.profile) = (0.7, -1.0);
        // Tilts in three directions, of a lens that is not small against its distance from the film, and a shift.
        let tilted = |degrees: f32, direction: f32, shift: [f32; 2]| {
            let mut of = whole.clone();
            (of.lens.tilt_degrees, of.lens.tilt_direction_degrees) = (degrees, direction);
            (of.camera.lens_shift_mm, of.camera.focus_breathing) = (shift, direction > 0.0);
            of.camera.focus_breathing &= of.camera.can_focus(&of.lens).is_ok();
            of
        };
        let mut colors = tilted(10.0, 0.0, [2.0, 0.0]);
        colors.lens.abbe_number = 5;
        let oval = Aperture { anamorphic: 2.0, blades: 3, ..Aperture::default() };
        let bladed = Estimator { aperture: oval, ..whole.clone() };
        let pinhole = Estimator { model: CameraModel::Pinhole, ..whole.clone() };
        let movements = [(20.0, 0.0, [0.0; 2]), (-30.0, 0.0, [0.0, 7.0]), (12.0, 120.0, [-4.0, 3.0])]
            .map(|of| tilted(of.0, of.1, of.2));
        let others = [whole.clone(), large, hole(true), hole(false), wide, bladed, pinhole, bubbles, colors];
        for estimator in others.into_iter().chain(movements) {
            let most = excess(&estimator);
            // Each mirror can add something of its own.
            let mirrors =
                estimator.scene.materials.iter().any(|material| material.reflectance() != Vec3::ZERO);
            let allowed = if mirrors { f64::from(1 + estimator.max_bounces) } else { 1.0 };
            assert!(most <= 1.0001 * allowed, "{name}: {most} times as bright, {estimator:?}");
        }
    }
}

/// Catches a bound so wide that pixels are traced in which there is nothing to be met.
#[test]
fn lamps_are_looked_for_where_they_are() {
    let brightest = |toml: &str| Brightest::new(&settings_of(toml, SIZE, 1).estimator);
    let covered = |toml: &str| {
        let grid = brightest(toml);
        assert_eq!(grid.cell, 1);
        grid.luminances.iter().filter(|bright| **bright > 0.021).count()
    };
    let scenes = nights(1e-4);
    let [(_, lamp), (_, in_mirror), (_, passing), (_, line), _] = &scenes;
    let area = |width: f64, height: f64| (width * height) as usize;
    assert!((area(16.0, 16.0)..=area(18.0, 18.0)).contains(&covered(lamp)), "{}", covered(lamp));
    assert!((area(40.0, 16.0)..=area(40.0, 18.0)).contains(&covered(line)), "{}", covered(line));
    // Three units deep is 0.55 pixels a unit.
    assert!((area(32.0, 21.0)..=area(35.0, 24.0)).contains(&covered(passing)), "{}", covered(passing));
    // It may be anywhere in the mirror, which is everywhere. Without the mirror, it is behind the camera.
    assert_eq!(covered(in_mirror), 1600);
    let mut dull = plain_scene_of(in_mirror);
    for material in &mut dull.materials {
        if let Material::Mirror(mirror) = material {
            mirror.reflectance = Vec3::ZERO;
        }
    }
    let mut settings = settings_of(in_mirror, SIZE, 1);
    settings.estimator.scene = SceneRef::new(dull);
    assert!(Brightest::new(&settings.estimator).luminances.iter().all(|bright| *bright <= 0.021));
    // A floor is below the horizon.
    let floor = "[camera]\neye = [0, 1, 0]\nlook_at = [0, 1, -1]\nvfov_degrees = 40\nlens_diameter = 0\n\
                 focal_distance = 1\n[emissive.floor]\nradiance = 9\n\
                 [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n";
    let rows = covered(floor) / 40;
    assert!((20..=21).contains(&rows), "{rows} rows");
}
