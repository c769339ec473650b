//! The film: what a picture depends on, and what it must not depend on.

mod common;

use common::{Gpu, bits, film, render, settings_of, small};
use std::time::Duration;
use thinlens::passes::Shaders;
use thinlens::renderer::{Pace, Renderer};
use thinlens::settings::{Sampler, Settings};
use thinlens::vulkan::{Commands, Shader};

/// Catches a focal distance that leaks into the pinhole: with no lens there is nothing to focus.
#[test]
fn a_pinhole_has_no_focal_distance() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    settings.estimator.lens.diameter = 0.0;
    let films = [0.37, 10.0, 1e6].map(|distance| {
        settings.estimator.lens.focal_distance = distance;
        bits(&film(&gpu, &settings))
    });
    assert_eq!(films[0], films[1]);
    assert_eq!(films[0], films[2]);

    settings.estimator.lens.diameter = 0.5;
    assert_ne!(films[0], bits(&film(&gpu, &settings)), "a lens makes a difference");
}

/// Catches state that survives from one picture to the next, and races between invocations.
#[test]
fn the_same_settings_give_the_same_bits_and_another_seed_does_not() {
    let gpu = Gpu::new();
    for jitter in [1.0, 3.0] {
        let mut settings = small("version-4");
        settings.estimator.jitter = jitter;
        let first = bits(&film(&gpu, &settings));
        assert_eq!(first, bits(&film(&gpu, &settings)), "jitter {jitter}");
        settings.estimator.seed = 1;
        assert_ne!(first, bits(&film(&gpu, &settings)), "jitter {jitter}");
    }
}

/// Catches samples lost or doubled at the edges of tiles, an order of merging that follows the
/// tiles, and a preview that changes the picture it is a preview of.
#[test]
fn tiles_previews_and_pauses_change_nothing() {
    let gpu = Gpu::new();
    for (jitter, size) in [(1.0, [64, 48]), (1.0, [37, 51]), (3.0, [37, 51]), (2.5, [5, 3])] {
        let mut settings = small("version-4");
        settings.estimator.jitter = jitter;
        settings.estimator.size = size;
        settings.samples = 21;
        let expected = bits(&film(&gpu, &settings));
        for preview in [false, true] {
            // A budget of nothing: a row of workgroups a submission.
            let pace = Pace { budget: Duration::ZERO, preview };
            let mut renderer = Renderer::new(gpu.device(), &settings).expect("valid settings");
            let mut submissions = 0;
            renderer
                .render_at(pace, |_| {
                    submissions += 1;
                    if submissions % 16 == 0 {
                        std::thread::sleep(Duration::from_millis(1));
                    }
                })
                .expect("a rendering");
            assert!(submissions >= 6, "one submission at least for each pass");
            let got = bits(&renderer.read_film().expect("a film"));
            assert!(got == expected, "jitter {jitter}, size {size:?}, preview {preview}");
        }
    }
}

/// Catches a mean that weighs batches wrongly: 8 and 8 samples are not 16 if either is off.
#[test]
fn another_cut_of_batches_gives_the_same_mean() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    settings.samples = 50;
    let expected = film(&gpu, &settings);
    for usual_batch in [1, 2, 8, 64] {
        let mut renderer = Renderer::new(gpu.device(), &settings).expect("valid settings");
        renderer.set_usual_batch(usual_batch);
        renderer.render(|_| ()).expect("a rendering");
        for (got, expected) in renderer.read_film().expect("a film").iter().zip(&expected) {
            assert_eq!(got[3], 50.0);
            for channel in 0..3 {
                let error = (got[channel] - expected[channel]).abs() / expected[channel].abs().max(1e-3);
                assert!(error <= 1e-5, "batches of {usual_batch}: {got:?}, not {expected:?}");
            }
        }
    }
}

/// Catches a raised target that starts anew, and one that counts samples twice.
#[test]
fn raising_the_target_goes_on_and_lowering_it_below_the_count_restarts() {
    let gpu = Gpu::new();
    let mut settings = small("suffern-boxes");
    settings.samples = 64;
    let expected = bits(&film(&gpu, &settings));

    let mut renderer = Renderer::new(gpu.device(), &settings).expect("valid settings");
    let mut go_to = |samples: u32| {
        settings.samples = samples;
        renderer.set(&settings).expect("valid settings");
        let before = renderer.progress().samples;
        renderer.render(|_| ()).expect("a rendering");
        (before, bits(&renderer.read_film().expect("a film")))
    };
    assert_eq!(go_to(32).0, 0);
    let (before, raised) = go_to(64);
    assert_eq!(before, 32, "it goes on from where it was");
    assert!(raised == expected);
    let (before, lowered) = go_to(8);
    assert_eq!(before, 0, "it starts anew");
    assert!(lowered.iter().all(|texel| texel[3] == 8.0_f32.to_bits()));
}

/// Catches a film that keeps samples of another lens, and one that forgets them for a mere change
/// of exposure.
#[test]
fn the_film_restarts_with_the_estimator_and_not_with_the_view() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    let mut renderer = Renderer::new(gpu.device(), &settings).expect("valid settings");
    renderer.render(|_| ()).expect("a rendering");
    let dark = renderer.read_picture().expect("a picture");

    settings.view.exposure_stops = 1.0;
    renderer.set(&settings).expect("valid settings");
    assert!(renderer.finished(), "the film is as good as before");
    let bright = renderer.read_picture().expect("a picture");
    let sum = |picture: &[u8]| picture.iter().map(|value| u64::from(*value)).sum::<u64>();
    assert!(sum(&bright) > sum(&dark));

    let changes: [fn(&mut Settings); 10] = [
        |settings| settings.estimator.lens.diameter *= 2.0,
        |settings| settings.estimator.lens.focal_distance *= 2.0,
        |settings| settings.estimator.camera.eye.y += 1.0,
        |settings| settings.estimator.camera.vfov_radians *= 0.9,
        |settings| settings.estimator.jitter = 2.0,
        |settings| settings.estimator.max_bounces = 0,
        |settings| settings.estimator.seed = 7,
        |settings| settings.estimator.sampler = Sampler::Random,
        |settings| settings.estimator.noise_threshold = 0.1,
        |settings| settings.estimator.scene = small("suffern-mirror").estimator.scene,
    ];
    for (number, change) in changes.iter().enumerate() {
        change(&mut settings);
        renderer.set(&settings).expect("valid settings");
        assert_eq!(renderer.progress().samples, 0, "change {number}");
        renderer.render(|_| ()).expect("a rendering");
        let kept = bits(&renderer.read_film().expect("a film"));
        assert!(kept == bits(&film(&gpu, &settings)), "change {number}");
    }
}

/// A light, and a material for shapes to come.
const LIT: &str = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nvfov_degrees = 60\nlens_diameter = 0.1\n\
                   focal_distance = 9\n[ambient]\nradiance = 1\n[[directional]]\ndirection = [1, 2, 3]\n\
                   radiance = 2\n[matte.m]\nka = 0.5\nkd = 0.5\ncolor = [1, 0.9, 0.8]\n";

/// A grid of spheres.
fn spheres(count: usize) -> Settings {
    let sphere = |number: usize| {
        let (x, y, z) =
            (0.5 * (number % 20) as f64 - 5.0, 0.5 * (number / 20 % 20) as f64 - 5.0, number / 400);
        format!("[[sphere]]\ncenter = [{x}, {y}, -{z}]\nradius = 0.2\nmaterial = \"m\"\n")
    };
    settings_of(&(LIT.to_owned() + &(0..count).map(sphere).collect::<String>()), [24, 18], 20)
}

/// Planes, one behind the other, and this text of a scene file before them.
fn planes(before: &str, count: usize) -> Settings {
    let plane = |number: usize| {
        format!("[[plane]]\npoint = [0, 0, -{number}]\nnormal = [0, 0, 1]\nmaterial = \"m\"\n")
    };
    settings_of(&(LIT.to_owned() + before + &(0..count).map(plane).collect::<String>()), [24, 18], 20)
}

/// Catches lavapipe's limit of 65,535 loop steps an invocation, beyond which it leaves the loops
/// silently: samples went missing in scenes of thousands of shapes.
#[test]
fn many_shapes_lose_no_samples() {
    let gpu = Gpu::new();
    // The farthest of these planes are never seen.
    // Lavapipe has the limit, even where it is used as a GPU that has none.
    for mut settings in [spheres(3000), planes("", if common::as_gpu() { 300 } else { 3000 })] {
        let film = film(&gpu, &settings);
        assert!(film.iter().all(|texel| texel[3] == 20.0));
        settings.samples = 8;
        let mut renderer = Renderer::new(gpu.device(), &settings).expect("valid settings");
        thinlens::verify::verify(&mut renderer, &settings).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Catches a scene that is compiled before it is refused: the driver may end the program over it. More than a
/// software device can do is refused. A tree bounds what balls cost a ray, but nothing does for planes.
#[test]
fn what_needs_too_many_steps_is_refused_before_it_is_compiled() {
    let gpu = Gpu::new();
    if gpu.device().traits().max_loop_steps.is_none() {
        return; // A GPU has no such limit.
    }
    // No driver is given this.
    let trace = [Shader { name: "trace", spirv: &[] }; 2];
    let shaders = Shaders { trace, ..Shaders::default() };
    // So many lights that the shapes are few enough for every device's buffers.
    let lights = "[[directional]]\ndirection = [1, 2, 3]\nradiance = 2\n".repeat(3);
    let settings = planes(&lights, 20_000);
    let error =
        Renderer::with_shaders(gpu.device(), shaders, &settings).err().expect("too many for software");
    assert!(error.to_string().contains("20000 planes"), "{error}");
}

/// Catches a search of the tree that is cut short and taken for a miss. Thousands of triangles, of which
/// every ray meets the boxes and none of the shapes, take a software device too long.
#[test]
fn what_takes_too_long_is_rejected() {
    let gpu = Gpu::new();
    let triangle = |number: usize| {
        let z = -0.001 * number as f64;
        format!(
            "[[triangle]]\nvertices = [[-90, 90, {z}], [90, 90, {z}], [90, -89, {z}]]\nmaterial = \"m\"\n"
        )
    };
    let mut toml = LIT.to_owned() + &(0..3000).map(triangle).collect::<String>();
    toml = toml
        .replace("look_at = [0, 0, 0]", "look_at = [-40, -42, 0]")
        .replace("vfov_degrees = 60", "vfov_degrees = 1");
    let settings = settings_of(&toml, [8, 8], 4);
    let mut renderer = gpu.renderer(&settings);
    let film = render(&mut renderer, &settings).expect("a film");
    let counted: f32 = film.iter().map(|texel| texel[3]).sum();
    let rejected = renderer.progress().rejected_samples;
    let software = gpu.device().traits().max_tree_steps.is_some();
    assert_eq!((counted, rejected), if software { (0.0, 256) } else { (256.0, 0) });
}

/// Catches a preview that shows what the images held before: it fills only a lattice, and nothing is
/// emptied for it. After each submission the picture is that of a renderer that rendered nothing else.
#[test]
fn a_preview_shows_nothing_of_the_last_picture() {
    let gpu = Gpu::new();
    let mut settings = small("version-4");
    // Not a multiple of four, so that cells at the edges are cut.
    settings.estimator.size = [63, 47];
    let pace = Pace { budget: Duration::ZERO, preview: true };
    let pictures = |renderer: &mut Renderer| -> Vec<Vec<u8>> {
        renderer.set(&settings).expect("valid settings");
        let mut commands = Commands::new(gpu.device()).expect("commands");
        let mut after_submission = |_| {
            let mut recording = commands.begin().expect("a recording");
            renderer.record(&mut recording, 0, pace);
            recording.submit().expect("a submission");
            commands.wait().expect("the device");
            renderer.collect(0).expect("figures");
            renderer.read_picture().expect("a picture")
        };
        (0..30).map(&mut after_submission).collect()
    };
    let mut other = settings.clone();
    other.estimator.scene = small("suffern-boxes").estimator.scene;
    let mut used = Renderer::new(gpu.device(), &other).expect("valid settings");
    used.render(|_| ()).expect("a rendering");
    let fresh = pictures(&mut Renderer::new(gpu.device(), &settings).expect("valid settings"));
    assert!(fresh[0] != fresh[29], "it is a preview");
    assert!(fresh[0].chunks(4).all(|pixel| pixel != [0; 4]), "every pixel is filled");
    assert!(pictures(&mut used) == fresh);
}

/// Catches pixels that show nothing because their samples were rejected: the pass that looks for a
/// neighbour is only used where a renderer knows that it must.
#[test]
fn pixels_whose_samples_were_rejected_show_a_neighbour() {
    let gpu = Gpu::new();
    let settings = settings_of(common::scenes::BURNING, [32, 24], 1);
    let mut renderer = Renderer::new(gpu.device(), &settings).expect("valid settings");
    let film = common::render(&mut renderer, &settings).expect("a film");
    let picture = renderer.read_picture().expect("a picture");
    let holes: Vec<_> = film.iter().zip(picture.chunks(4)).filter(|(texel, _)| texel[3] == 0.0).collect();
    assert!(!holes.is_empty() && holes.len() < film.len(), "{} holes", holes.len());
    let near_others = holes.iter().filter(|(_, pixel)| pixel[..3] != [0; 3]).count();
    println!("{} holes, {near_others} of them beside a pixel that is not black", holes.len());
    assert!(near_others > 0);
}
