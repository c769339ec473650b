//! Overlays: what they show of depth, blur and error.

mod common;

use anyhow::{Result, ensure};
use common::scenes::EVERYTHING;
use common::{Gpu, circle_of_confusion, pixels, plain_scene_of, prove, small};
use glam::DVec3;
use std::sync::Arc;
use thinlens::reference::{Reference, tone};
use thinlens::renderer::Renderer;
use thinlens::scene::{CameraModel, Hole, Overlay, SceneRef, Shape, Tolerance};
use thinlens::settings::{Estimator, Settings};

/// What each pixel's middle sees, as the oracle says: the depth, and the normal in the world's frame.
fn surfaces(settings: &Settings) -> Vec<(f64, DVec3)> {
    let estimator = &settings.estimator;
    let surface = |pixel| {
        let met = common::met(estimator, pixel, [0.0; 2]);
        met.map_or((f64::INFINITY, DVec3::ZERO), |(depth, hit)| (depth, hit.shading_normal))
    };
    pixels(estimator.size).map(surface).collect()
}

/// The scene [`EVERYTHING`], with normals at the corners of its triangles that are not their own.
fn everything_smooth() -> SceneRef {
    let mut scene = plain_scene_of(EVERYTHING);
    for of in Arc::make_mut(&mut scene.shapes) {
        if let Shape::Triangle(triangle) = &mut of.shape {
            let [a, b, c] = triangle.vertices;
            let [across, along] = [(b - a).cross(c - a), b - a].map(|vector| vector.normalize().as_vec3());
            triangle.normals = Some([0.0, 0.4, -0.7].map(|lean| (across + lean * along).normalize()));
        }
    }
    SceneRef::new(scene)
}

/// What the device shows: r, g, b of each pixel.
fn shown(renderer: &mut Renderer, settings: &Settings) -> Result<Vec<[u8; 3]>> {
    renderer.set(settings)?;
    renderer.render(|_| ())?;
    let bytes = renderer.read_picture()?;
    Ok(bytes.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect())
}

fn encoded(linear: [f64; 3]) -> [u8; 3] {
    linear.map(|value| (255.0 * tone::srgb(value)).round() as u8)
}

fn mix(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    [0, 1, 2].map(|channel| from[channel] + share * (to[channel] - from[channel]))
}

/// The depth in which a pixel is in focus: a tilt about the horizontal axis makes 1 / F - y / J of 1 / F, where y is the
/// slope of the centre ray, and J = f / sin(tilt) the depth of the hinge line below the lens.
fn depth_in_focus(estimator: &Estimator, [_, y]: [u32; 2]) -> f64 {
    let Estimator { camera, lens, .. } = estimator;
    let (focal_distance, (sine, cosine)) =
        (f64::from(lens.focal_distance), f64::from(lens.tilt_degrees).to_radians().sin_cos());
    let film_distance = estimator.focused_camera().film_distance();
    let f = cosine / (1.0 / film_distance + 1.0 / focal_distance);
    let rows = 0.5 * f64::from(estimator.size[1]) - f64::from(y) - 0.5;
    let rise = f64::from(camera.lens_shift_mm[1]) / camera.mm_per_unit();
    let slope =
        rows / estimator.focused_camera().view_distance_pixels(estimator.size[1]) + rise / film_distance;
    (1.0 / focal_distance - slope * sine / f).recip()
}

/// By how much the luminance of the picture on a screen changes from pixel to pixel: the gradient of the plane that fits
/// the pixels around this one, those beside it counting twice as much as those at its corners. The edge of the picture
/// is repeated.
fn contrast(settings: &Settings, film: &[[f32; 4]], [x, y]: [u32; 2]) -> f64 {
    let [width, height] = settings.estimator.size;
    let exposure = f64::from(settings.exposure());
    let shown = |[x, y]: [i64; 2], texel: [f32; 4]| {
        let inside = (0..i64::from(width)).contains(&x) && (0..i64::from(height)).contains(&y);
        let texel = if inside { film[(y * i64::from(width) + x) as usize] } else { texel };
        let [red, green, blue] = [0, 1, 2].map(|channel| tone::srgb(exposure * f64::from(texel[channel])));
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    let here = film[(y * width + x) as usize];
    let [mut across, mut down, mut weights] = [0.0; 3];
    for [i, j] in (-1..=1).flat_map(|j| (-1..=1).map(move |i| [i, j])) {
        let weight = if i == 0 || j == 0 { 2.0 } else { 1.0 };
        let value = shown([i64::from(x) + i, i64::from(y) + j], here);
        across += weight * i as f64 * value;
        down += weight * j as f64 * value;
        weights += weight * (i * i) as f64;
    }
    (across / weights).hypot(down / weights)
}

/// What an overlay should show of a pixel, by the definitions of the panel's help.
fn expected(
    settings: &Settings,
    overlay: Overlay,
    pixel: [u32; 2],
    film: &[[f32; 4]],
    (depth, normal): (f64, DVec3),
) -> [f64; 3] {
    let texel = film[(pixel[1] * settings.estimator.size[0] + pixel[0]) as usize];
    let estimator = &settings.estimator;
    let focal_distance = depth_in_focus(estimator, pixel);
    let k = estimator.focused_camera().view_distance_pixels(estimator.size[1]);
    let picture = [0, 1, 2].map(|channel| f64::from(settings.exposure()) * f64::from(texel[channel]));
    let blur = match estimator.model {
        CameraModel::ThinLens if depth.is_infinite() => {
            f64::from(estimator.lens.diameter) / focal_distance * k
        }
        CameraModel::ThinLens => {
            let lens = f64::from(estimator.lens.diameter);
            circle_of_confusion(lens, focal_distance, depth, k) * (depth - focal_distance).signum()
        }
        CameraModel::Pinhole => 0.0,
        // A far point's picture is as wide as the hole, a nearer one's wider, by similar triangles.
        CameraModel::Hole => {
            let film = estimator.camera.film_distance();
            -f64::from(estimator.hole.diameter) * (1.0 + film / depth) * k / film
        }
    };
    match overlay {
        Overlay::Depth if depth.is_infinite() => [0.0; 3],
        Overlay::Depth => {
            let focal_distance = f64::from(estimator.lens.focal_distance);
            [focal_distance / (focal_distance + depth); 3]
        }
        Overlay::Normals if depth.is_infinite() => [0.0; 3],
        Overlay::Normals => {
            let camera = &estimator.camera;
            let back = (camera.eye - camera.look_at).normalize();
            let right = camera.up.cross(back).normalize();
            [right, back.cross(right), back].map(|axis| 0.5 + 0.5 * axis.dot(normal))
        }
        Overlay::CircleOfConfusion => {
            let share = (blur.abs() / (f64::from(estimator.size[1]) / 30.0)).min(1.0);
            mix([1.0; 3], if blur < 0.0 { [0.02, 0.22, 1.0] } else { [1.0, 0.2, 0.01] }, share)
        }
        Overlay::FocusPeaking => {
            let is_edge = contrast(settings, film, pixel) >= 0.05;
            let share = if blur.abs() > 1.5 {
                0.0
            } else if is_edge {
                0.9
            } else {
                0.12
            };
            mix(picture, [0.05, 1.0, 0.1], share)
        }
        Overlay::FocalPlane => {
            let behind = depth / focal_distance - 1.0;
            let share = if behind.abs() <= 0.006 {
                0.75
            } else if behind > 0.0 {
                0.2
            } else {
                0.0
            };
            mix(picture, [1.0, 0.6, 0.0], share)
        }
        Overlay::Count | Overlay::Error => unreachable!("they know no depth"),
    }
}

/// Catches a distance along the ray for the depth, sides that are swapped, another pixel's depth, marks of another
/// thickness or on one side alone, edges in one direction alone, a sheet before what is in front of it, normals in the world's frame, of the side that is not seen, or of the triangle where
/// its corners have some, a hole that is taken for a lens, and surfaces that stay when camera or scene change: each
/// pixel against what the oracle sees.
#[test]
fn overlays_show_what_each_pixel_sees() {
    let mut hole = small("version-4");
    hole.estimator.model = CameraModel::Hole;
    hole.estimator.hole = Hole { diameter: 0.004, upright: false };
    let mut pinhole = small("suffern-boxes");
    pinhole.estimator.model = CameraModel::Pinhole;
    let mut nearer = small("version-4");
    nearer.estimator.lens.focal_distance = 6.0;
    nearer.view.exposure_stops = 0.5;
    let mut turned = small("version-4");
    turned.estimator.camera.look_at.x += 2.0;
    let mut smooth = Settings::of_scene(everything_smooth());
    (smooth.estimator.size, smooth.samples) = ([64, 48], 4);
    // The near focus of a lens that moves narrows the view.
    let mut breathing = nearer.clone();
    breathing.estimator.camera.focus_breathing = true;
    // The focal plane of a tilted lens is tilted, and a shift moves it over the picture.
    let mut movements = small("version-4");
    movements.estimator.lens.tilt_degrees = 11.0;
    movements.estimator.camera.lens_shift_mm = [3.0, -5.0];
    let mut settings = vec![small("version-4"), nearer, breathing, turned, hole, smooth, pinhole, movements];
    settings.iter_mut().for_each(|settings| settings.view.tolerance = Tolerance::Pixels(1.5));
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings[0]);
        let (mut count, mut all_differ, mut marked) = (0, 0, 0);
        for settings in &settings {
            let surfaces = surfaces(settings);
            for overlay in
                Overlay::NAMES.map(|(_, overlay)| overlay).into_iter().filter(|of| of.shows_surface())
            {
                let mut settings = settings.clone();
                let plain = shown(&mut renderer, &settings)?;
                let film = renderer.read_film()?;
                settings.show(Some(overlay));
                let mut differ = 0;
                let got = shown(&mut renderer, &settings)?;
                let at = |i: usize| [i as u32 % 64, i as u32 / 64];
                for (i, surface) in surfaces.iter().enumerate() {
                    let expected = encoded(expected(&settings, overlay, at(i), &film, *surface));
                    // Next to edges rounding decides what a ray meets, and at a mark's edge whether it is in.
                    let off = (0..3).map(|c| got[i][c].abs_diff(expected[c])).max().unwrap_or(0);
                    differ += u32::from(off > 2);
                    marked += u32::from(got[i] != plain[i]);
                    count += 1;
                }
                ensure!(differ <= 12, "{differ} pixels of {overlay:?} are not the oracle's");
                all_differ += differ;
            }
        }
        ensure!(marked > count / 3, "only {marked} of {count} pixels show anything");
        Ok(format!("{count} pixels, {all_differ} differ"))
    };
    prove(check, &["overlay"]);
}

/// Catches an error that is not the standard error of the mean as a share of it, as f64 has it from the same
/// samples; and a film whose samples are others because it is looked at.
#[test]
fn the_error_is_that_of_the_samples() {
    let mut settings = small("version-4");
    let plain = common::film(&Gpu::new(), &settings);
    settings.show(Some(Overlay::Error));
    let reference = Reference::new(&settings.estimator);
    let luminance = |color: DVec3| color.dot(DVec3::new(0.2126, 0.7152, 0.0722));
    let errors: Vec<f64> = pixels(settings.estimator.size)
        .map(|pixel| {
            let samples: Vec<f64> = (0..settings.samples)
                .map(|index| luminance(reference.sample(pixel, index).radiance))
                .collect();
            let count = samples.len() as f64;
            let mean = samples.iter().sum::<f64>() / count;
            let moment: f64 = samples.iter().map(|sample| (sample - mean).powi(2)).sum();
            (moment / (count * (count - 1.0))).sqrt() / mean.max(0.05)
        })
        .collect();
    let check = |gpu: &Gpu| -> Result<String> {
        let mut renderer = gpu.renderer(&settings);
        let got = shown(&mut renderer, &settings)?;
        let film = renderer.read_film()?;
        let off = film.iter().zip(&plain).filter(|(a, b)| (a[1] - b[1]).abs() > 1e-5).count();
        ensure!(off == 0, "{off} pixels are others");
        let mut differ = 0;
        for (got, error) in got.iter().zip(&errors) {
            let share = error / 0.1;
            let heat = [3.0 * share, 3.0 * share - 1.0, 3.0 * share - 2.0].map(|part| part.clamp(0.0, 1.0));
            let expected = encoded(heat);
            // The curve is steep near black.
            differ += u32::from((0..3).any(|c| got[c].abs_diff(expected[c]) > 3));
        }
        ensure!(differ < 30, "{differ} of {} pixels show another error", errors.len());
        Ok(format!("{} pixels, {differ} differ", errors.len()))
    };
    prove(check, &["error_without_its_scale", "error_of_a_sample", "moments_of_samples_forgotten"]);
}
