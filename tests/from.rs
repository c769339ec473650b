//! Pictures that carry how they were made, and scenes that are saved: both give the same settings again.

mod common;

use common::{Gpu, decode_png, run};
use std::path::Path;
use thinlens::output::{self, Origin};

use thinlens::scene::{self, SceneRef, Sensor, Tolerance};
use thinlens::settings::{Access, Estimator, Settings, Value, Widget, list};

/// Every option that changes a picture, in groups that go together.
const OPTIONS: [&[&str]; 8] = [
    &["version-4", "-s", "40x30", "-n", "5"],
    &[
        "suffern-boxes",
        "-s",
        "40x30",
        "-n",
        "6",
        "--f-number",
        "1.7",
        "--focal-distance",
        "61.3",
        "--seed",
        "9",
    ],
    &[
        "-s",
        "40x30",
        "-n",
        "5",
        "--preset",
        "50mm-f1.2",
        "--blades",
        "7",
        "--blade-rotation",
        "11",
        "--roundness",
        "0.3",
    ],
    &[
        "-s",
        "40x30",
        "-n",
        "5",
        "--camera",
        "hole",
        "--hole-diameter",
        "0.07",
        "--upright",
        "--exposure-lock=false",
    ],
    &[
        "-s",
        "41x30",
        "-n",
        "5",
        "--eye=-1.5,3,0.7",
        "--look-at",
        "0.1,1.4,-9",
        "--up",
        "0.2,1,0",
        "--vfov",
        "43.7",
    ],
    &[
        "-s",
        "40x30",
        "-n",
        "7",
        "--anamorphic",
        "1.7",
        "--exposure=-0.7",
        "--jitter",
        "2.5",
        "--sampler",
        "sobol",
    ],
    &[
        "-s",
        "40x30",
        "-n",
        "5",
        "--cats-eye",
        "0.4",
        "--max-bounces",
        "1",
        "--metres-per-unit",
        "0.11",
        "--overlay",
        "depth",
    ],
    &[
        "passing",
        "-s",
        "40x30",
        "-n",
        "70",
        "--noise-threshold",
        "0.05",
        "--shutter",
        "1/25",
        "--iso",
        "320",
        "--tolerance",
        "3",
    ],
];

fn render(folder: &Path, arguments: &[&str], output: &str) -> Vec<u8> {
    let outcome = run(folder, &[&["render", "--quiet", "-o", output], arguments].concat());
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments:?}");
    std::fs::read(folder.join(output)).expect("a picture")
}

/// Catches an option that a picture forgets, or that comes back with other digits: the same bytes must come out.
#[test]
fn a_picture_renders_again_from_its_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let mut pixels = Vec::new();
    for (options, format) in OPTIONS.into_iter().zip(["png", "exr"].into_iter().cycle()) {
        let (first, second) = (format!("a.{format}"), format!("b.{format}"));
        let saved = render(folder, options, &first);
        let again = render(folder, &["--from", &first], &second);
        assert!(saved == again, "{options:?}: another picture comes of {first}");
        pixels.push(saved);
    }
    pixels.dedup();
    assert_eq!(pixels.len(), OPTIONS.len(), "some options change nothing");
}

/// Catches other options that do not win over the picture's, or that lose the rest of them.
#[test]
fn other_options_change_what_a_picture_says() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let of = |options: &[&str], output: &str| decode_png(&render(folder, options, output));
    of(
        &["-s", "40x30", "-n", "5", "--f-number", "2", "--seed", "3", "--upright", "--overlay", "count"],
        "a.png",
    );
    let expected = of(&["-s", "40x30", "-n", "9", "--f-number", "8", "--seed", "3"], "b.png");
    let changed = of(&["--from", "a.png", "-n", "9", "--f-number", "8", "--overlay", "none"], "c.png");
    assert!(changed == expected, "options do not change what the picture says");

    for (arguments, message) in [
        (&["--from", "a.png", "version-4"][..], "cannot be used with"),
        (&["--from", "none.png"], "cannot read none.png"),
        (&["--from", "a.txt"], "neither"),
        (&["--from", "plain.png"], "cannot be rendered again"),
    ] {
        let plain = std::fs::File::create(folder.join("plain.png")).expect("a file");
        let mut encoder = png::Encoder::new(plain, 1, 1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().expect("a header").write_image_data(&[0; 3]).expect("a pixel");
        let outcome = run(folder, &[&["render", "-o", "d.png"], arguments].concat());
        assert!(outcome.code != 0 && outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
        assert!(!folder.join("d.png").exists(), "{arguments:?} leaves a picture");
    }
}

/// Settings of a scene in which nothing is as the scene has it.
fn changed(scene: &SceneRef, random: &mut fastrand::Rng) -> Settings {
    let mut settings = Settings::of_scene(scene.clone());
    let plain = settings.clone();
    // The cat's eye is a shape of its own, beside which there are no blades.
    for setting in list::own().filter(|setting| setting.flag != "cats-eye" && !setting.is_of_model()) {
        let slider = setting.row.as_ref().and_then(|row| match &row.widget {
            Widget::Slider(slider) => Some((slider.range)(&plain).map(f64::from)),
            _ => None,
        });
        let mut part = |range: [f64; 2], most: f64| {
            let [low, high] = slider.unwrap_or(range);
            let (low, high) = (low.max(-most), high.min(most));
            low + random.f64() * (high - low)
        };
        let value = match &setting.access {
            Access::Single(_, range, _) => Value::Single(part(range.map(f64::from), 99.0) as f32),
            Access::Double(_, range, _) => Value::Double(part(*range, 99.0)),
            Access::Whole(_, range) | Access::WholeOrZero(_, range, _) => {
                Value::Whole(part(range.map(f64::from), 1e6) as u32)
            }
            Access::Switch(_) => Value::Switch(random.bool()),
            Access::Vector(_, range) | Access::Color(_, range) => {
                Value::Vector(glam::DVec3::from_array([(); 3].map(|()| part(*range, 9.0))))
            }
            Access::Size(..) => Value::Size([random.u32(1..999), random.u32(1..999)]),
            Access::Choice(_, choices) => Value::Name(random.choice(choices()).expect("a choice").name),
            Access::Tolerance(_) if random.bool() => Value::Tolerance(Tolerance::Film(random.f32() + 0.001)),
            Access::Tolerance(_) => Value::Tolerance(Tolerance::Pixels(random.f32() + 0.1)),
            Access::Sensor(_) => {
                let [width_mm, height_mm] = [(); 2].map(|()| 1.0 + 98.0 * random.f64());
                Value::Sensor(Sensor { width_mm, height_mm })
            }
            Access::Image(_) => continue,
        };
        setting.set(&mut settings, &value).expect("no image");
    }
    // A lens that moves cannot focus as near as this one may be.
    let Estimator { camera, lens, .. } = &mut settings.estimator;
    camera.focus_breathing &= camera.can_focus(lens).is_ok();
    // Most scenes are made for one integrator.
    if settings.estimator.integrator.can_render(scene).is_err() {
        settings.estimator.integrator = scene.integrator;
    }
    settings.check().expect("settings that there can be");
    settings
}

/// Catches a setting without an argument, and numbers that lose their last digits on the way.
#[test]
fn arguments_give_the_same_settings_to_the_bit() {
    let scene = SceneRef::new(scene::load("version-4").expect("a built-in scene"));
    let mut random = fastrand::Rng::with_seed(7);
    for _ in 0..200 {
        let settings = changed(&scene, &mut random);
        let arguments = settings.arguments();
        let mut again = Settings::of_arguments(&arguments).expect("settings");
        // Scenes are equal where they are the same loading.
        again.estimator.scene = scene.clone();
        assert_eq!(again, settings, "{arguments:?}");
    }
}

/// Catches a setting that a saved scene lacks, one that stays beside its other name, brightness that is counted
/// twice or not at all, and lost comments.
#[test]
fn a_saved_scene_has_the_settings_it_was_saved_with() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let own = folder.path().join("own.toml");
    let text = include_str!("../src/scene/builtin/suffern-boxes.toml");
    let shot = "eye = [0, 1, 9] # from here\nlook_at = [0, 1, 0]\nfocal_distance = 9\npreset = \"50mm-f1.4\"\n\n[view]\n\
                exposure = 0.5\noverlay = \"count\"\n\n[background]";
    let from = text.find("eye =").expect("a camera")..text.find("[background]").expect("one") + 12;
    std::fs::write(&own, [&text[..from.start], shot, &text[from.end..]].concat()).expect("a scene");
    let mut random = fastrand::Rng::with_seed(11);
    let names = scene::BUILTINS.iter().map(|builtin| builtin.name.to_owned());
    for name in names.chain([own.display().to_string()]) {
        let scene = SceneRef::new(scene::load(&name).expect("a scene"));
        let plain = Settings::of_scene(scene.clone());
        for round in 0..=40 {
            // In some rounds only some settings change, for some keys follow from others.
            let mut settings = changed(&scene, &mut random);
            let (now, was) = (&mut settings.estimator, &plain.estimator);
            let mut keep = || round > 9 && random.bool();
            if keep() {
                now.camera.vfov_radians = was.camera.vfov_radians;
            }
            if keep() {
                now.camera.metres_per_unit = was.camera.metres_per_unit;
            }
            if keep() {
                now.lens.diameter = was.lens.diameter;
            }
            if keep() {
                now.hole.diameter = was.hole.diameter;
            }
            if keep() {
                now.size = was.size;
            }
            if keep() {
                now.model = was.model;
            }
            now.camera.focus_breathing &= now.camera.can_focus(&now.lens).is_ok();
            if round == 40 {
                settings = plain.clone();
            }
            // Less light by as much as no scene may have more.
            let excess = (settings.exposure().log2().abs() - 19.0).max(0.0);
            settings.view.exposure_stops -= excess.copysign(settings.exposure().log2());
            let file = folder.path().join("saved.toml");
            output::save_scene(&settings, &file).expect("a saved scene");
            let saved = SceneRef::new(scene::load(&file).expect("a scene"));
            let mut again = Settings::of_scene(saved);
            let brightness = f64::from(again.exposure() / settings.exposure());
            assert!((brightness - 1.0).abs() < 1e-5, "{name} is {brightness} times as bright");
            if settings == plain {
                assert_eq!(again.view, settings.view, "{name}");
            }
            again.view.exposure_stops = settings.view.exposure_stops;
            for setting in list::own().filter(|setting| setting.is_of_sampling()) {
                setting.set(&mut again, &setting.get(&settings)).expect("no image");
            }
            again.estimator.scene = settings.estimator.scene.clone();
            assert_eq!(again, settings, "{name}");
            let text = std::fs::read_to_string(&file).expect("text");
            assert!(!name.ends_with("own.toml") || text.contains("# from here") == (settings == plain));
        }
    }
}

/// Catches tables that are written another way than the built-in scenes write them, numbers that no scene may
/// have, and a file that was changed since it was loaded.
#[test]
fn what_a_scene_file_says_is_what_counts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    let load = |name: &str| {
        let scene = scene::load(path(name)).expect("a scene");
        Settings::of_scene(SceneRef::new(scene))
    };
    std::fs::write(path("some.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n").expect("a mesh");
    let own = "camera = { eye = [0, 1, 9], look_at = [0, 1, 0], vfov_degrees = 40, lens_diameter = 0.5, \
               focal_distance = 9 }\nview = { tolerance = 3, exposure_lock = false }\n\
               mesh = [{ file = \"some.obj\" }]\n";
    std::fs::write(path("own.toml"), own).expect("a scene");
    std::fs::create_dir(path("deep")).expect("a folder");
    let mut settings = load("own.toml");
    settings.view.exposure_stops = 1.0;
    settings.estimator.lens.focal_distance = 5.0;
    output::save_scene(&settings, &path("deep/saved.toml")).expect("a saved scene");
    let saved = load("deep/saved.toml");
    assert_eq!((saved.view, saved.estimator.lens), (settings.view, settings.estimator.lens));

    // The file has another lens by now, but the lens that was loaded is saved.
    std::fs::write(path("own.toml"), own.replace("lens_diameter = 0.5", "lens_diameter = 2"))
        .expect("a scene");
    output::save_scene(&settings, &path("saved.toml")).expect("a saved scene");
    assert_eq!(load("saved.toml").estimator.lens, settings.estimator.lens);

    settings.estimator.shutter = 1e4;
    settings.view.iso = 1e7;
    let error = output::save_scene(&settings, &path("bright.toml")).expect_err("too bright").to_string();
    assert!(error.contains("exposure of the saved scene"), "{error}");
    assert!(!path("bright.toml").exists());
}

/// Catches a picture of one lens that is saved as one of another.
#[test]
fn a_picture_is_saved_with_its_own_settings_or_not_at_all() {
    let gpu = Gpu::new();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut settings = Settings::of_scene(SceneRef::new(scene::load("version-4").expect("a built-in scene")));
    (settings.estimator.size, settings.samples) = ([32, 24], 3);
    let mut renderer = gpu.renderer(&settings);
    renderer.render(|_| {}).expect("a picture");
    let file = folder.path().join("a.png");
    let mut other = settings.clone();
    other.estimator.lens.diameter = 0.0;
    let error = output::save(&mut renderer, &other, &file).expect_err("another picture").to_string();
    assert!(error.contains("just changed") && !file.exists(), "{error}");
    renderer.set(&settings).expect("a film");
    renderer.render(|_| {}).expect("a picture");
    output::save(&mut renderer, &settings, &file).expect("a saved picture");
    assert!(file.exists());
}

/// Catches meshes that are not found from another folder, and a stage around a mesh that is not the same in a file.
#[test]
fn a_saved_mesh_is_found_from_anywhere() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    std::fs::create_dir(folder.join("deep")).expect("a folder");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::fs::write(folder.join("some.obj"), obj).expect("a mesh");
    let small = ["-s", "60x40", "-n", "4"];
    let save = |arguments: &[&str]| {
        let outcome = run(folder, &[&["save"], arguments].concat());
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    };
    save(&["some.obj", "--f-number", "1.4", "-o", "here.toml"]);
    save(&["here.toml", "-o", "deep/there.toml"]);
    save(&["deep/there.toml", "-o", "again.toml"]);
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).expect("text");
    assert!(text("here.toml").contains("file = \"some.obj\""), "{}", text("here.toml"));
    assert_eq!(text("here.toml"), text("again.toml"));

    let sky = "integrator = \"path\"\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, -1]\nvfov_degrees = 40\nlens_diameter = 0\n\
               focal_distance = 1\n[background]\nimage = \"sky.png\"\n";
    std::fs::write(folder.join("sky.toml"), sky).expect("a scene");
    let pixel = image::ImageBuffer::from_pixel(1, 1, image::Luma([9_u8]));
    pixel.save(folder.join("sky.png")).expect("an image");
    save(&["sky.toml", "-o", "deep/sky.toml"]);
    save(&["deep/sky.toml", "-o", "back.toml"]);
    assert_eq!(text("back.toml"), sky);

    let of = |name: &str| decode_png(&render(folder, &[&[name], &small[..]].concat(), "a.png")).1;
    let mesh =
        decode_png(&render(folder, &[&["some.obj", "--f-number", "1.4"], &small[..]].concat(), "a.png")).1;
    assert!(of("here.toml") == of("deep/there.toml"));
    // The mesh's place is rounded.
    let differ =
        mesh.iter().zip(&of("here.toml")).filter(|(a, b)| (0..3).any(|i| a[i].abs_diff(b[i]) > 2)).count();
    assert!(differ < 24, "{differ} pixels differ");

    for (arguments, code, message) in [
        (&["version-4", "-o", "a.txt"][..], 2, "is a .toml"),
        (&["version-4", "-o", "nowhere/a.toml"], 1, "cannot write"),
        (&["nothing", "-o", "a.toml"], 2, "nothing"),
    ] {
        let outcome = run(folder, &[&["save"], arguments].concat());
        assert_eq!(outcome.code, code, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    }
}

/// Catches names that a file's text or a shell would spoil.
#[test]
fn names_with_spaces_quotes_and_umlauts_come_back() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let name = "it's a scène \u{1f600}.toml";
    let text = include_str!("../src/scene/builtin/suffern-boxes.toml");
    std::fs::write(folder.join(name), text).expect("a scene");
    for format in ["png", "exr"] {
        let output = format!("a.{format}");
        render(folder, &[name, "-s", "20x15", "-n", "1"], &output);
        let origin = Origin::read(&folder.join(&output)).expect("how it was made");
        assert_eq!(origin.arguments[0], name);
    }
    let scene = scene::load(folder.join(name)).expect("a scene");
    let line = Settings::of_scene(SceneRef::new(scene)).command_line("a.png");
    let echoed = std::process::Command::new("sh").args(["-c", &format!("printf '%s\\n' {line}")]).output();
    let words = String::from_utf8(echoed.expect("a shell").stdout).expect("text");
    assert!(words.lines().nth(2).expect("three words").ends_with(name), "{words}");
}
