//! A mesh that is opened by itself: how it stands, what it is made of and how it is lit; and that a saved scene shows
//! the same.

mod common;

use common::{Gpu, mesh, run};
use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
use glam::{DVec3, Vec3};
use std::path::Path;
use thinlens::scene::{self, Gradient, LightKind, ModelMaterial, Plane, SceneRef, Stage, Triangle, UpAxis};
use thinlens::settings::{Settings, list};

/// A slanted tip on a flat foot: its height is along y, and no turn maps it to itself.
fn tip() -> String {
    let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.3, 3.0, 0.2]];
    text(points.map(DVec3::from_array))
}

fn text(points: [DVec3; 4]) -> String {
    let line = |point: DVec3| format!("v {} {} {}\n", point.x, point.y, point.z);
    points.map(line).concat() + "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"
}

/// Renders to a file, and gives the bits of its linear light.
fn render(folder: &Path, arguments: &[&str], output: &str) -> Vec<u32> {
    let outcome = run(folder, &[&["render", "--quiet", "-o", output], arguments].concat());
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments:?}");
    let image = read_first_flat_layer_from_file(folder.join(output)).expect("a picture");
    let channels = image.layer_data.channel_data.list.into_iter();
    let bits = channels.map(|channel| match channel.sample_data {
        FlatSamples::F32(levels) => levels.into_iter().map(f32::to_bits).collect(),
        other => panic!("{other:?}"),
    });
    bits.collect::<Vec<Vec<u32>>>().concat()
}

/// The settings of a model that is shown like this.
fn staged(folder: &Path, obj: &str, change: impl FnOnce(&mut Stage)) -> Settings {
    let file = folder.join("some.obj");
    std::fs::write(&file, obj).expect("a mesh");
    let mut settings = Settings::of_scene(SceneRef::new(scene::load(&file).expect("a scene")));
    change(&mut settings.estimator.stage);
    settings.restage().expect("a model");
    settings
}

fn corners(settings: &Settings) -> Vec<DVec3> {
    let triangles = settings.estimator.scene.of_kind::<Triangle>();
    triangles.flat_map(|(triangle, _)| triangle.vertices).collect()
}

/// Catches an axis that is turned to another side, a turn in the wrong direction or about another axis than the middle
/// of the foot, and a model that does not stand on its ground.
#[test]
fn a_model_stands_on_the_axis_that_points_up_and_turns_about_the_vertical() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let plain = corners(&staged(folder.path(), &tip(), |_| {}));
    // The same model, written with another axis up: where each axis of the file points.
    let axes: [(UpAxis, [DVec3; 3]); 6] = [
        (UpAxis::Y, [DVec3::X, DVec3::Y, DVec3::Z]),
        (UpAxis::Z, [DVec3::X, DVec3::NEG_Z, DVec3::Y]),
        (UpAxis::X, [DVec3::Y, DVec3::NEG_X, DVec3::Z]),
        (UpAxis::MinusY, [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z]),
        (UpAxis::MinusZ, [DVec3::X, DVec3::Z, DVec3::NEG_Y]),
        (UpAxis::MinusX, [DVec3::NEG_Y, DVec3::X, DVec3::Z]),
    ];
    let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.3, 3.0, 0.2]].map(DVec3::from_array);
    for (up, of_file) in axes {
        let written = points.map(|point| DVec3::from_array(of_file.map(|axis| axis.dot(point))));
        for turn in [0.0_f32, 90.0, -37.0] {
            let settings = staged(folder.path(), &text(written), |stage| {
                (stage.up, stage.turn_degrees) = (up, turn);
            });
            // Seen from above, a positive turn goes against the clock.
            let (sine, cosine) = f64::from(turn).to_radians().sin_cos();
            for (is, was) in corners(&settings).into_iter().zip(&plain) {
                let (x, z) = (cosine * was.x + sine * was.z, cosine * was.z - sine * was.x);
                let expected = DVec3::new(x, was.y, z);
                assert!(is.distance(expected) < 1e-9, "{up:?}, {turn}: {is} is not {expected}");
            }
            let scene = &settings.estimator.scene;
            let (ground, _) = scene.of_kind::<Plane>().next().expect("a ground");
            let lowest = corners(&settings).iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
            assert!(lowest > ground.point.y && lowest - ground.point.y < 0.01, "{up:?}");
            // The lens is focused on the nearest corner of the turned model.
            let camera = &settings.estimator.camera;
            let depth = |corner: &DVec3| camera.frame().axial_depth(camera.eye, *corner);
            let nearest = corners(&settings).iter().map(depth).fold(f64::INFINITY, f64::min);
            let focus = f64::from(settings.estimator.lens.focal_distance);
            assert!((focus - nearest).abs() < 1e-5 * nearest, "{up:?}, {turn}: {focus}, {nearest}");
        }
    }
}

/// Catches a camera or a lens that is lost when the model is turned, and one that stays although nobody has changed it.
#[test]
fn what_was_changed_stays_when_the_model_is_turned() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut settings = staged(folder.path(), &tip(), |_| {});
    let own = settings.clone();
    settings.estimator.camera.eye += DVec3::new(0.5, 0.25, 1.0);
    settings.estimator.shutter = 0.5;
    settings.samples = 7;
    let changed = settings.clone();
    settings.estimator.stage.up = UpAxis::Z;
    settings.restage().expect("a model");
    let (now, was) = (&settings.estimator, &changed.estimator);
    assert_eq!((now.camera.eye, now.shutter, settings.samples), (was.camera.eye, was.shutter, 7));
    assert_ne!(now.camera.look_at, own.estimator.camera.look_at, "the camera does not look at the model");
    assert_ne!(now.lens.focal_distance, own.estimator.lens.focal_distance);

    let other = SceneRef::new(scene::load("version-4").expect("a built-in scene"));
    assert_eq!(settings.with_scene(other).estimator.stage, Stage::default());
}

/// Catches a colour, a sky or a light that goes somewhere else, and a change of a colour that copies the shapes: then
/// their tree would be made anew.
#[test]
fn colours_and_lights_change_without_the_shapes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let plain = staged(folder.path(), &mesh::sphere(8, false, false), |_| {});
    let with = |change: &dyn Fn(&mut Stage)| {
        let mut settings = plain.clone();
        change(&mut settings.estimator.stage);
        let only_colors = settings.needs_colors();
        settings.restage().expect("a model");
        let shares = settings.estimator.scene.shares_shapes(&plain.estimator.scene);
        assert_eq!(shares, only_colors);
        (settings, shares)
    };
    let blue = DVec3::new(0.125, 0.25, 0.5);
    for (_, material) in ModelMaterial::NAMES {
        let (settings, shares) = with(&|stage| (stage.material, stage.color) = (material, blue));
        assert!(shares, "{material:?}");
        let scene = &settings.estimator.scene;
        let (_, of) = scene.of_kind::<Triangle>().next().expect("a triangle");
        // In white ambient light, each kind is as bright as its colour, but for a mirror.
        let of = &scene.materials[of.material as usize];
        let bright = of.brightest(DVec3::ZERO, DVec3::ONE).as_vec3() + of.reflectance();
        assert_eq!(bright, blue.as_vec3(), "{material:?}");
        assert_eq!(scene.materials[0], plain.estimator.scene.materials[0], "the ground has changed");
    }
    let (settings, shares) = with(&|stage| {
        (stage.sky, stage.horizon) = (blue, DVec3::ONE);
        (stage.light_direction, stage.light_strength) = (DVec3::X, 2.0);
    });
    assert!(shares);
    let scene = &settings.estimator.scene;
    assert_eq!(scene.background, Gradient { horizon: Vec3::ONE, zenith: blue.as_vec3() }.into());
    assert!(matches!(scene.lights[0].kind, LightKind::Directional(light) if light.direction == Vec3::X));
    assert_eq!(scene.lights[0].radiance, 2.0 * plain.estimator.scene.lights[0].radiance);
    assert_eq!(scene.lights[1], plain.estimator.scene.lights[1]);

    for change in [
        (|stage: &mut Stage| stage.ground = false) as fn(&mut Stage),
        |stage| stage.turn_degrees = 1.0,
        |stage| stage.up = UpAxis::X,
    ] {
        assert!(!with(&change).1);
    }
    assert_eq!(with(&|stage| stage.ground = false).0.estimator.scene.of_kind::<Plane>().count(), 0);
}

/// Catches a colour that does not reach the device, a picture that goes on from the old one, and a device that keeps
/// what it should not: the picture after a change is the picture of a new renderer.
#[test]
fn a_changed_colour_gives_the_picture_that_it_gives_from_the_start() {
    let gpu = Gpu::new();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut plain = staged(folder.path(), &mesh::sphere(8, false, false), |_| {});
    (plain.estimator.size, plain.samples) = ([48, 36], 4);
    let mut renderer = gpu.renderer(&plain);
    let film = |renderer: &mut thinlens::renderer::Renderer| {
        renderer.render(|_| ()).expect("a picture");
        renderer.read_film().expect("a film").iter().flatten().map(|is| is.to_bits()).collect::<Vec<u32>>()
    };
    let mut last = film(&mut renderer);
    for (change, nearly) in [
        ((|stage: &mut Stage| stage.color = DVec3::new(0.1, 0.8, 0.2)) as fn(&mut Stage), true),
        (|stage| stage.sky = DVec3::X, true),
        (|stage| stage.light_direction = DVec3::new(1.0, 0.4, 0.0), true),
        // Passes are compiled for other kinds of material.
        (|stage| stage.material = ModelMaterial::Mirror, false),
        (|stage| stage.color = DVec3::ONE, true),
        (|stage| stage.turn_degrees = 30.0, false),
        (|stage| stage.ground = false, false),
    ] {
        let mut settings = plain.clone();
        change(&mut settings.estimator.stage);
        assert!(!renderer.prepared().fits(&settings, false), "the scene is not as it should be");
        assert!(!renderer.prepared().nearly_fits(&settings, false), "the scene is not as it should be");
        settings.restage().expect("a model");
        assert_eq!(
            renderer.prepared().nearly_fits(&settings, false),
            nearly,
            "{:?}",
            settings.estimator.stage
        );
        renderer.set(&settings).expect("a picture");
        let now = film(&mut renderer);
        assert!(now != last, "nothing has changed: {:?}", settings.estimator.stage);
        assert!(now == film(&mut gpu.renderer(&settings)), "{:?}", settings.estimator.stage);
        (plain, last) = (settings, now);
    }
}

/// Catches an option that does nothing, a saved scene that lacks what was chosen or rounds it, and a picture that does
/// not say how its model was shown.
#[test]
fn a_saved_model_is_the_same_picture_to_the_bit() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    std::fs::write(folder.join("ball.obj"), mesh::sphere(6, false, false)).expect("a mesh");
    let colored = format!("mtllib some.mtl\nusemtl red\n{}", tip());
    std::fs::write(folder.join("tip.obj"), colored).expect("a mesh");
    std::fs::write(folder.join("some.mtl"), "newmtl red\nKd 0.8 0.1 0.1\n").expect("colours");
    std::fs::create_dir(folder.join("saved")).expect("a folder");
    let small = ["-s", "64x48", "-n", "4"];
    let picture = |arguments: &[&str]| render(folder, &[arguments, &small[..]].concat(), "a.exr");
    let mut seen = Vec::new();
    for (name, options) in [
        ("tip.obj", &[][..]),
        ("tip.obj", &["--model-up", "z"]),
        ("tip.obj", &["--model-up=-x", "--model-turn", "33.3", "--f-number", "1.4"]),
        ("tip.obj", &["--model-turn", "-120deg", "--eye", "4,3,5", "--ground=false"]),
        ("tip.obj", &["--model-material", "matte", "--model-color", "#3366cc"]),
        ("tip.obj", &["--model-material", "glossy", "--light-from", "100", "--light-height", "20"]),
        ("tip.obj", &["--model-material", "mirror", "--model-color", "0.9,0.95,1", "--max-bounces", "3"]),
        ("tip.obj", &["--model-material", "glowing", "--sky", "0,0,0", "--horizon", "#102030"]),
        ("ball.obj", &[]),
        ("ball.obj", &["--model-color", "#80c040"]),
        ("ball.obj", &["--light-strength", "3", "--light-direction", "1,2,0.3"]),
        ("ball.obj", &["--model-material", "clay", "--ground=false", "--sky", "0.1,0.2,0.3"]),
    ] {
        let told = [&[name], options].concat();
        let expected = picture(&told);
        for file in ["here.toml", "saved/there.toml"] {
            let outcome = run(folder, &[&["save"], &told[..], &["-o", file]].concat());
            assert_eq!(outcome.code, 0, "{told:?}: {}", outcome.stderr);
            let bounces = ["--max-bounces", "3"];
            let bounces = if options.contains(&"--max-bounces") { &bounces[..] } else { &[] };
            let saved = picture(&[&[file], bounces].concat());
            assert!(saved == expected, "{told:?} is another picture as {file}");
        }
        // The picture itself says how it was made, so that the same picture comes of it.
        picture(&told);
        let again = render(folder, &["--from", "a.exr"], "b.exr");
        assert!(again == expected, "{told:?} is another picture from its own file");
        assert!(!seen.contains(&expected), "{told:?} does nothing");
        seen.push(expected);
    }
}

/// Catches a command that says nothing of how the model is shown, or cannot be read again.
#[test]
fn the_command_line_of_a_model_gives_the_model_again() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let settings = staged(folder.path(), &tip(), |stage| {
        *stage = Stage {
            up: UpAxis::MinusZ,
            turn_degrees: -12.5,
            material: ModelMaterial::Glossy,
            color: DVec3::new(0.1, 0.2, 1.0 / 3.0),
            ground: false,
            sky: DVec3::new(0.0, 0.5, 1.0),
            horizon: DVec3::new(1.0, 0.25, 0.125),
            light_direction: DVec3::new(-1.0, 0.3, 0.1),
            light_strength: 0.7,
        }
    });
    let arguments = settings.arguments();
    let again = Settings::of_arguments(&arguments).expect("settings");
    let differ = |setting: &&thinlens::settings::Setting| setting.get(&again) != setting.get(&settings);
    let lost: Vec<_> = list::own().filter(differ).map(|setting| setting.flag).collect();
    assert!(lost.is_empty(), "{lost:?} of {arguments:?}");
    assert_eq!(corners(&again), corners(&settings));
}

/// Catches options of a model that a scene takes without a word, and values that no model can have.
#[test]
fn a_scene_that_is_no_model_refuses_its_options() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("tip.obj"), tip()).expect("a mesh");
    for (arguments, message) in [
        (&["version-4", "--model-up", "z"][..], "version-4 is no mesh"),
        (&["suffern-boxes", "--ground=false"], "suffern-boxes is no mesh"),
        (&["tip.obj", "--model-color", "red"], "#RRGGBB"),
        (&["tip.obj", "--model-color", "1,2,0"], "must be from 0 to 1"),
        (&["tip.obj", "--model-turn", "1000"], "--model-turn"),
        (&["tip.obj", "--light-direction", "0,0,0"], "must not be zero"),
        (&["tip.obj", "--light-strength", "-1"], "--light-strength"),
    ] {
        let outcome = run(folder.path(), &[&["render"], arguments, &["-o", "a.png"]].concat());
        assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    }
}
