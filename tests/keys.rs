//! What a renderer keeps from one picture for the next: exactly what does not depend on what has changed.

mod common;

use common::scenes::EVERYTHING;
use common::{Gpu, bits, scene_of, settings_of, small};
use thinlens::gpu_types::SceneData;
use thinlens::passes::SceneBuffers;
use thinlens::renderer::{Picked, Question, Renderer};
use thinlens::scene::{ApertureImage, CameraModel, Overlay};
use thinlens::settings::{Sampler, Settings};
use thinlens::vulkan::Traits;

/// A scene in which things move.
const MOVING: &str = "[camera]\neye = [0, 1, 6]\nlook_at = [0, 0.5, 0]\nvfov_degrees = 50\nlens_diameter = 0.2\n\
                      focal_distance = 6\nshutter = 0.1\n[background]\ncolor = [0.2, 0.3, 0.5]\n\
                      [ambient]\nradiance = 1\n[matte.m]\nka = 0.8\nkd = 0\ncolor = [1, 0.9, 0.2]\n\
                      [[sphere]]\ncenter = [0, 0.5, 0]\nradius = 0.5\nmaterial = \"m\"\nvelocity = [3, 0, 0]\n";

/// All that a user gets to see of a picture: the film, what is shown, and what lies under a pixel.
#[derive(PartialEq)]
struct All {
    film: Vec<[u32; 4]>,
    shown: Vec<u8>,
    picked: Option<Picked>,
}

fn all(renderer: &mut Renderer) -> All {
    renderer.render(|_| ()).expect("a rendering");
    let film = bits(&renderer.read_film().expect("a film"));
    let shown = renderer.read_picture().expect("a picture");
    let picked = renderer.pick(Question { position: [30.5, 24.5], fan: 5, samples: 4 }).expect("an answer");
    All { film, shown, picked }
}

/// Catches a part that stays although what it was made for has changed: its pixels, its overlay or its answers would
/// be those of the settings before.
#[test]
fn what_changes_is_made_anew() {
    let gpu = Gpu::new();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let image = |name: &str, open: u8| {
        let path = folder.path().join(name);
        let file = std::fs::File::create(&path).expect("a writable folder");
        let mut encoder = png::Encoder::new(file, 4, 1);
        encoder.set_color(png::ColorType::Grayscale);
        let row = [0, 1, 2, 3].map(|column| if column < open { 255 } else { 0 });
        encoder.write_header().expect("a header").write_image_data(&row).expect("pixels");
        ApertureImage::read(&path).expect("an aperture")
    };
    let images = [image("half.png", 2), image("quarter.png", 1)];
    let everything = settings_of(EVERYTHING, [61, 47], 40);
    let with = |change: &dyn Fn(&mut Settings)| {
        let mut settings = everything.clone();
        change(&mut settings);
        settings
    };
    let moving = settings_of(MOVING, [61, 47], 40);
    let mut longer = moving.clone();
    longer.estimator.shutter *= 5.0;
    let mut of_depth = moving.clone();
    of_depth.show(Some(Overlay::Depth));
    let pictures = [
        ("plain", everything.clone()),
        ("scene", Settings { samples: 40, ..small("suffern-mirror") }),
        ("moving", moving),
        ("longer", longer),
        ("depth of what moves", of_depth),
        ("size", with(&|of| of.estimator.size = [64, 48])),
        ("sampler", with(&|of| of.estimator.sampler = Sampler::Random)),
        ("adaptive", with(&|of| of.estimator.noise_threshold = 0.1)),
        ("error", with(&|of| of.show(Some(Overlay::Error)))),
        ("count", with(&|of| of.show(Some(Overlay::Count)))),
        ("depth", with(&|of| of.show(Some(Overlay::Depth)))),
        ("blades", with(&|of| of.estimator.aperture.blades = 5)),
        ("image", with(&|of| of.estimator.aperture.image = Some(images[0].clone()))),
        ("another image", with(&|of| of.estimator.aperture.image = Some(images[1].clone()))),
        ("pinhole", with(&|of| of.estimator.model = CameraModel::Pinhole)),
        ("bounces", with(&|of| of.estimator.max_bounces = 0)),
        ("jitter", with(&|of| of.estimator.jitter = 3.0)),
    ];
    let fresh: Vec<All> = (pictures.iter())
        .map(|(_, settings)| all(&mut Renderer::new(gpu.device(), settings).expect("a renderer")))
        .collect();
    let different = |number: usize| fresh.iter().filter(|other| **other != fresh[number]).count();
    for (number, (name, _)) in pictures.iter().enumerate() {
        assert_eq!(different(number), fresh.len() - 1, "'{name}' is told from all others");
    }
    let mut renderer = Renderer::new(gpu.device(), &pictures[0].1).expect("a renderer");
    for number in 1..pictures.len() {
        // From the one before, back to the plain one, and from there.
        for number in [number, 0, number] {
            let (name, settings) = &pictures[number];
            renderer.set(settings).expect("valid settings");
            assert!(all(&mut renderer) == fresh[number], "'{name}' is not what a new renderer makes of it");
        }
    }
}

/// Catches a number of things that pipelines are compiled for on a GPU where it gains nothing: opening another scene
/// would compile them anew. Numbers that loops are unrolled for are worth it.
#[test]
fn pipelines_are_compiled_for_few_numbers_on_gpus() {
    let constants = |gpu: &Gpu, spheres: usize, others: usize| {
        let mut toml = MOVING.to_owned();
        for i in 0..spheres {
            let material = i % others;
            toml += &format!("[[sphere]]\ncenter = [{i}, 0, -3]\nradius = 0.4\nmaterial = \"m{material}\"\n");
        }
        for i in 0..others {
            toml += &format!("[matte.m{i}]\nka = 0.1\nkd = 0.5\ncolor = [1, 1, 1]\n");
            toml += &format!("[[point]]\nposition = [{i}, 5, 0]\nradiance = 1\nshadows = {}\n", i % 2 == 0);
        }
        let scene = SceneData::new(&scene_of(&toml), 0.1);
        SceneBuffers::new(gpu.device(), &scene).expect("a scene").constants().to_vec()
    };
    let gpu = Gpu::used_as(Some(Traits::GPU));
    assert_ne!(constants(&gpu, 2, 3), constants(&gpu, 40, 3), "the loops over few shapes are unrolled");
    assert_ne!(constants(&gpu, 2, 3), constants(&gpu, 2, 4), "the loops over few lights are unrolled");
    assert_eq!(constants(&gpu, 90, 3), constants(&gpu, 120, 3), "shapes in a tree");
    assert_eq!(constants(&gpu, 40, 70), constants(&gpu, 50, 80), "many lights and materials");
    assert_ne!(
        constants(&gpu, 40, 70),
        constants(&gpu, 90, 70),
        "a tree is compiled in only where there is one"
    );
}
