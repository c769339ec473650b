//! The sky as an image: it lies where its image says, and its light is sampled as it is.

mod common;

use anyhow::{Result, ensure};
use common::{Gpu, film, prove, render, settings_of};
use glam::DVec3;
use image::{ImageBuffer, Rgb, Rgba};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use thinlens::scene::{self, Integrator};
use thinlens::settings::{Sampler, Settings};
use thinlens::verify::verify;

/// A folder with an image of these linear colours.
fn exr([width, height]: [u32; 2], color: impl Fn(u32, u32) -> [f32; 3]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("sky.exr");
    let image = ImageBuffer::from_fn(width, height, |x, y| Rgb(color(x, y)));
    image.save(&path).expect("a writable temporary folder");
    (folder, path)
}

/// A scene of these tables in a sky with the image of this file.
fn under(sky: &Path, keys: &str, tables: &str) -> String {
    format!(
        "integrator = \"path\"\nmax_bounces = 6\n[background]\nimage = {:?}\n{keys}\n{tables}",
        sky.to_str().expect("a plain path")
    )
}

/// Things of every way to scatter light, and a lamp if there is to be one.
fn still_life(lamp: bool) -> String {
    let things = "[camera]\neye = [0.2, 1.2, 3]\nlook_at = [0, 0.4, 0]\nvfov_degrees = 50\nlens_diameter = 0.1\n\
         focal_distance = 3\n[matte.floor]\ncolor = [0.7, 0.6, 0.5]\n[metal.steel]\ncolor = [0.9, 0.8, 0.7]\nroughness = 0.4\n\
         [mirror.silver]\ncolor = [0.9, 0.9, 0.9]\nkr = 1\n[glass.clear]\n[emissive.lamp]\nradiance = 4\n\
         [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n\
         [[sphere]]\ncenter = [-0.9, 0.4, 0]\nradius = 0.4\nmaterial = \"steel\"\n\
         [[sphere]]\ncenter = [0, 0.4, -0.4]\nradius = 0.4\nmaterial = \"silver\"\n\
         [[sphere]]\ncenter = [0.9, 0.4, 0.1]\nradius = 0.4\nmaterial = \"clear\"\n";
    let of_lamp = "[[sphere]]\ncenter = [0.3, 1.4, 0.6]\nradius = 0.1\nmaterial = \"lamp\"\n";
    format!("{things}{}", if lamp { of_lamp } else { "" })
}

/// Catches a direction, a density or a colour of the sky that is not that of the oracle, alone and beside a lamp.
#[test]
fn the_light_of_an_image_follows_the_oracle() {
    // A sun, a bright band, and colours that tell the directions apart.
    let color = |x: u32, y: u32| match (x, y) {
        (40..42, 9) => [90.0, 80.0, 60.0],
        (_, 14) => [1.5, 0.2, 0.1],
        _ => [x as f32 / 64.0, y as f32 / 32.0, 0.3],
    };
    let (_folder, sky) = exr([64, 31], color);
    let check = |gpu: &Gpu| -> Result<String> {
        let mut figures = Vec::new();
        for ((_, sampler), lamp) in Sampler::NAMES.into_iter().zip([true, false, true]) {
            let scene = under(&sky, "radiance = 0.8\nturn_degrees = 50", &still_life(lamp));
            let mut settings = settings_of(&scene, [48, 36], 6);
            settings.estimator.sampler = sampler;
            let agreement = verify(&mut gpu.renderer(&settings), &settings)?;
            let differ = 100.0 * agreement.mismatch_share();
            ensure!(differ < 0.2, "{differ:.3}% of the samples differ");
            figures.push(format!("{differ:.3}% differ"));
        }
        Ok(figures.join(", "))
    };
    prove(check, &["sky"]);
}

/// Catches an image that is turned or mirrored, or read with other colours than its file has: what a camera sees in each
/// direction is the texel that lies there.
#[test]
fn each_texel_lies_in_its_direction() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let sky = folder.path().join("sky.png");
    let level = |x: u32, y: u32| [(20 + 30 * x) as u8, (40 + 60 * y) as u8, 128];
    let linear = |level: u8| {
        let encoded = f64::from(level) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    };
    let gpu = Gpu::new();
    // The last of an odd number of texels is alone in its place on the device.
    for ([width, height], turn) in [([8, 4], 0), ([8, 4], 90), ([8, 4], -45), ([3, 3], 0)] {
        let image = ImageBuffer::from_fn(width, height, |x, y| Rgb(level(x, y)));
        image.save(&sky).expect("a writable temporary folder");
        let camera = "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 0.01\nlens_diameter = 0\nfocal_distance = 1\n";
        let mut settings = settings_of(&under(&sky, &format!("turn_degrees = {turn}"), camera), [1, 1], 1);
        settings.estimator.jitter = 0.0;
        let mut renderer = gpu.renderer(&settings);
        for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
            // The middle of the texel, where nothing is blended in. The columns go clockwise from straight behind.
            let right =
                (f64::from(x) + 0.5) / f64::from(width) * 2.0 * PI - PI - f64::from(turn).to_radians();
            let down = (f64::from(y) + 0.5) / f64::from(height) * PI;
            settings.estimator.camera.look_at =
                DVec3::new(down.sin() * right.sin(), down.cos(), -down.sin() * right.cos());
            let seen = render(&mut renderer, &settings).expect("a film");
            for (channel, level) in level(x, y).into_iter().enumerate() {
                let off = f64::from(seen[0][channel]) / linear(level) - 1.0;
                assert!(off.abs() < 2e-3, "turned by {turn}, column {x}, row {y}: {:?}", seen[0]);
            }
        }
    }
}

/// Catches a sun that is too bright or too dark, and one that is found by chance alone: the irradiance of a small sun is its
/// radiance times its solid angle times the cosine, and with samples that go to the sun the picture has little noise.
#[test]
fn a_small_sun_lights_a_floor_as_its_closed_form_says() {
    let [width, height] = [512_u32, 256];
    let (_folder, sky) =
        exr([width, height], |x, y| if (x, y) == (300, 60) { [1000.0; 3] } else { [0.0; 3] });
    let camera = "[camera]\neye = [0, 1, 1]\nlook_at = [0, 0, 0]\nvfov_degrees = 20\nlens_diameter = 0\nfocal_distance = 1\n\
                  [matte.floor]\ncolor = [0.5, 0.5, 0.5]\n[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n\
                  material = \"floor\"\n";
    let check = |gpu: &Gpu| -> Result<String> {
        let film = film(gpu, &settings_of(&under(&sky, "", camera), [16, 16], 256));
        let values: Vec<f64> = film.iter().map(|texel| f64::from(texel[0])).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let noise = (values.iter().map(|value| (value / mean - 1.0).powi(2)).sum::<f64>()
            / values.len() as f64)
            .sqrt();
        // Linear between the centres of texels, a texel has the light of its own area on the square of angles.
        let (from_zenith, step) = (PI * 60.5 / f64::from(height), PI / f64::from(height));
        let solid_angle = step * step * from_zenith.sin();
        let expected = 0.5 / PI * 1000.0 * solid_angle * from_zenith.cos();
        ensure!((mean / expected - 1.0).abs() < 3e-3, "{mean}, not {expected}");
        ensure!(noise < 0.1, "{noise} of noise");
        Ok(format!("{mean:.5} for {expected:.5}, {noise:.3} of noise"))
    };
    prove(check, &["sky_sampled_evenly", "sky_chance_of_rows_forgotten"]);
}

/// Catches a file that is not said to be what it is, a panic, and an image that an integrator does not show.
#[test]
fn what_cannot_be_a_sky_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let camera = "[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = 0\nfocal_distance = 1\n";
    let load = |name: &str, keys: &str| {
        let file = folder.path().join("sky.toml");
        std::fs::write(&file, format!("{camera}[background]\nimage = \"{name}\"\n{keys}"))
            .expect("a writable folder");
        scene::load(&file)
    };
    let png = folder.path().join("whole.png");
    ImageBuffer::from_pixel(2, 2, Rgba([9_u8, 9, 9, 255])).save(&png).expect("a writable folder");
    let whole = std::fs::read(&png).expect("a file");
    std::fs::write(folder.path().join("cut.png"), &whole[..whole.len() / 2]).expect("a writable folder");
    std::fs::write(folder.path().join("gif.png"), b"GIF89a").expect("a writable folder");
    std::fs::write(folder.path().join("cut.hdr"), b"#?RADIANCE\n\n-Y 99999 +X 99999\n")
        .expect("a writable folder");
    for (name, keys, expected) in [
        ("cut.png", "", "it is damaged"),
        ("gif.png", "", "it is a GIF picture; save it as PNG, JPEG, EXR or HDR"),
        ("cut.hdr", "", "99999 x 99999 pixels"),
        ("missing.exr", "", "cannot read"),
        ("whole.png", "color = [1, 1, 1]", "needs either color, or horizon and zenith, or image"),
        ("whole.png", "turn_degrees = nan", "turn_degrees is NaN"),
    ] {
        let refused = load(name, keys).expect_err(name).to_string();
        assert!(refused.contains(expected) && refused.contains("sky.toml:"), "{name}: {refused}");
    }
    let mut settings =
        Settings::of_scene(scene::SceneRef::new(load("whole.png", "").expect("a whole image")));
    settings.estimator.integrator = Integrator::Whitted;
    let refused = settings.check().expect_err("a sky that whitted does not show").to_string();
    assert!(refused.contains("use the integrator path"), "{refused}");
}
