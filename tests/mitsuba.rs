//! Against a renderer of other authors: Mitsuba 3 with the same lens, spheres of matte, glass and mirror,
//! checkered plane, directional light, lamp, and skies of one colour and of an image. `tests/mitsuba` has the scenes, Mitsuba's pictures of them, and the script
//! that makes these; the test needs no Mitsuba.

mod common;

use anyhow::{Context, Result, bail, ensure};
use common::statistics::{Moments, Spread};
use common::{Gpu, pictures, prove};
use exr::prelude::{AttributeValue, ReadChannels, ReadLayers, Text, read};
use std::path::{Path, PathBuf};
use thinlens::scene::{self, SceneRef};
use thinlens::settings::Settings;

/// What the two renderers may differ by besides noise, as a share of a value: both compute in f32.
const BOUND: f64 = 1e-4;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join("mitsuba").join(name)
}

/// Mitsuba's mean of each channel of each pixel, with its spread.
fn reference(name: &str, size: [u32; 2]) -> Result<Spread> {
    let path = file(name).with_extension("exr");
    let image = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let image = image.all_attributes().from_file(&path);
    let layer = image.with_context(|| format!("{}: run tests/mitsuba/render.py", path.display()))?.layer_data;
    ensure!(
        [layer.size.0, layer.size.1] == size.map(|extent| extent as usize),
        "{name}: {:?} pixels",
        layer.size
    );
    let runs = match layer.attributes.other.get(&Text::from("runs")) {
        Some(AttributeValue::I32(runs)) => f64::from(*runs),
        other => bail!("{} says {other:?} for its number of pictures", path.display()),
    };
    let channel = |name: &str| -> Result<Vec<f64>> {
        let found = layer.channel_data.list.iter().find(|channel| channel.name.eq(name));
        let found = found.with_context(|| format!("{} has no channel {name}", path.display()))?;
        Ok(found.sample_data.values_as_f32().map(f64::from).collect())
    };
    let mut pixels = vec![[Moments::default(); 3]; layer.size.0 * layer.size.1];
    for (number, name) in ["R", "G", "B"].into_iter().enumerate() {
        let spread = channel(name)?.into_iter().zip(channel(&format!("error.{name}"))?);
        for (pixel, (mean, error)) in pixels.iter_mut().zip(spread) {
            pixel[number] = Moments::known(runs, mean, error);
        }
    }
    Ok(Spread::of_pixels(pixels))
}

/// Compares so many samples per pixel of each of these scenes with Mitsuba's pictures: in every channel of every pixel the
/// two renderers' means agree within their noise, without any exception, and so do the means over the picture.
fn compare(gpu: &Gpu, names: &[&str], samples: u32) -> Result<String> {
    let mut figures = Vec::new();
    for name in names {
        let path = file(name).with_extension("toml");
        let scene = scene::load(path.to_str().context("a plain path")?)?;
        let mut settings = Settings::of_scene(SceneRef::new(scene));
        settings.samples = samples;
        let expected = reference(name, settings.estimator.size)?;
        let device = Spread::of(pictures(gpu, &settings, 32)?);
        figures.push(format!("{name}: {}", device.agree(&expected, BOUND)?));
    }
    Ok(figures.join("; "))
}

/// Catches a mistake that the shaders and the oracle share, of the lens, the field of view, the film's orientation,
/// diffuse reflection, shadows or checkers.
#[test]
fn mitsuba_renders_the_same_pictures() {
    prove(
        |gpu| compare(gpu, &["near", "tilted"], 2048),
        &[
            "lens",
            "framing",
            "film_and_lens",
            "disk_radius_squared",
            "lambert_without_pi",
            "cosine_forgotten",
            "shadows_forgotten",
            "checker_in_two_dimensions",
        ],
    );
}

/// Likewise for light that is scattered up to eight times, by glass, a mirror and matte surfaces, from a lamp and the sky, or
/// from a sky that is an image.
#[test]
fn mitsuba_follows_the_same_paths() {
    prove(|gpu| compare(gpu, &["glass"], 1024), &["glass_of_one_polarization", "shadows_of_lamps_forgotten"]);
    prove(|gpu| compare(gpu, &["sky"], 1024), &["sky_without_blending", "sky_counted_twice"]);
}
